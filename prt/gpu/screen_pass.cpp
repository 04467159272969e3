#include "prt/gpu/screen_pass.h"

#include <epoxy/gl.h>

namespace prt {

ScreenPass::ScreenPass(const ShaderText& fragmentShader, TextureFilter filter)
    : program_(linkProgram(findShader("shaders/screen.vert"), fragmentShader)) {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    layout_ = GlName(name, [](unsigned given) { glDeleteVertexArrays(1, &given); });
    glGenSamplers(1, &name);
    sampler_ = GlName(name, [](unsigned given) { glDeleteSamplers(1, &given); });
    const GLint glFilter = filter == TextureFilter::linear ? GL_LINEAR : GL_NEAREST;
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, glFilter);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, glFilter);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void ScreenPass::use(unsigned texture) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glUseProgram(program_.get());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBindSampler(0, sampler_.get());
}

void ScreenPass::draw() const {
    glBindVertexArray(layout_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace prt

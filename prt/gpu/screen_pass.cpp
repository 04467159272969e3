#include "prt/gpu/screen_pass.h"

#include <epoxy/gl.h>

#include "prt/gpu/gl_objects.h"

namespace prt {

ScreenPass::ScreenPass(const ShaderText& fragmentShader, const ScreenPassOptions& options)
    : program_(linkProgram(findShader("shaders/screen.vert"), fragmentShader, options.definitions,
                           options.called)) {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    layout_ = GlName(name, [](unsigned given) { glDeleteVertexArrays(1, &given); });
    sampler_ = makeSampler(GL_REPEAT, GL_CLAMP_TO_EDGE,
                           options.filter == TextureFilter::linear ? GL_LINEAR : GL_NEAREST);
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

// Bibliography
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/gpu/gpu_display.h"

#include <cmath>

#include <epoxy/gl.h>

#include "prt/gpu/shader_interface.h"
#include "prt/gpu/shader_program.h"

namespace prt {

GpuDisplay::GpuDisplay()
    : program_(linkProgram(findShader("shaders/screen.vert"), findShader("shaders/display.frag"))) {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    layout_ = GlName(name, [](unsigned given) { glDeleteVertexArrays(1, &given); });
    glGenSamplers(1, &name);
    sampler_ = GlName(name, [](unsigned given) { glDeleteSamplers(1, &given); });
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void GpuDisplay::draw(const GpuTarget& radiance, const DisplayOptions& options) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glUseProgram(program_.get());
    glUniform1f(uniforms::kExposure, std::exp2(options.exposureStops));
    glUniform1i(uniforms::kIsAces, options.toneCurve == ToneCurve::aces);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, radiance.texture());
    glBindSampler(0, sampler_.get());
    glBindVertexArray(layout_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace prt

// Bibliography
//   [Khronos24]    Khronos PBR Neutral tone mapper
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/gpu/gpu_display.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <epoxy/gl.h>

#include "prt/gpu/shader_interface.h"

namespace prt {

GpuDisplay::GpuDisplay() : pass_(findShader("shaders/display.frag")) {}

void GpuDisplay::draw(const GpuTarget& radiance, const DisplayOptions& options,
                      const PixelColumns& columns) const {
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    const int first = std::clamp(columns.first, 0, viewport[2]);
    const int end = std::clamp(columns.end, first, viewport[2]);
    glScissor(viewport[0] + first, viewport[1], end - first, viewport[3]);
    glEnable(GL_SCISSOR_TEST);
    pass_.use(radiance.texture());
    glUniform1f(uniforms::kExposure, std::exp2(options.exposureStops));
    glUniform1i(uniforms::kToneCurve, static_cast<int>(options.toneCurve));
    pass_.draw();
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace prt

// Bibliography
//   [Khronos24]    Khronos PBR Neutral tone mapper
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/gpu/gpu_display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <epoxy/gl.h>

#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

/// A rasteriser on the CPU would go through all curves of a program that knows them all.
ScreenPass makePass(ToneCurve curve) {
    const std::string number = std::to_string(static_cast<int>(curve));
    ScreenPassOptions options;
    options.definitions = "#define TONE_CURVE " + number + "\n";
    return ScreenPass(findShader("shaders/display.frag"), options);
}

}  // namespace

GpuDisplay::GpuDisplay()
    : passes_{makePass(ToneCurve::none), makePass(ToneCurve::aces), makePass(ToneCurve::neutral)} {}

void GpuDisplay::draw(const GpuTarget& radiance, const DisplayOptions& options,
                      const PixelColumns& columns) const {
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    const int first = std::clamp(columns.first, 0, viewport[2]);
    const int end = std::clamp(columns.end, first, viewport[2]);
    glScissor(viewport[0] + first, viewport[1], end - first, viewport[3]);
    glEnable(GL_SCISSOR_TEST);
    const ScreenPass& pass = passes_[static_cast<std::size_t>(options.toneCurve)];
    pass.use(radiance.texture());
    glUniform1f(uniforms::kExposure, std::exp2(options.exposureStops));
    pass.draw();
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace prt

// Bibliography
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/gpu/gpu_display.h"

#include <cmath>

#include <epoxy/gl.h>

#include "prt/gpu/shader_interface.h"

namespace prt {

GpuDisplay::GpuDisplay() : pass_(findShader("shaders/display.frag")) {}

void GpuDisplay::draw(const GpuTarget& radiance, const DisplayOptions& options) const {
    pass_.use(radiance.texture());
    glUniform1f(uniforms::kExposure, std::exp2(options.exposureStops));
    glUniform1i(uniforms::kIsAces, options.toneCurve == ToneCurve::aces);
    pass_.draw();
}

}  // namespace prt

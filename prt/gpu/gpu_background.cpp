#include "prt/gpu/gpu_background.h"

#include <array>

#include <epoxy/gl.h>

#include "prt/gpu/environment_texture.h"
#include "prt/gpu/shader_interface.h"

namespace prt {

GpuBackground::GpuBackground(const Environment& environment)
    : pass_(findShader("shaders/background.frag"),
            {.filter = TextureFilter::linear,
             .called = std::array{findShader("shaders/lat_long.frag")}}),
      texture_(uploadLatLong(environment)) {}

void GpuBackground::draw(const ViewFrame& view, const Mat3d& worldFromBackground) const {
    const Mat3d backgroundFromWorld = worldFromBackground.transposed();
    const auto setDirection = [&](int location, const Vec3d& direction) {
        const Vec3f turned(backgroundFromWorld * direction);
        glUniform3f(location, turned.x, turned.y, turned.z);
    };
    pass_.use(texture_.get());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    setDirection(uniforms::kForward, view.forward + view.rightward * view.rightwardShift +
                                         view.upward * view.upwardShift);
    setDirection(uniforms::kRightward, view.rightward);
    setDirection(uniforms::kUpward, view.upward);
    pass_.draw();
    glDepthMask(GL_TRUE);
}

}  // namespace prt

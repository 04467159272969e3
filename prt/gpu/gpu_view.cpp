#include "prt/gpu/gpu_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

/// The least distance that is drawn, relative to the largest. Depths between 0 and 1 are held to
/// 2⁻²⁴, which tells the farthest surfaces apart if they are 2⁻²⁴ / 10⁻³ of that distance, a
/// 16000th, from one another.
constexpr double kNearestShare = 1e-3;

/// More than the rounding of depths.
constexpr double kDepthMargin = 1e-3;

struct DepthRange {
    double nearest = 0.0;
    double farthest = 0.0;
};

/// Along the camera's axis, of all that it sees of a ball.
///
/// @param cornerCosine  of the angle from the axis to a corner of the picture
DepthRange findDepths(const Bounds& bounds, const Camera& camera, double cornerCosine) {
    const double distance = static_cast<double>((bounds.center() - camera.eye).length());
    const double radius = static_cast<double>(bounds.radius());
    const double farthest = (distance + radius) * (1.0 + kDepthMargin);
    const double nearest = (distance - radius) * cornerCosine * (1.0 - kDepthMargin);
    if (!(farthest > 0.0)) return {kNearestShare, 1.0};
    return {std::max(nearest, farthest * kNearestShare), farthest};
}

/// OpenGL's clip space, of points relative to the eye along the world's axes; column after column.
std::array<float, 16> makeClipMatrix(const Bounds& bounds, const Camera& camera,
                                     const ViewFrame& view) {
    const double cornerCosine =
        1.0 / std::sqrt(1.0 + view.rightward.length2() + view.upward.length2());
    const DepthRange depths = findDepths(bounds, camera, cornerCosine);
    const double length = depths.farthest - depths.nearest;
    const double depthScale = (depths.farthest + depths.nearest) / length;
    const double depthOffset = -2.0 * depths.farthest * depths.nearest / length;

    const std::array<Vec3d, 4> rows = {view.rightward / view.rightward.length2(),
                                       view.upward / view.upward.length2(),
                                       view.forward * depthScale, view.forward};
    std::array<float, 16> matrix{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix[4 * static_cast<std::size_t>(column) + row] =
                static_cast<float>(rows[row][column]);
    }
    matrix[14] = static_cast<float>(depthOffset);
    return matrix;
}

void checkFieldOfView(float fov) {
    if (!(fov > 0.0f && fov < std::numbers::pi_v<float>))
        throw Error(ErrorCode::invalidOption, "the field of view is not between 0 and 180 degrees");
}

void drawScene(const GpuScene& scene, const GpuRadiance& radiance, const Camera& camera,
               const ViewFrame& view) {
    PRT_ASSERT(scene.vertexCount() == radiance.vertexCount(), "radiance of this scene");
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    radiance.use();
    glUniformMatrix4fv(uniforms::kClipFromEyeSpace, 1, GL_FALSE,
                       makeClipMatrix(scene.bounds(), camera, view).data());
    glUniform3fv(uniforms::kEye, 1, &camera.eye.x);
    scene.drawTriangles();
}

}  // namespace

void drawGpuView(const GpuScene& scene, const GpuRadiance& radiance, const Camera& camera,
                 const GpuTarget& target, const GpuViewOptions& options) {
    checkFieldOfView(camera.verticalFovRadians);
    const ViewFrame view =
        makeViewFrame(camera, static_cast<double>(target.width()) / target.height());
    target.beginDrawing();
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0f);
    if (options.background) options.background->draw(view, options.worldFromBackground);
    drawScene(scene, radiance, camera, view);
    glDisable(GL_SAMPLE_SHADING);
    target.finishDrawing();
}

}  // namespace prt

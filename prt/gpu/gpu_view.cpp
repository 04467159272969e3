#include "prt/gpu/gpu_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Along the camera's axis, of all that it sees of some balls.
///
/// @param cornerCosine  of the angle from the axis to a corner of the picture
DepthRange findDepths(std::span<const GpuObject> objects, const Camera& camera,
                      double cornerCosine) {
    DepthRange depths{std::numeric_limits<double>::infinity(), 0.0};
    for (const GpuObject& object : objects) {
        if (object.scene->vertexCount() == 0) continue;
        const Bounds& bounds = object.scene->bounds();
        const Vec3d center = transformPoint(object.worldFromObject, Vec3d(bounds.center()));
        const double distance = (center - Vec3d(camera.eye)).length();
        const auto radius = static_cast<double>(bounds.radius());
        depths.nearest = std::min(depths.nearest, distance - radius);
        depths.farthest = std::max(depths.farthest, distance + radius);
    }
    const double farthest = depths.farthest * (1.0 + kDepthMargin);
    const double nearest = depths.nearest * cornerCosine * (1.0 - kDepthMargin);
    if (!(farthest > 0.0)) return {kNearestShare, 1.0};
    return {std::max(nearest, farthest * kNearestShare), farthest};
}

double findCornerCosine(const ViewFrame& view) {
    return 1.0 / std::sqrt(1.0 + view.rightward.length2() + view.upward.length2());
}

/// OpenGL's clip space, of points relative to the eye along the axes that the view has; column
/// after column.
std::array<float, 16> makeClipMatrix(const DepthRange& depths, const ViewFrame& view) {
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

/// @param lineRadiance  0 for surfaces
void drawObjects(std::span<const GpuObject> objects, const Camera& camera, const ViewFrame& view,
                 float lineRadiance) {
    const DepthRange depths = findDepths(objects, camera, findCornerCosine(view));
    for (const GpuObject& object : objects) {
        PRT_ASSERT(object.scene->vertexCount() == object.radiance->vertexCount(),
                   "radiance of this scene");
        const Mat3d objectFromWorld = object.worldFromObject.linear.transposed();
        const Vec3f eye(objectFromWorld * (Vec3d(camera.eye) - object.worldFromObject.translation));
        const ViewFrame objectView{objectFromWorld * view.forward, objectFromWorld * view.rightward,
                                   objectFromWorld * view.upward};
        object.radiance->use();
        glUniformMatrix4fv(uniforms::kClipFromEyeSpace, 1, GL_FALSE,
                           makeClipMatrix(depths, objectView).data());
        glUniform3fv(uniforms::kEye, 1, &eye.x);
        glUniform1f(uniforms::kLineRadiance, lineRadiance);
        object.scene->drawTriangles();
    }
}

/// Lines lie on the surfaces, which step back a little for them.
void drawWithLines(std::span<const GpuObject> objects, const Camera& camera, const ViewFrame& view,
                   float lineRadiance) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    drawObjects(objects, camera, view, 0.0f);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    drawObjects(objects, camera, view, lineRadiance);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace

void drawGpuView(std::span<const GpuObject> objects, const Camera& camera, const GpuTarget& target,
                 const GpuViewOptions& options) {
    checkFieldOfView(camera.verticalFovRadians);
    const ViewFrame view =
        makeViewFrame(camera, static_cast<double>(target.width()) / target.height());
    target.beginDrawing(options.columns);
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0f);
    if (options.background) options.background->draw(view, options.worldFromBackground);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    if (options.wireFrame)
        drawWithLines(objects, camera, view, options.wireRadiance);
    else
        drawObjects(objects, camera, view, 0.0f);
    glDisable(GL_SAMPLE_SHADING);
    target.finishDrawing(options.columns);
}

}  // namespace prt

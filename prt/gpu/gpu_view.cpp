#include "prt/gpu/gpu_view.h"

#include <numbers>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/shader_interface.h"
#include "prt/gpu/view_depth.h"

namespace prt {
namespace {

void checkFieldOfView(float fov) {
    if (!(fov > 0.0f && fov < std::numbers::pi_v<float>))
        throw Error(ErrorCode::invalidOption, "the field of view is not between 0 and 180 degrees");
}

/// @param lineRadiance  0 for surfaces
void drawObjects(std::span<const GpuObject> objects, const Camera& camera, const ViewFrame& view,
                 const GpuMirrors* mirrors, float lineRadiance) {
    const DepthRange depths = findDepths(objects, camera, view);
    for (const GpuObject& object : objects) {
        PRT_ASSERT(object.scene->vertexCount() == object.radiance->vertexCount(),
                   "radiance of this scene");
        const Mat3d objectFromWorld = object.worldFromObject.linear.transposed();
        const Vec3f eye(objectFromWorld * (Vec3d(camera.eye) - object.worldFromObject.translation));
        const SurfaceFeatures features{.textures = object.scene->hasTextures(),
                                       .mirrors = mirrors && object.radiance->hasMirrors(),
                                       .lines = lineRadiance > 0.0f};
        object.radiance->use(features);
        if (features.mirrors) mirrors->use(object.worldFromObject.linear);
        glUniformMatrix4fv(uniforms::kClipFromEyeSpace, 1, GL_FALSE,
                           makeClipMatrix(depths, turnView(view, objectFromWorld)).data());
        glUniform3fv(uniforms::kEye, 1, &eye.x);
        if (features.lines) glUniform1f(uniforms::kLineRadiance, lineRadiance);
        object.scene->drawTriangles();
    }
}

/// Lines lie on the surfaces, which step back a little for them.
void drawWithLines(std::span<const GpuObject> objects, const Camera& camera, const ViewFrame& view,
                   const GpuMirrors* mirrors, float lineRadiance) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    drawObjects(objects, camera, view, mirrors, 0.0f);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    drawObjects(objects, camera, view, mirrors, lineRadiance);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace

void drawGpuView(std::span<const GpuObject> objects, const Camera& camera, const GpuTarget& target,
                 const GpuViewOptions& options) {
    checkFieldOfView(camera.verticalFovRadians);
    ViewFrame view = makeViewFrame(camera, static_cast<double>(target.width()) / target.height());
    view.rightwardShift = 2.0 * static_cast<double>(options.shiftPixels.x) / target.width();
    view.upwardShift = 2.0 * static_cast<double>(options.shiftPixels.y) / target.height();
    target.beginDrawing(options.columns, options.background != nullptr);
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    if (options.wireFrame)
        drawWithLines(objects, camera, view, options.mirrors, options.wireRadiance);
    else
        drawObjects(objects, camera, view, options.mirrors, 0.0f);
    if (options.background) options.background->draw(view, options.worldFromBackground);
    glDisable(GL_SAMPLE_SHADING);
    target.finishDrawing(options.columns);
}

}  // namespace prt

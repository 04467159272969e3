#include "prt/gpu/gpu_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

/// The nearest that is seen, relative to the farthest: enough for 32 bits of depth to tell surfaces
/// apart that are a hundred-thousandth of their distance from one another.
constexpr double kNearestShare = 1e-4;

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
                                     double aspectRatio) {
    const double halfHeight = std::tan(0.5 * static_cast<double>(camera.verticalFovRadians));
    const double halfWidth = halfHeight * aspectRatio;
    const double cornerCosine =
        1.0 / std::sqrt(1.0 + halfHeight * halfHeight + halfWidth * halfWidth);
    const DepthRange depths = findDepths(bounds, camera, cornerCosine);
    const double length = depths.farthest - depths.nearest;
    const double depthScale = (depths.farthest + depths.nearest) / length;
    const double depthOffset = -2.0 * depths.farthest * depths.nearest / length;

    const Vec3d forward(camera.forward);
    const Vec3d up(camera.up);
    const std::array<Vec3d, 4> rows = {forward.cross(up) / halfWidth, up / halfHeight,
                                       forward * depthScale, forward};
    std::array<float, 16> matrix{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix[4 * static_cast<std::size_t>(column) + row] =
                static_cast<float>(rows[row][column]);
    }
    matrix[14] = static_cast<float>(depthOffset);
    return matrix;
}

void checkRange(int value, int maximum, const char* what) {
    if (value >= 1 && value <= maximum) return;
    throw Error(ErrorCode::invalidOption, std::string(what) + " is " + std::to_string(value) +
                                              ", not between 1 and " + std::to_string(maximum));
}

int readLimit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void checkView(const Camera& camera, const GpuViewOptions& options) {
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const int side = readLimit(GL_MAX_RENDERBUFFER_SIZE);
    checkRange(options.width, std::min(side, viewport[0]), "the width");
    checkRange(options.height, std::min(side, viewport[1]), "the height");
    checkRange(options.sampleCount, readLimit(GL_MAX_SAMPLES), "the number of samples");
    const float fov = camera.verticalFovRadians;
    if (!(fov > 0.0f && fov < std::numbers::pi_v<float>))
        throw Error(ErrorCode::invalidOption, "the field of view is not between 0 and 180 degrees");
}

/// A place to draw to, in floats.
class FloatTarget {
  public:
    /// @param sampleCount  0: one, that can be read
    FloatTarget(int width, int height, int sampleCount) {
        unsigned name = 0;
        glGenFramebuffers(1, &name);
        framebuffer_ = GlName(name, [](unsigned given) { glDeleteFramebuffers(1, &given); });
        glBindFramebuffer(GL_FRAMEBUFFER, name);
        color_ = attach(GL_COLOR_ATTACHMENT0, GL_RGBA32F, width, height, sampleCount);
        depth_ = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, width, height, sampleCount);
        checkGpuMemory("the picture");
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw Error(ErrorCode::unsupported,
                        "the graphics driver does not draw to floating-point pictures of " +
                            std::to_string(std::max(sampleCount, 1)) + " samples a pixel");
    }

    unsigned framebuffer() const { return framebuffer_.get(); }

  private:
    static GlName attach(GLenum place, GLenum format, int width, int height, int sampleCount) {
        unsigned name = 0;
        glGenRenderbuffers(1, &name);
        GlName buffer(name, [](unsigned given) { glDeleteRenderbuffers(1, &given); });
        glBindRenderbuffer(GL_RENDERBUFFER, name);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, sampleCount, format, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, name);
        return buffer;
    }

    GlName framebuffer_;
    GlName color_;
    GlName depth_;
};

/// The picture of the framebuffer that is bound for reading, whose lowest row comes first.
Image readPicture(int width, int height) {
    Image image(width, height);
    glReadPixels(0, 0, width, height, GL_RGB, GL_FLOAT, image.pixels.data());
    for (int y = 0; y < height / 2; ++y)
        std::swap_ranges(&image.at(0, y), &image.at(0, y) + width, &image.at(0, height - 1 - y));
    return image;
}

}  // namespace

void drawGpuScene(const GpuScene& scene, const GpuRelighter& relighter, const Camera& camera,
                  double aspectRatio) {
    PRT_ASSERT(scene.vertexCount() == relighter.vertexCount(), "transfer of this scene");
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    relighter.use();
    glUniformMatrix4fv(uniforms::kClipFromEyeSpace, 1, GL_FALSE,
                       makeClipMatrix(scene.bounds(), camera, aspectRatio).data());
    glUniform3fv(uniforms::kEye, 1, &camera.eye.x);
    scene.drawTriangles();
}

Image renderGpuView(const GpuScene& scene, const GpuRelighter& relighter, const Camera& camera,
                    const GpuViewOptions& options) {
    checkView(camera, options);
    const bool isMultisampled = options.sampleCount > 1;
    const FloatTarget target(options.width, options.height,
                             isMultisampled ? options.sampleCount : 0);
    glViewport(0, 0, options.width, options.height);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1.0f);
    drawGpuScene(scene, relighter, camera, static_cast<double>(options.width) / options.height);
    glDisable(GL_SAMPLE_SHADING);
    if (!isMultisampled) return readPicture(options.width, options.height);

    const FloatTarget resolved(options.width, options.height, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
    glBlitFramebuffer(0, 0, options.width, options.height, 0, 0, options.width, options.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved.framebuffer());
    return readPicture(options.width, options.height);
}

}  // namespace prt

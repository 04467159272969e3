#include "prt/gpu/gpu_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/lobe_shape.h"
#include "prt/gpu/shader_interface.h"
#include "prt/gpu/view_depth.h"
#include "prt/scene/procedural.h"

namespace prt {
namespace {

constexpr int kSampleCount = 4;

/// Vertices around the equator: a wave of the highest degree has more than twenty.
int countSegments(int bandCount) {
    return 20 * std::clamp(bandCount, 4, kMaxBandCount);
}

/// Of a globe's square: the largest radius over half its side, and the disc behind it, a code value
/// and its share.
constexpr double kGlobeRadius = 0.92;
constexpr float kDiscValue = 0.09f;
constexpr float kDiscShare = 0.5f;

/// Depths of a lobe that reaches to the eye.
constexpr double kNearestShare = 1e-3;

/// Pixels of a viewport, from its lower left corner.
struct PixelRectangle {
    int left = 0;
    int bottom = 0;
    int width = 0;
    int height = 0;
};

/// Where the planes through the eye that touch a ball cut an axis of the picture, −1 … 1 being in
/// the picture; all of it if the ball reaches beside the eye.
///
/// @param across, ahead  of the ball's centre, along the axis and along the camera's
std::pair<double, double> findReach(double across, double ahead, double radius,
                                    double halfPicture) {
    const double distance = std::hypot(across, ahead);
    if (distance <= radius) return {-1.0, 1.0};
    const double middle = std::atan2(across, ahead), half = std::asin(radius / distance);
    if (std::abs(middle) + half >= 0.5 * std::numbers::pi) return {-1.0, 1.0};
    return {std::clamp(std::tan(middle - half) / halfPicture, -1.0, 1.0),
            std::clamp(std::tan(middle + half) / halfPicture, -1.0, 1.0)};
}

/// The pixels that a ball may cover.
PixelRectangle findPixels(const Vec3d& fromEye, double radius, const ViewFrame& view,
                          const GpuTarget& scene) {
    const double ahead = fromEye.dot(view.forward);
    if (ahead + radius <= 0.0) return {};
    const auto findRange = [&](const Vec3d& axis, int pixelCount) {
        const double half = axis.length();
        const auto [low, high] = findReach(fromEye.dot(axis) / half, ahead, radius, half);
        const double scale = 0.5 * pixelCount;
        return std::pair(static_cast<int>(std::floor((low + 1.0) * scale)),
                         static_cast<int>(std::ceil((high + 1.0) * scale)));
    };
    const auto [left, right] = findRange(view.rightward, scene.width());
    const auto [bottom, top] = findRange(view.upward, scene.height());
    return {left, bottom, right - left, top - bottom};
}

/// From afar, along the view's axis; column after column.
std::array<float, 16> makeGlobeMatrix(const ViewFrame& view) {
    const std::array<Vec3d, 3> rows = {view.rightward.normalized(), view.upward.normalized(),
                                       view.forward};
    std::array<float, 16> matrix{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            matrix[4 * static_cast<std::size_t>(column) + row] =
                static_cast<float>(rows[row][column] * kGlobeRadius);
    }
    matrix[15] = 1.0f;
    return matrix;
}

void addAttribute(unsigned location, int size, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(LobeVertex),
                          reinterpret_cast<const void*>(offset));
}

float findLongestEdge(const Mesh& sphere, std::span<const LobeVertex> vertices) {
    float longest = 0.0f;
    for (std::size_t i = 0; i < sphere.indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const Vec3f edge =
            vertices[sphere.indices[next]].position - vertices[sphere.indices[i]].position;
        longest = std::max(longest, edge.length());
    }
    return longest;
}

static_assert(offsetof(LobeVertex, value) == offsetof(LobeVertex, color) + sizeof(Vec3f));

}  // namespace

/// How a lobe is drawn, in its own axes and unit of length.
struct GpuLobe::Pass {
    ViewFrame view;
    std::array<float, 16> clipFromEyeSpace{};
    Vec3f eye{0.0f, 0.0f, 0.0f};
    PixelRectangle pixels{};  ///< that are drawn to
    int width = 0;            ///< of the picture that the camera sees, from (originX, originY) on
    int height = 0;
    int originX = 0;
    int originY = 0;
    const GpuTarget* scene = nullptr;  ///< none: nothing hides it
    DepthRange sceneDepths{};
    float discShare = 0.0f;
};

GpuLobe::GpuLobe()
    : program_(linkProgram(findShader("shaders/lobe.vert"), findShader("shaders/lobe.frag"))),
      overlayPass_(findShader("shaders/overlay.frag")) {
    setFunction(Lighting(1));
}

void GpuLobe::setFunction(const Lighting& function, const LobeColors& colors) {
    const int segmentCount = countSegments(function.bandCount);
    if (segmentCount != segmentCount_) makeTriangles(segmentCount);
    const std::vector<LobeVertex> shape = shapeLobe(sphere_, function, colors.positive);
    writeBuffer(vertices_, 0, std::as_bytes(std::span(shape)));
    negativeColor_ = colors.negative;
    longestEdge_ = findLongestEdge(sphere_, shape);
}

void GpuLobe::makeTriangles(int segmentCount) {
    segmentCount_ = segmentCount;
    sphere_ = makeSphere(Vec3f(0.0f), 1.0f, segmentCount);
    vertices_ = makeBuffer(sphere_.vertexCount() * sizeof(LobeVertex), "a lobe");
    indices_ = makeBuffer(std::span<const std::uint32_t>(sphere_.indices), "a lobe");
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    layout_ = GlName(name, [](unsigned given) { glDeleteVertexArrays(1, &given); });
    glBindVertexArray(name);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    addAttribute(attributes::kPosition, 3, offsetof(LobeVertex, position));
    addAttribute(attributes::kLobeNormal, 3, offsetof(LobeVertex, normal));
    addAttribute(attributes::kColor, 4, offsetof(LobeVertex, color));
    glBindVertexArray(0);
}

void GpuLobe::drawInScene(const GpuTarget& scene, std::span<const GpuObject> objects,
                          const Camera& camera, const LobePlace& place,
                          const PixelColumns& columns) {
    const ViewFrame view =
        makeViewFrame(camera, static_cast<double>(scene.width()) / scene.height());
    const Vec3d fromEye = place.center - Vec3d(camera.eye);
    const Mat3d lobeFromWorld = place.worldFromLobe.transposed();
    const double radius = place.largestRadius;
    PRT_ASSERT(radius > 0.0, "a lobe of some size");
    const double ahead = fromEye.dot(view.forward) / radius;

    Pass pass;
    pass.view = turnView(view, lobeFromWorld);
    pass.pixels = findPixels(fromEye, radius, view, scene);
    const int end = std::min(pass.pixels.left + pass.pixels.width, columns.end);
    pass.pixels.left = std::max(pass.pixels.left, columns.first);
    pass.pixels.width = end - pass.pixels.left;
    if (pass.pixels.width <= 0 || pass.pixels.height <= 0) return;
    pass.width = scene.width();
    pass.height = scene.height();

    const double farthest = ahead + 1.001;
    pass.clipFromEyeSpace =
        makeClipMatrix({std::max(ahead - 1.001, farthest * kNearestShare), farthest}, pass.view);
    pass.eye = Vec3f(lobeFromWorld * fromEye * (-1.0 / radius));
    const DepthRange sceneDepths = findDepths(objects, camera, view);
    pass.scene = &scene;
    pass.sceneDepths = {sceneDepths.nearest / radius, sceneDepths.farthest / radius};
    draw(pass);
}

void GpuLobe::drawInCorner(const Camera& camera, const Mat3d& worldFromLobe,
                           const PictureSquare& square) {
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    Pass pass;
    pass.view = turnView(makeViewFrame(camera, 1.0), worldFromLobe.transposed());
    pass.clipFromEyeSpace = makeGlobeMatrix(pass.view);
    pass.pixels = {square.left, viewport[3] - square.top - square.side, square.side, square.side};
    pass.originX = pass.pixels.left;
    pass.originY = pass.pixels.bottom;
    pass.width = pass.height = square.side;
    pass.discShare = kDiscShare;
    draw(pass);
}

void GpuLobe::draw(const Pass& pass) {
    GLint framebuffer = 0;
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    glDisable(GL_SCISSOR_TEST);
    if (pass.scene) pass.scene->resolveDepth();
    drawSurface(pass);

    const PixelRectangle& pixels = pass.pixels;
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
    glViewport(viewport[0] + pixels.left, viewport[1] + pixels.bottom, pixels.width, pixels.height);
    overlayPass_.use(overlay_->texture());
    glUniform2i(uniforms::kCorner, viewport[0] + pixels.left, viewport[1] + pixels.bottom);
    const float discValue = pass.discShare * kDiscValue;
    glUniform4f(uniforms::kDiscColor, discValue, discValue, discValue, pass.discShare);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    overlayPass_.draw();
    glDisable(GL_BLEND);
    glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

void GpuLobe::drawSurface(const Pass& pass) {
    const PixelRectangle& pixels = pass.pixels;
    if (!overlay_ || overlay_->width() < pixels.width || overlay_->height() < pixels.height)
        overlay_.emplace(std::max(pixels.width, overlay_ ? overlay_->width() : 0),
                         std::max(pixels.height, overlay_ ? overlay_->height() : 0), kSampleCount,
                         TargetFormat::codeValues);
    const PixelColumns columns{0, pixels.width};
    overlay_->beginDrawing(columns);
    glViewport(pass.originX - pixels.left, pass.originY - pixels.bottom, pass.width, pass.height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);

    glUseProgram(program_.get());
    glUniformMatrix4fv(uniforms::kClipFromEyeSpace, 1, GL_FALSE, pass.clipFromEyeSpace.data());
    glUniform3fv(uniforms::kEye, 1, &pass.eye.x);
    const std::array<Vec3f, 3> cameraAxes = {Vec3f(pass.view.rightward.normalized()),
                                             Vec3f(pass.view.upward.normalized()),
                                             Vec3f(-pass.view.forward)};
    glUniformMatrix3fv(uniforms::kCameraFromLobe, 1, GL_TRUE, &cameraAxes[0].x);
    glUniform3fv(uniforms::kNegativeColor, 1, &negativeColor_.x);
    glUniform2f(uniforms::kSceneDepths, static_cast<float>(pass.sceneDepths.nearest),
                static_cast<float>(pass.sceneDepths.farthest));
    glUniform1f(uniforms::kLongestEdge, longestEdge_);
    glUniform2i(uniforms::kSceneCorner, pixels.left, pixels.bottom);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, pass.scene ? pass.scene->depthTexture() : 0);
    glBindSampler(0, 0);
    glBindVertexArray(layout_.get());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(sphere_.indices.size()), GL_UNSIGNED_INT,
                   nullptr);
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    overlay_->finishDrawing(columns);
}

}  // namespace prt

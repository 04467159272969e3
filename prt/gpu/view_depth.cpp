#include "prt/gpu/view_depth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace prt {
namespace {

/// The least distance that is drawn, relative to the largest. Depths between 0 and 1 are held to
/// 2⁻²⁴, which tells the farthest surfaces apart if they are 2⁻²⁴ / 10⁻³ of that distance, a
/// 16000th, from one another.
constexpr double kNearestShare = 1e-3;

/// More than the rounding of depths.
constexpr double kDepthMargin = 1e-3;

/// Of the angle from the axis to a corner of the picture.
double findCornerCosine(const ViewFrame& view) {
    const double right = 1.0 + std::abs(view.rightwardShift);
    const double up = 1.0 + std::abs(view.upwardShift);
    return 1.0 / std::sqrt(1.0 + right * right * view.rightward.length2() +
                           up * up * view.upward.length2());
}

}  // namespace

DepthRange findDepths(std::span<const GpuObject> objects, const Camera& camera,
                      const ViewFrame& view) {
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
    const double nearest = depths.nearest * findCornerCosine(view) * (1.0 - kDepthMargin);
    if (!(farthest > 0.0)) return {kNearestShare, 1.0};
    return {std::max(nearest, farthest * kNearestShare), farthest};
}

std::array<float, 16> makeClipMatrix(const DepthRange& depths, const ViewFrame& view) {
    const double length = depths.farthest - depths.nearest;
    const double depthScale = (depths.farthest + depths.nearest) / length;
    const double depthOffset = -2.0 * depths.farthest * depths.nearest / length;

    const std::array<Vec3d, 4> rows = {
        view.rightward / view.rightward.length2() - view.forward * view.rightwardShift,
        view.upward / view.upward.length2() - view.forward * view.upwardShift,
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

}  // namespace prt

#include "apps/viewer/placement.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"

namespace prt::viewer {
namespace {

/// Of the largest object, from one to the next.
constexpr double kSpacing = 1.05;

}  // namespace

std::vector<Affine3d> placeObjects(std::span<const Bounds> bounds,
                                   std::span<const Mat3d> rotations) {
    PRT_ASSERT(bounds.size() == rotations.size(), "a rotation for each object");
    const auto columnCount =
        static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(bounds.size()))));
    double largest = 0.0;
    for (const Bounds& box : bounds)
        largest = std::max(largest, static_cast<double>(box.radius()));
    const double spacing = 2.0 * largest * kSpacing;

    std::vector<Affine3d> places(bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const Vec3d center(bounds[i].center());
        const Vec3d ground(static_cast<double>(i % columnCount) * spacing, 0.0,
                           -static_cast<double>(i / columnCount) * spacing);
        const Vec3d place = i == 0 ? center : Vec3d(bounds[0].center()) + ground;
        places[i].linear = rotations[i];
        places[i].translation = place - rotations[i] * center;
    }
    return places;
}

Bounds moveBounds(const Affine3d& worldFromObject, const Bounds& bounds) {
    const Vec3d center(bounds.center());
    const Vec3d halfSize = Vec3d(bounds.high) - center;
    const Vec3d moved = transformPoint(worldFromObject, center);
    Vec3d reach(0.0);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i)
            reach[axis] += std::abs(worldFromObject.linear[axis][i]) * halfSize[i];
    return {Vec3f(moved - reach), Vec3f(moved + reach)};
}

Bounds uniteBounds(const Bounds& a, const Bounds& b) {
    Bounds both;
    for (int axis = 0; axis < 3; ++axis) {
        both.low[axis] = std::min(a.low[axis], b.low[axis]);
        both.high[axis] = std::max(a.high[axis], b.high[axis]);
    }
    return both;
}

}  // namespace prt::viewer

#pragma once

#include "prt/math/vector.h"

namespace prt {

/// How far a ray starts off the surface it leaves, in the tracer's space: 256 units in the last
/// place of a coordinate just below 1.
inline constexpr float kRayOffset = 0x1p-16f;

/// Moves a point off the surface it lies on, just far enough that a ray from it does not meet that
/// surface [Waechter19].
///
/// Differs from the paper: there, each coordinate moves by units of its own last place, which bends
/// the step when `direction` is not the surface's normal, as at corners. Here coordinates are at
/// most 1, and one distance serves all of them.
///
/// @param point      in the tracer's space (RayScene::tracePoint)
/// @param direction  unit, into free space
inline Vec3f offsetRayOrigin(const Vec3f& point, const Vec3f& direction) {
    return point + direction * kRayOffset;
}

}  // namespace prt

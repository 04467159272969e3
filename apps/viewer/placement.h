#pragma once

#include <span>
#include <vector>

#include "prt/math/transform.h"
#include "prt/scene/scene.h"

namespace prt::viewer {

/// Where objects stand: the first where it was baked, the others beside and behind it so that no
/// two touch, however they are turned.
///
/// @param bounds     of each, in its own frame
/// @param rotations  of each, about the centre of its box
/// @return           world from object, one an object
std::vector<Affine3d> placeObjects(std::span<const Bounds> bounds,
                                   std::span<const Mat3d> rotations);

/// The smallest box along the axes about a box that has been moved.
Bounds moveBounds(const Affine3d& worldFromObject, const Bounds& bounds);

/// The smallest box about both.
Bounds uniteBounds(const Bounds& a, const Bounds& b);

}  // namespace prt::viewer

#pragma once

#include "prt/image/sphere_map.h"

namespace prt {

/// What sphere_map.h does, for SphereMap::octahedral alone [Engelhardt08; Cigolle14].
///
/// The sphere is an octahedron |x| + |y| + |z| = 1. Seen from above its upper half fills the middle
/// of the square; the lower faces, cut open along the edges to −y, are turned out into the corners.

SphereTexel octahedralTexel(int size, int x, int y);
SpherePlace octahedralPlace(int size, double x, double y);
Vec2f octahedralPixel(int size, const Vec3f& direction);

struct TexelIndex {
    int x = 0;
    int y = 0;
};

/// The texel that meets a place just outside of the square, across the cut that its edge is.
///
/// @param x, y  in [−1, size]
TexelIndex wrapOctahedral(int size, int x, int y);

}  // namespace prt

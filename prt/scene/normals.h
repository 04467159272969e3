#pragma once

#include "prt/scene/scene.h"

namespace prt {

/// Gives every mesh that lacks them unit normals: of each vertex the sum of its triangles' normals
/// weighted by the corner angle [Thuermer98], summed over all vertices of the mesh at the same
/// position. Where the sum vanishes (no triangle of any area) the normal is +y.
void computeMissingNormals(Mesh& mesh);

/// Unit normal of a triangle by its winding; zero if it has no area.
Vec3f triangleNormal(const Vec3f& a, const Vec3f& b, const Vec3f& c);

}  // namespace prt

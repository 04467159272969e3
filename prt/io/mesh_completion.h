#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prt/scene/scene.h"

namespace prt {

/// Cuts a polygon into count − 2 triangles and appends their corners, numbered as in the polygon.
///
/// A convex polygon becomes a fan; a concave one loses one ear after the other
/// [Meisters75], seen along its area vector. Polygons that cross themselves become some
/// triangulation of their corners.
///
/// @param corners  at least three
void triangulatePolygon(std::span<const Vec3f> corners, std::vector<std::uint32_t>& triangles);

/// Makes every normal of a mesh unit. Those that are zero or not finite, and all if there are none,
/// are computed from the triangles.
///
/// @return  how many given normals had to be replaced
std::size_t completeNormals(Mesh& mesh);

}  // namespace prt

#pragma once

#include <array>
#include <vector>

#include "prt/scene/scene.h"

namespace prt {

// Grids from which the procedural scenes are put together. Grids that share an edge and cut it into
// as many cells have the same points on it to the last bit, whichever way round each runs along it:
// surfaces that touch are joined by their positions.

/// Points along a line; a loop does not repeat its first point.
using Polyline = std::vector<Vec3f>;

/// Four corners, counter-clockwise seen from the front.
using Quad = std::array<Vec3f, 4>;

/// Appends positions, normals and triangles; the mesh's own vertices keep their numbers.
void appendMesh(Mesh& mesh, const Mesh& addition);

/// Makes the mesh be seen from its other side.
void turnInsideOut(Mesh& mesh);

/// A grid over a planar quad, with the edges 0-1 and 2-3 cut into `alongCount` cells and the others
/// into `acrossCount`.
void appendQuad(Mesh& mesh, const Quad& quad, int alongCount, int acrossCount);

/// A planar triangle, each edge cut into `cellCount`.
void appendTriangle(Mesh& mesh, const std::array<Vec3f, 3>& corners, int cellCount);

/// The planar surface between two closed loops of equally many points, both counter-clockwise seen
/// from the front: a floor with a hole.
void appendRing(Mesh& mesh, const Polyline& outer, const Polyline& inner, int cellCount);

/// The four sides of a prism that stands on `base`, counter-clockwise seen from above.
void appendPrismSides(Mesh& mesh, const Quad& base, float height, int cellsAround, int cellsUp);

/// A smooth upright tube between two horizontal circles, seen from outside.
struct Taper {
    Vec3f baseCenter{0.0f, 0.0f, 0.0f};
    float height = 1.0f;
    float baseRadius = 1.0f;
    float topRadius = 1.0f;
};
void appendTaper(Mesh& mesh, const Taper& taper, int cellsAround, int cellsUp);

/// The edges of a quad, each cut into `cellCount`.
Polyline quadLoop(const Quad& quad, int cellCount);

/// A horizontal circle, counter-clockwise seen from above; its first point lies towards (−x, +z),
/// as the first corner of horizontalQuad.
Polyline circleLoop(const Vec3f& center, float radius, int pointCount);

/// A rectangle at a height, counter-clockwise seen from above, turned about its centre.
Quad horizontalQuad(const Vec3f& center, float width, float depth, float angleRadians = 0.0f);

}  // namespace prt

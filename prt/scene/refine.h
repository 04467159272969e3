#pragma once

#include <functional>

#include "prt/scene/scene.h"

namespace prt {

struct RefineOptions {
    float maxEdgeLength = 0.0f;               ///< metres; 0 chooses defaultMaxEdgeLength
    std::size_t maxVertexCount = 20'000'000;  ///< refuse to make more
};

/// One sixteenth of the radius of the scene's bounds: a floor as wide as the
/// scene gets some 30 × 30 cells.
float defaultMaxEdgeLength(const Scene& scene);

/// Splits every edge longer than the limit, so that large triangles can hold a shadow.
///
/// An edge is cut into equal halves until short enough, decided by its end positions alone:
/// triangles that share an edge cut it alike, across UV seams and meshes too, so no cracks open.
/// All vertex data is interpolated linearly and normals renormalised. Surfaces keep their shape;
/// meshes whose edges are short come back unchanged. An edge stays long only where floats are too
/// coarse to halve it.
///
/// @throws Error  limitExceeded when more than maxVertexCount vertices would be made
Scene refineEdges(const Scene& scene, const RefineOptions& options = {});

/// Whether to halve the edge between two positions. For no cracks to open it must not depend on
/// their order.
using EdgePredicate = std::function<bool(const Vec3f& a, const Vec3f& b)>;

/// An edge of a mesh, and the vertex that now stands in its middle.
struct SplitEdge {
    std::size_t mesh = 0;
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t middle = 0;
};

/// Halves, once, every edge that is picked and that floats are fine enough to halve. Vertices keep
/// their numbers; new ones stand after them.
///
/// @throws Error  limitExceeded when the meshes would come to more than maxVertexCount vertices
std::vector<SplitEdge> splitEdges(std::vector<Mesh>& meshes, const EdgePredicate& isPicked,
                                  std::size_t maxVertexCount = RefineOptions{}.maxVertexCount);

}  // namespace prt

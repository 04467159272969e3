#pragma once

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

}  // namespace prt

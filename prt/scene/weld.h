#pragma once

#include <cstdint>
#include <vector>

#include "prt/scene/scene.h"

namespace prt {

/// Groups vertices that receive the same light: equal in position and
/// in normal, over the whole scene.
struct Welding {
    std::vector<std::uint32_t>
        groupOfVertex;  ///< one a vertex of the scene, numbered mesh after mesh
    std::vector<std::uint32_t> vertexOfGroup;  ///< the first vertex of each group, ascending
};

/// Welds vertices whose positions and normals are equal to the last bit (−0 equals 0); UVs, colours
/// and materials may differ, except that a double-sided and a one-sided surface are never welded.
Welding weldVertices(const Scene& scene);

/// The same by position alone: the vertices that meet at a point, whatever their normals.
Welding weldPositions(const Scene& scene);

}  // namespace prt

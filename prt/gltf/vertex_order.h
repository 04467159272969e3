#pragma once

#include <cstdint>
#include <span>

#include "prt/scene/scene.h"

namespace prt {

/// Puts the triangles of each mesh, and then its vertices, in an order in which neighbours follow
/// one another: so that GlbOptions::meshopt encodes them in fewer bytes, and a GPU finds what they
/// share in its caches. Nothing is added or left out.
///
/// @param numbers  one a vertex of the scene, numbered mesh after mesh, such as its receiver; they
///                 go with their vertices
void orderForEncoding(Scene& scene, std::span<std::uint32_t> numbers);

}  // namespace prt

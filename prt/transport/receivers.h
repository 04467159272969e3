#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"

namespace prt {

/// A surface point that gathers light from the hemisphere about its normal.
struct Receiver {
    Vec3f origin{0.0f, 0.0f,
                 0.0f};  ///< tracer's space (RayScene::tracePoint), just off the surface
    Vec3f normal{0.0f, 1.0f, 0.0f};  ///< unit shading normal
    std::uint64_t randomStream = 0;  ///< its own, whatever the order of the receivers
};

/// The receivers of a scene: one for each group of vertices equal in position and normal, along a
/// Morton curve, so that neighbours in the list are neighbours in space.
struct Receivers {
    std::vector<Receiver> fronts;

    /// One a vertex of the scene, numbered mesh after mesh.
    std::vector<std::uint32_t> frontOfVertex;

    /// Those of a triangle's corners, mesh after mesh.
    std::vector<std::array<std::uint32_t, 3>> frontsOfTriangle;

    /// The other sides, where the material is double-sided: back i lies behind
    /// front i. Empty if no material is.
    std::vector<Receiver> backs;
};

/// Places the receivers.
///
/// A ray must start in free space, or it leaks through the surfaces that meet at its vertex. Where
/// surfaces meet (a corner of a room) the origin moves towards the side that is free of all of
/// them; at the rim of a surface (a floor under a wall) it also moves inwards by a thousandth of a
/// triangle, off whatever stands on the rim. Directions below the geometric surface then meet that
/// surface at once and are blocked, whatever the shading normal says (C11).
Receivers placeReceivers(const Scene& scene, const RayScene& rays);

}  // namespace prt

#pragma once

#include <cstddef>
#include <vector>

#include "prt/scene/scene.h"
#include "prt/scene/surface_color.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// Where a receiver is and what it is made of.
struct ReceiverSurface {
    Vec3f position{0.0f, 0.0f, 0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};  ///< unit
    std::size_t material = 0;        ///< index into Scene::materials
    MetallicRoughness surface{};
};

/// The receivers of an asset's scene, each as its first vertex is.
///
/// @param scene     textures decoded
/// @param transfer  of this scene
/// @return          transfer.receiverCount; of a vertex without a triangle the textures are not
///                  known and count as white
std::vector<ReceiverSurface> describeReceivers(const Scene& scene,
                                               const CompressedTransfer& transfer);

}  // namespace prt

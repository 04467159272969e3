#pragma once

#include <memory>
#include <span>

#include "prt/asset/asset.h"
#include "prt/math/transform.h"

namespace prt::viewer {

/// An asset that stands in the world.
struct PlacedAsset {
    std::shared_ptr<const Asset> asset;
    Affine3d worldFromObject{};  ///< a rotation and a translation
};

/// The same asset, object and not only equal, in the same place.
bool operator==(const PlacedAsset& a, const PlacedAsset& b);

/// All that the assets show, as one scene, without its cameras. Images have their pixels only.
///
/// @param assets  textures decoded
Scene assembleWorld(std::span<const PlacedAsset> assets);

}  // namespace prt::viewer

#pragma once

#include <filesystem>

#include "prt/asset/asset.h"
#include "prt/compress/compress_transfer.h"
#include "prt/scene/procedural.h"
#include "prt/transport/unshadowed.h"

namespace prt::test {

/// A white sphere that is relit in three bands, without shadows.
inline Asset makeSmallAsset() {
    Asset asset;
    asset.scene.materials.resize(1);
    asset.scene.meshes.push_back(makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 16));
    asset.transfer = compressTransfer(makeUnshadowedTransfer(asset.scene, 3));
    return asset;
}

inline void writeSmallAsset(const std::filesystem::path& path) {
    const Asset asset = makeSmallAsset();
    writeAsset(path, asset.scene, asset.transfer, asset.provenance);
}

}  // namespace prt::test

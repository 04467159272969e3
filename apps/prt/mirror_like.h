#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prt/asset/asset.h"

namespace prt::cli {

/// Materials whose lobes are too sharp for the bands of an asset's matrices.
struct MirrorLike {
    double leastRoughness = 0.0;  ///< those smoother than this, at any vertex
    std::vector<std::string> materials{};
    /// Whether the asset has what it takes to show the environment in them: the matrices of
    /// visibility alone.
    bool isSplitOff = false;
};

/// Nothing for an asset without matrices. @param asset  its textures are decoded if that is needed
std::optional<MirrorLike> findMirrorLike(Asset& asset);

}  // namespace prt::cli

#pragma once

#include <optional>
#include <string_view>

#include "prt/transfer/compressed_transfer.h"

namespace prt::cli {

/// How much of light transport is shown of an asset: a layer of it, or what follows from its
/// normals alone, without shadows.
enum class ShownTransport {
    unshadowed,  ///< of diffuse surfaces: from normals
    shadowed,
    interreflected,
    glossyUnshadowed,  ///< of surfaces as they are: from normals
    glossyShadowed,
    glossy,
};

inline constexpr const char* kShownTransportForms =
    "unshadowed|shadowed|interreflected|glossy-unshadowed|glossy-shadowed|glossy";

std::string_view shownTransportName(ShownTransport shown);
std::optional<ShownTransport> parseShownTransport(std::string_view name);

/// Whether surfaces are shown as they are, not as if they were diffuse.
bool isGlossy(ShownTransport shown);

/// Whether it has bounces.
bool hasBounces(ShownTransport shown);

/// The layer that is shown; none for what normals tell where the asset has no such layer.
const CompressedLayer* findShownLayer(const CompressedTransfer& transfer, ShownTransport shown);

/// Whether an asset can show it.
bool isAvailable(const CompressedTransfer& transfer, ShownTransport shown);

/// The most that an asset can show of the layers it was baked with.
ShownTransport fullestShown(const CompressedTransfer& transfer);

}  // namespace prt::cli

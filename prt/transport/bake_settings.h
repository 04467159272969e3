#pragma once

#include <span>
#include <vector>

#include "prt/transport/bake.h"
#include "prt/transport/checkpoint.h"

namespace prt {

/// All that decides the bits of a bake: options, instruction set, ray tracer, what the caller adds,
/// and fingerprints of the scene's geometry, materials and textures.
///
/// Thread count, memory and folders do not.
std::vector<Setting> bakeSettings(const Scene& scene, const BakeOptions& options, Isa isa);

/// Sets the options that bakeSettings has written down.
///
/// @param settings  from a file
/// @throws Error    malformed if one is missing or makes no sense
void applyBakeSettings(std::span<const Setting> settings, BakeOptions& options);

/// @throws Error  malformed if there is none of that name
const std::string& findSetting(std::span<const Setting> settings, std::string_view name);

}  // namespace prt

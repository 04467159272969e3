#pragma once

#include <span>
#include <string>

#include "prt/gltf/glb_layout.h"
#include "prt/gltf/glb_writer.h"

namespace prt::gltf {

/// The JSON of a binary glTF.
///
/// @param extension  may be null
/// @param checksums  of the layout's views, as formatChecksum writes them
/// @throws Error     malformed if a number of the scene is not finite
std::string describeGlb(const Scene& scene, const GlbExtension* extension, const GlbLayout& layout,
                        std::span<const std::string> checksums);

}  // namespace prt::gltf

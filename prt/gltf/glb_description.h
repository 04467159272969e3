#pragma once

#include <string>

#include "prt/gltf/glb_layout.h"
#include "prt/gltf/glb_storage.h"
#include "prt/gltf/glb_writer.h"

namespace prt::gltf {

/// The JSON of a binary glTF.
///
/// @param extension  may be null
/// @param storage    of the layout's views
/// @throws Error     malformed if a number of the scene is not finite
std::string describeGlb(const Scene& scene, const GlbExtension* extension, const GlbLayout& layout,
                        const GlbStorage& storage, const GlbOptions& options);

}  // namespace prt::gltf

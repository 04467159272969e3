#pragma once

#include "prt/gltf/gltf_document.h"
#include "prt/gltf/model.h"

namespace prt::gltf {

/// The model's scene in world space.
///
/// @throws Error  as readGltf, without the file's name
FlattenedGltf flattenModel(const Model& model);

}  // namespace prt::gltf

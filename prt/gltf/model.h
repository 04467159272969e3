#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prt/gltf/accessor.h"
#include "prt/gltf/buffers.h"
#include "prt/gltf/cameras.h"
#include "prt/gltf/gltf_document.h"
#include "prt/gltf/gltf_file.h"
#include "prt/gltf/json_cursor.h"
#include "prt/gltf/materials.h"
#include "prt/gltf/node_tree.h"
#include "prt/gltf/primitives.h"
#include "prt/gltf/resource_loader.h"
#include "prt/gltf/warnings.h"

namespace prt::gltf {

/// A glTF file taken apart: every index between its parts is valid
/// and every accessor has its bytes.
struct Model {
    /// @throws Error  as readGltf, without the file's name
    ///
    /// @param folder  where the buffers and images that the file names must lie
    Model(std::vector<std::byte> fileBytes, const std::filesystem::path& folder,
          const GltfLimits& limits);

    JsonCursor root() const { return {json, ""}; }

    GltfLimits limits;
    GltfFile file;
    Json json;
    ResourceLoader loader;
    Warnings warnings;
    Buffers buffers;
    std::vector<Accessor> accessors;
    MaterialTable materials;
    std::vector<MeshRecord> meshes;
    std::vector<CameraRecord> cameras;
    NodeTree nodeTree;
};

}  // namespace prt::gltf

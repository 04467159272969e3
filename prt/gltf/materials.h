#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "prt/gltf/buffers.h"
#include "prt/gltf/json_cursor.h"
#include "prt/gltf/resource_loader.h"
#include "prt/gltf/warnings.h"
#include "prt/scene/scene.h"

namespace prt::gltf {

/// Where a UV set of a mesh comes from: TEXCOORD_n, mapped as KHR_texture_transform asks.
struct UvSource {
    std::size_t texCoord = 0;
    std::array<double, 4> linear{1.0, 0.0, 0.0, 1.0};  ///< row-major
    std::array<double, 2> offset{0.0, 0.0};

    bool operator==(const UvSource&) const = default;
    bool isMapped() const { return *this != UvSource{texCoord}; }
};

struct MaterialRecord {
    Material material;  ///< its textures' images are indices into MaterialTable::images
    std::array<UvSource, 2> uvSources{UvSource{0}, UvSource{1}};  ///< of the two UV sets
};

/// The file's materials, and the images that they use.
struct MaterialTable {
    std::vector<MaterialRecord> records;
    std::vector<std::size_t> images;  ///< indices into the file's images, each once
};

MaterialTable parseMaterials(const JsonCursor& root, Warnings& warnings);

/// What glTF gives a primitive without a material.
Material defaultMaterial();

/// Fetches images, still encoded.
///
/// @param images  indices into the file's images
std::vector<TextureImage> loadImages(const JsonCursor& root, const std::vector<std::size_t>& images,
                                     const std::vector<BufferView>& views, ResourceLoader& loader);

}  // namespace prt::gltf

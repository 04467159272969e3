#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "prt/gltf/gltf_scene.h"

namespace prt {

enum class ComponentType { int8, uint8, int16, uint16, uint32, float32 };

struct AccessorInfo {
    std::size_t count = 0;
    int componentCount = 1;  ///< 1 … 16; 0 for a type that glTF 2.0 does not know
    ComponentType type = ComponentType::float32;
    bool normalized = false;

    bool operator==(const AccessorInfo&) const = default;
};

/// One primitive of the file, before instances are flattened.
struct PrimitiveId {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
};

/// The scene, and for each of its meshes the primitive it came from.
struct FlattenedGltf {
    Scene scene;
    /// Vertex i of the scene's mesh is element i of the primitive's attributes.
    std::vector<PrimitiveId> primitiveOfMesh;
};

/// A glTF file whose structure has been checked: every index between its parts is valid and every
/// accessor lies inside its buffer. For those who read more of a file than its scene.
class GltfDocument {
  public:
    /// @throws Error  as readGltf
    explicit GltfDocument(const std::filesystem::path& path, const GltfLimits& limits = {});
    /// The same from memory: the bytes of a .gltf or .glb.
    ///
    /// @param folder  where the buffers and images that it names lie
    GltfDocument(std::vector<std::byte> file, const std::filesystem::path& folder,
                 const GltfLimits& limits = {});
    ~GltfDocument();
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;

    FlattenedGltf flatten() const;

    /// The extension's JSON object on the root or on a primitive; nothing if absent.
    std::optional<std::string> rootExtension(std::string_view name) const;
    std::optional<std::string> primitiveExtension(const PrimitiveId& id,
                                                  std::string_view name) const;

    /// The accessor of a primitive's attribute, such as "_PRT_0"; nothing if absent.
    std::optional<std::size_t> attributeAccessor(const PrimitiveId& id,
                                                 std::string_view semantic) const;

    /// The functions below ask for a number less than this. An extension's JSON may name any
    /// number: its reader must compare.
    std::size_t accessorCount() const;
    AccessorInfo describeAccessor(std::size_t accessor) const;
    /// Components as numbers, normalised integers as their fractions; count × componentCount of
    /// them. All finite, else malformed.
    std::vector<float> readFloats(std::size_t accessor) const;
    /// Components as stored, tightly packed, little endian.
    std::vector<std::byte> readRaw(std::size_t accessor) const;

    /// As accessorCount.
    std::size_t bufferViewCount() const;
    /// None where the buffer is a placeholder, with neither a URI nor a binary chunk.
    std::span<const std::byte> bufferViewBytes(std::size_t bufferView) const;
    /// The same as the file has them: fewer where EXT_meshopt_compression encodes them.
    std::span<const std::byte> storedViewBytes(std::size_t bufferView) const;

    /// The bytes after the end that a binary glTF's header states.
    std::size_t trailingByteCount() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt

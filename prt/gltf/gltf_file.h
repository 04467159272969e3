#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace prt::gltf {

/// The bytes of a .gltf or .glb, and where its JSON and its binary chunk lie in them.
struct GltfFile {
    explicit GltfFile(std::vector<std::byte> fileBytes);
    GltfFile(const GltfFile&) = delete;
    GltfFile& operator=(const GltfFile&) = delete;

    const std::vector<std::byte> bytes;
    std::string_view json;
    bool isBinary = false;  ///< a .glb
    std::optional<std::span<const std::byte>> binaryChunk;
    std::size_t trailingByteCount = 0;  ///< after the end that the header states

  private:
    void splitChunks();
    std::uint32_t readWord(std::size_t offset) const;
};

}  // namespace prt::gltf

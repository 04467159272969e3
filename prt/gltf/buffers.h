#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "prt/gltf/gltf_file.h"
#include "prt/gltf/json_cursor.h"
#include "prt/gltf/resource_loader.h"

namespace prt::gltf {

/// A part of a buffer, whose bytes are known to be there, unless the buffer is a placeholder.
struct BufferView {
    std::span<const std::byte> bytes;        ///< empty in a placeholder, else byteLength of them
    std::span<const std::byte> storedBytes;  ///< the same as the file has them, maybe encoded
    std::size_t byteLength = 0;
    std::size_t byteOffset = 0;  ///< in its buffer
    std::size_t byteStride = 0;  ///< 0 where elements are tightly packed
};

/// The file's buffers and the views into them.
struct Buffers {
    std::vector<std::vector<std::byte>> loaded;   ///< empty for the one that is the binary chunk
    std::vector<std::vector<std::byte>> decoded;  ///< of views with EXT_meshopt_compression
    std::vector<BufferView> views;
};

/// @param file    outlives the result, whose views may point into its binary chunk
/// @throws Error  malformed, or limitExceeded for views that decode to more bytes than the buffers
///                could hold if each of their bytes were decoded once
Buffers loadBuffers(const JsonCursor& root, const GltfFile& file, ResourceLoader& loader);

}  // namespace prt::gltf

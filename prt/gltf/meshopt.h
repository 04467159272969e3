#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/gltf/json_cursor.h"

namespace prt::gltf {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// What the elements of an encoded buffer view are.
enum class MeshoptMode {
    attributes,  ///< of vertices: of 4, 8, … 256 bytes
    triangles,   ///< three indices each
    indices,     ///< of 2 or 4 bytes
};

/// What is done to decoded attributes.
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// A buffer view in the encoding of [EXT_meshopt_compression].
struct MeshoptView {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    std::size_t count = 0;
    std::size_t byteStride = 0;

    std::size_t decodedBytes() const { return count * byteStride; }
};

/// The most that an encoded byte can stand for: in attributes, two bits may be sixteen bytes.
inline constexpr std::size_t kMaxMeshoptRatio = 64;

/// @param object      the extension's object in a buffer view
/// @param byteLength  of that view
/// @throws Error      malformed for what the encoding does not have
MeshoptView parseMeshoptView(const JsonCursor& object, std::size_t byteLength);

/// The view's bytes. Memory is taken only where there is enough to decode.
///
/// @throws Error  malformed, without a place
std::vector<std::byte> decodeMeshopt(const MeshoptView& view, std::span<const std::byte> encoded);

/// Encodes attributes or triangles without loss and without a filter.
///
/// Triangles keep their order; the corners of one may start at another.
///
/// @param bytes  view.decodedBytes() of them
std::vector<std::byte> encodeMeshopt(const MeshoptView& view, std::span<const std::byte> bytes);

const char* meshoptModeName(MeshoptMode mode);

}  // namespace prt::gltf

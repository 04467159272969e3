#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "prt/gltf/gltf_document.h"
#include "prt/scene/scene.h"

namespace prt {

/// One more accessor of the file. Its values are asked for once there is room for them in the
/// file's memory, so that large ones are never held twice.
struct GlbAccessor {
    std::string name;  ///< the semantic of a vertex attribute, "_PRT_0"; else for complaints only
    AccessorInfo info;
    /// Writes all values, tightly packed and little endian, into the span, which has just the room.
    std::function<void(std::span<std::byte> values)> write;
};

/// What an extension adds to a plain scene file.
struct GlbExtension {
    std::string name;
    std::string rootJson;                              ///< the root's extension object
    std::vector<GlbAccessor> accessors;                ///< of no mesh; the file's 0, 1, …
    std::vector<std::string> meshJson;                 ///< one object a mesh of the scene
    std::vector<std::vector<GlbAccessor>> attributes;  ///< for each mesh
};

struct GlbOptions {
    /// Encodes vertex attributes and indices without loss, those that take fewer bytes so. Readers
    /// must then know EXT_meshopt_compression. Triangles stay in order; their corners may start at
    /// another. Much more is gained after orderForEncoding.
    bool meshopt = false;
    /// Has viewers show base colour × texture × vertex colour as they are and add no light of their
    /// own, those that know KHR_materials_unlit; the others show what the material says.
    bool unlit = false;
};

/// A CRC-32 as the extension's checksums write it: eight lower-case hexadecimal digits.
std::string formatChecksum(std::uint32_t crc32);

/// The scene as a binary glTF: one node and one mesh with one primitive for each mesh of
/// the scene, materials, images as they came, cameras. Passes the Khronos validator
/// without errors or warnings. Meshes without a triangle are left out, and colour factors
/// are clamped to what glTF allows.
///
/// @param extension  optional; listed in extensionsUsed, never in extensionsRequired. Its root
///                   object is given a member "checksums", an array with the CRC-32 of each buffer
///                   view as stored, and each of its mesh objects one that maps the mesh's
///                   attributes to those of their values
/// @throws Error     malformed if the scene holds a number that is not finite; limitExceeded beyond
///                   the 4 GiB that a binary glTF can have
std::vector<std::byte> encodeGlb(const Scene& scene, const GlbExtension* extension = nullptr,
                                 const GlbOptions& options = {});

/// Writes the same atomically, with no more of it in memory than the largest of its parts.
/// @throws Error as encodeGlb, and writeFailed
void writeGlb(const std::filesystem::path& path, const Scene& scene,
              const GlbExtension* extension = nullptr, const GlbOptions& options = {});

}  // namespace prt

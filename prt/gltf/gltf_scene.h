#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "prt/scene/scene.h"

namespace prt {

/// What a reader refuses before it allocates.
struct GltfLimits {
    std::uintmax_t maxFileBytes = 8'589'934'592;  ///< the glTF with its buffers and images
    std::size_t maxVertexCount = 200'000'000;     ///< after instances are flattened
    std::size_t maxIndexCount = 600'000'000;
    std::size_t maxMeshCount = 1'000'000;
    /// Of an accessor without a buffer view: a short text can claim any number of zeros.
    std::size_t maxZeroElementCount = 1'000'000;
    int maxNodeDepth = 256;
};

/// Reads a .gltf or .glb as one flattened scene in world space [glTF 2.0].
///
/// Triangles, strips and fans; sparse, interleaved and normalised accessors; KHR_mesh_quantization;
/// EXT_meshopt_compression; KHR_texture_transform; node hierarchies with any invertible transform
/// (a mirrored node's triangles are turned so that they stay counter-clockwise); cameras; embedded
/// and neighbouring buffers and images. Missing normals are computed. Images stay encoded; only
/// those that a material's base colour or emission uses are kept.
///
/// Left out, with a warning: points and lines, animation, skins, morph targets, cameras that are
/// no pinhole, optional extensions, and nodes whose transform has no inverse. Factors and vertex
/// colours out of range are clamped, with a warning.
///
/// @throws Error  notFound, unreadable, malformed, unsupported (a required extension, a URI that
///                leaves the file's folder) or limitExceeded: every count, offset, index, number
///                and URI is checked before use
Scene readGltf(const std::filesystem::path& path, const GltfLimits& limits = {});

}  // namespace prt

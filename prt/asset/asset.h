#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "prt/scene/scene.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// How an asset was made: with the scene, enough to make it again.
struct Provenance {
    std::string generator;  ///< "OpenPRT 0.1.0"
    std::string command;    ///< the options of the bake, without paths
    int sampleCount = 0;
    int bounceCount = 0;  ///< bounces made; 0 where none was asked for
    std::uint64_t seed = 0;
    std::string isa;  ///< isaName of the instruction set (C10)
};

/// A baked scene: a plain glTF scene, and with it the transfer of its vertices (docs/format.md).
struct Asset {
    Scene scene;
    CompressedTransfer
        transfer;  ///< receivers are the scene's vertices: receiverOfVertex is the identity
    Provenance provenance;
};

/// The version of the format that this library writes; it reads all
/// versions with the same major number.
inline constexpr int kAssetVersionMajor = 1;
inline constexpr int kAssetVersionMinor = 2;

struct AssetOptions {
    bool meshopt = false;  ///< as GlbOptions::meshopt; all numbers stay as they are
};

/// The bytes of a .prt.glb: glTF with the extension OPENPRT_radiance_transfer.
///
/// @param transfer  of this scene: receiverOfVertex has one entry a vertex
/// @throws Error    limitExceeded for more than the 4 GiB that a binary glTF can have, and for more
///                  than 65536 clusters (256 where weights are bytes) or 255 components in one
std::vector<std::byte> encodeAsset(const Scene& scene, const CompressedTransfer& transfer,
                                   const Provenance& provenance, const AssetOptions& options = {});

/// Writes them atomically. @throws Error as encodeAsset, and writeFailed
void writeAsset(const std::filesystem::path& path, const Scene& scene,
                const CompressedTransfer& transfer, const Provenance& provenance,
                const AssetOptions& options = {});

/// Reads and checks a .prt.glb. Images stay encoded.
///
/// @throws Error  notFound, unreadable, malformed (a checksum that differs, among others), or
///                unsupported: another major version, a glTF without the extension
Asset readAsset(const std::filesystem::path& path);

/// The same from memory: what encodeAsset made.
///
/// @param path  how errors call it; buffers and images that it names lie in this path's folder
Asset decodeAsset(std::vector<std::byte> file, const std::filesystem::path& path);

}  // namespace prt

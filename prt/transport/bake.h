#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "prt/math/isa.h"
#include "prt/parallel/progress.h"
#include "prt/scene/scene.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// Bounces until nothing changes any more.
inline constexpr int kInfiniteBounces = -1;

struct BakeOptions {
    Transport transport = Transport::interreflected;  ///< the layers up to this one are baked
    int bandCount = 5;                                ///< 1 … kMaxBandCount
    int sampleCount = 1024;                           ///< rays a receiver, 16 … 65536
    int bounceCount = 2;  ///< indirect bounces (C8), or kInfiniteBounces
    std::uint64_t seed = 1;
    int threadCount = 0;  ///< 0: one a core
    std::size_t memoryBytes = std::size_t(8)
                              << 30;  ///< for the hits of the rays; beyond it they go to disk
    std::filesystem::path
        scratchFolder{};       ///< where; empty: the system's folder for temporary files
    std::optional<Isa> isa{};  ///< pins the instruction set (C10); default: the widest
    ProgressCallback progress{};
};

/// Where the time went and how much there was to do.
struct BakeStats {
    double buildSeconds = 0.0;  ///< acceleration structure and receivers
    double traceSeconds =
        0.0;  ///< occlusion rays, their directions and the closest hits, all threads' sum / threads
    double accumulateSeconds = 0.0;  ///< spherical harmonics of the visible directions, likewise
    double bounceSeconds = 0.0;
    std::uint64_t rayCount = 0;
    std::uint64_t hitCount = 0;
    std::uint64_t invalidRayCount = 0;  ///< rays that were not finite, and so counted as blocked
    std::size_t receiverCount = 0;
    int bounceCount = 0;       ///< bounces made
    std::size_t hitBytes = 0;  ///< the bounce matrix
    Isa isa = Isa::sse4;
};

/// Bakes the diffuse transfer of every vertex of a scene, once for any distant light.
///
/// Rays are traced once, whatever the number of bounces: a bounce multiplies the transfer of all
/// receivers by the sparse matrix of the rays' hits [Sloan02, 5; docs/architecture.md, "Bounces are
/// a sparse matrix"].
///
/// @param scene    as its reader promises; textures decoded
/// @param options  ranges as stated; out of range is an Error{invalidOption}
/// @param stats    filled if given
/// @throws Error   invalidOption, cancelled, outOfMemory, or writeFailed for the scratch folder
TransferField bakeTransfer(const Scene& scene, const BakeOptions& options = {},
                           BakeStats* stats = nullptr);

}  // namespace prt

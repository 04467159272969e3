#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "prt/math/isa.h"
#include "prt/parallel/progress.h"
#include "prt/scene/scene.h"
#include "prt/transfer/transfer_field.h"
#include "prt/transport/checkpoint.h"
#include "prt/transport/reflection.h"

namespace prt {

/// Bounces until nothing changes any more.
inline constexpr int kInfiniteBounces = -1;

/// Whether light bounces from surface to surface in a bake of this transport.
bool hasBounces(Transport transport);

/// Keeps what is finished, so that a bake that was killed goes on where it was. The result is the
/// same to the last bit, with or without, however often it was killed.
struct CheckpointOptions {
    std::filesystem::path folder{};                     ///< made if missing; empty: nothing is kept
    std::vector<std::filesystem::path> otherFolders{};  ///< units are read from these too
    bool requireFronts = false;  ///< the units that bakeUnits makes must be there: for merging
    /// What made the scene what it is and the reflection, and which program bakes: a resume
    /// with other settings is refused by their names.
    std::vector<Setting> callerSettings{};
};

/// What a bake takes, told before its long part begins.
struct BakeForecast {
    std::size_t receiverCount = 0;
    std::uint64_t rayCount = 0;   ///< as if endless bounces of glossy light were ten
    std::size_t memoryBytes = 0;  ///< of the whole process
    std::size_t diskBytes = 0;    ///< for a checkpoint, and for what has no room in memory
    std::size_t unitCount = 0;    ///< that bakeUnits can make; 0 without a checkpoint
};

struct BakeOptions {
    /// With unshadowed that layer alone; with glossyShadowed shadowed transfer too; else all but
    /// unshadowed up to this one.
    Transport transport = Transport::interreflected;
    int bandCount = 5;          ///< n: 1 … kMaxBandCount
    int incidentBandCount = 5;  ///< n_in ≥ 1 of matrices, n_in + n − 1 ≤ kMaxBandCount
    int sampleCount = 1024;     ///< rays a receiver, 16 … 65536
    int bounceCount = 2;        ///< indirect bounces (C8), or kInfiniteBounces
    /// Of the surfaces, where light bounces into matrices; empty: gltfReflection.
    SurfaceReflection reflection{};
    std::uint64_t seed = 1;
    int threadCount = 0;  ///< 0: one a core
    /// What the process may have in all; hits and transfer beyond it go to disk, without changing
    /// a bit. What the bake cannot do without, it takes: the forecast says how much that is.
    /// 0: 512 MiB, 200 bytes a triangle, 16 a vertex and what textures take.
    std::size_t memoryBytes = 0;
    std::filesystem::path scratchFolder{};  ///< there; empty: the system's
    std::optional<Isa> isa{};               ///< pins the instruction set (C10); default: the widest
    CheckpointOptions checkpoint{};
    std::function<void(const BakeForecast&)> announce{};  ///< may throw, and so refuse
    ProgressCallback progress{};
};

/// Where the time went and how much there was to do.
struct BakeStats {
    double buildSeconds = 0.0;  ///< acceleration structure and receivers
    double traceSeconds =
        0.0;  ///< occlusion rays, their directions and the closest hits, all threads' sum / threads
    double accumulateSeconds = 0.0;  ///< spherical harmonics of the visible directions, likewise
    double bounceSeconds = 0.0;      ///< without the rays that are traced for them
    std::uint64_t rayCount = 0;
    std::uint64_t hitCount = 0;
    std::uint64_t invalidRayCount = 0;  ///< rays that were not finite, and so counted as blocked
    std::size_t receiverCount = 0;
    int bounceCount = 0;                  ///< bounces made, of vectors or matrices
    std::size_t hitBytes = 0;             ///< the bounce matrix
    std::size_t resumedUnitCount = 0;     ///< units of rays that a checkpoint had
    std::vector<std::string> warnings{};  ///< files of a checkpoint that were damaged
    Isa isa = Isa::sse4;
};

/// Bakes the transfer of every vertex of a scene, once for any distant light.
///
/// Rays of vectors are traced once, whatever the number of bounces: a bounce multiplies the
/// transfer of all receivers by the sparse matrix of the rays' hits [Sloan02, 5;
/// docs/architecture.md, "Bounces are a sparse matrix"]. Matrices are gathered after them
/// (TransferMatrices), with rays of their own for each bounce.
///
/// @param scene    as its reader promises; textures decoded
/// @param options  ranges as stated; out of range is an Error{invalidOption}
/// @param stats    filled if given
/// @throws Error   invalidOption (also for a checkpoint of another bake), cancelled, outOfMemory,
///                 notFound for units that are
///                 required, or writeFailed for the scratch folder and the checkpoint's
TransferField bakeTransfer(const Scene& scene, const BakeOptions& options = {},
                           BakeStats* stats = nullptr);

/// Units [begin, end).
struct UnitRange {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// What bakeUnits has made, and what others have to.
struct UnitReport {
    std::size_t unitCount = 0;         ///< of the whole work
    std::size_t missingUnitCount = 0;  ///< that have no file in the folder
    std::vector<std::string> warnings{};
};

/// Makes a share of a bake's units into the folder of a checkpoint, for machines that work side by
/// side: bakeTransfer with the same options then makes the rest, or puts all together.
///
/// Not of glossy transport. A unit is the rays of some receivers' fronts. A unit that is made
/// twice, or by two at once, is the same.
///
/// @param units   those beyond the last are none
/// @throws Error  as bakeTransfer
UnitReport bakeUnits(const Scene& scene, const BakeOptions& options, UnitRange units);

}  // namespace prt

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prt/math/isa.h"
#include "prt/parallel/progress.h"
#include "prt/scene/scene.h"
#include "prt/transfer/coefficient_table.h"
#include "prt/transport/gather.h"
#include "prt/transport/reflection.h"

namespace prt {

/// From distant light to the radiance that comes in at each receiver of a scene:
///
///   M_ij(x) = ∫ y_i(R_x ω) (V(x, ω) y_j(ω) + (1 − V(x, ω)) E_j(x, ω)) dω           [Sloan02, 5]
///
/// over the hemisphere about the receiver's normal. i counts incident radiance in the local frame
/// (frameFromNormal, normal = +z), j light in the world's. E_j is what the surface seen along ω
/// reflects of y_j: nothing without bounces.
///
/// Row (1, 0) times kLambertResponse is the diffuse transfer vector (C6).
struct TransferMatrices {
    int incidentBandCount = 0;                    ///< n_in: a matrix has n_in² rows
    int bandCount = 0;                            ///< n: and n² columns
    std::vector<std::uint32_t> receiverOfVertex;  ///< one a vertex of the scene, mesh after mesh
    int channelCount = 1;                         ///< 1: the same for all; 3: coloured by bounces
    CoefficientTable matrices;  ///< of floats: a row is [channel][i][j] of one receiver
};

struct TransferMatrixOptions {
    int incidentBandCount = 5;  ///< n_in and n: at least 1, and n_in + n − 1 ≤ kMaxBandCount
    int bandCount = 5;
    int sampleCount = 1024;  ///< rays a receiver, 16 … 65536
    int bounceCount = 0;     ///< diffuse and glossy ones, or kInfiniteBounces
    SurfaceReflection
        reflection{};  ///< of the surfaces; empty: lambertReflection, for which n_in ≥ 2
    std::uint64_t seed = 1;
    int threadCount = 0;       ///< 0: one a core
    std::optional<Isa> isa{};  ///< pins the instruction set (C10); default: the widest
    TableStorage storage{};
    ProgressCallback progress{};
};

/// Checks that n_in + n − 1 ≤ kMaxBandCount, n_in, n ≥ 1. @throws Error  invalidOption
void checkMatrixBands(int incidentBandCount, int bandCount);

/// Where the time of all threads went. Matrices are made within accumulateSeconds; traceSeconds is
/// that of bare occlusion rays, and for bounces of the closest hits.
struct TransferMatrixStats {
    GatherCounts counts{};
    std::size_t receiverCount = 0;
};

/// Bakes the transfer matrix of every receiver, with rays uniform over its hemisphere.
///
/// Rays below the geometric surface are blocked, as for transfer vectors (C11). Rays are traced
/// again for each bounce rather than kept: b bounces are M ← M⁽⁰⁾ + F(M), b times. A bounce holds
/// the matrices before and after it in memory, each 12 n_in² n² bytes a receiver; bakeTransfer
/// makes the same of as many columns at a time as have room.
///
/// @param scene   as its reader promises; textures decoded
/// @param stats   filled if given
/// @throws Error  invalidOption, cancelled, outOfMemory, or writeFailed for the scratch folder
TransferMatrices bakeTransferMatrices(const Scene& scene, const TransferMatrixOptions& options = {},
                                      TransferMatrixStats* stats = nullptr);

}  // namespace prt

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "prt/math/isa.h"
#include "prt/scene/scene.h"
#include "prt/transfer/coefficient_table.h"
#include "prt/transport/gather.h"

namespace prt {

/// From distant light to the radiance that comes in at each receiver of a scene:
///
///   M_ij(x) = ∫ y_i(R_x ω) V(x, ω) y_j(ω) dω                                        [Sloan02, 5]
///
/// over the hemisphere about the receiver's normal. i counts incident radiance in the local frame
/// (frameFromNormal, normal = +z), j light in the world's.
struct TransferMatrices {
    int incidentBandCount = 0;                    ///< n_in: a matrix has n_in² rows
    int bandCount = 0;                            ///< n: and n² columns
    std::vector<std::uint32_t> receiverOfVertex;  ///< one a vertex of the scene, mesh after mesh
    CoefficientTable matrices;                    ///< of floats: a row is [i][j] of one receiver
};

struct TransferMatrixOptions {
    int incidentBandCount = 5;  ///< n_in and n: at least 1, and n_in + n − 1 ≤ kMaxBandCount
    int bandCount = 5;
    int sampleCount = 1024;  ///< rays a receiver, 16 … 65536
    std::uint64_t seed = 1;
    int threadCount = 0;       ///< 0: one a core
    std::optional<Isa> isa{};  ///< pins the instruction set (C10); default: the widest
    TableStorage storage{};
};

/// Where the time of all threads went. A matrix is made within accumulateSeconds; traceSeconds is
/// that of bare occlusion rays.
struct TransferMatrixStats {
    GatherCounts counts{};
    std::size_t receiverCount = 0;
};

/// Bakes the shadowed transfer matrix of every receiver, with rays uniform over its hemisphere.
///
/// Rays below the geometric surface are blocked, as for transfer vectors (C11).
///
/// @param scene   as its reader promises; textures decoded
/// @param stats   filled if given
/// @throws Error  invalidOption, or writeFailed for the scratch folder
TransferMatrices bakeTransferMatrices(const Scene& scene, const TransferMatrixOptions& options = {},
                                      TransferMatrixStats* stats = nullptr);

}  // namespace prt

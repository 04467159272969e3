#pragma once

#include "prt/parallel/progress.h"
#include "prt/transfer/coefficient_table.h"
#include "prt/transport/checkpoint.h"
#include "prt/transport/hit_matrix.h"

namespace prt {

/// Transfer without bounces, of one channel.
struct DirectTransfer {
    CoefficientTable fronts;
    CoefficientTable backs{};  ///< back i lies behind front i; as many, or none
    bool isFromBacks = false;  ///< whether any light comes from backs

    /// Fronts, and backs if light comes from any: what a bounce is between.
    std::size_t receiverCount() const {
        return fronts.rowCount() + (isFromBacks ? backs.rowCount() : 0);
    }
};

struct BounceOptions {
    int bounceCount = 2;  ///< or kInfiniteBounces
    int threadCount = 0;
    /// A bounce needs the transfer of all receivers in memory, but no more than so many columns of
    /// it at a time, in blocks of kLaneMultiple.
    std::size_t blocksAtOnce = SIZE_MAX;
    const ProgressCallback& progress;
    Checkpoint* checkpoint = nullptr;  ///< if given, each bounce's units are kept there
};

/// Adds the bounces to direct transfer: T = T⁽⁰⁾ + F T⁽⁰⁾ + F² T⁽⁰⁾ + …, where row x of F holds the
/// albedo and the corner weights at what the rays of receiver x have hit [Sloan02, 5;
/// Dachsbacher17].
///
/// With kInfiniteBounces the series ends when a bounce's largest coefficient 0 is below 1e-6 of the
/// direct one's, or after 10000 bounces.
///
/// @param matrix    sorted, if there is a checkpoint
/// @param total     zeros, written: the sum at the fronts, [channel][coefficient]; what is between
///                  is kept where it is
/// @return          the number of bounces made
int addBounces(const HitMatrix& matrix, const DirectTransfer& direct, const GatherKernels& kernels,
               const BounceOptions& options, CoefficientTable& total);

}  // namespace prt

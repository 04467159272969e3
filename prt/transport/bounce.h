#pragma once

#include "prt/parallel/progress.h"
#include "prt/transport/checkpoint.h"
#include "prt/transport/hit_matrix.h"

namespace prt {

struct BounceOptions {
    int bandCount = 5;
    int bounceCount = 2;  ///< or kInfiniteBounces
    int threadCount = 0;
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
/// @param direct    [receiver][coefficient], one channel
/// @param total     written: [receiver][channel][coefficient] of the first receivers
/// @return          the number of bounces made
int addBounces(const HitMatrix& matrix, std::span<const float> direct, const GatherKernels& kernels,
               const BounceOptions& options, std::span<float> total);

}  // namespace prt

#pragma once

#include <span>

#include "prt/math/vector.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// How far the coefficients of one layer are from those of another.
struct CompressionError {
    double rmse = 0.0;          ///< over all receivers, channels and coefficients
    double relativeRmse = 0.0;  ///< over the root mean square of the original; 0 if that is 0
    double largest = 0.0;       ///< of a single coefficient
    double seen = 0.0;  ///< under a light: the root mean square of the radiance's error Σ_i e_i
                        ///< L_i, over the mean radiance Σ_i T_i L_i; 0 if that is 0. Of matrices,
                        ///< of incident radiance
};

/// Measures what reading the stored numbers back gives.
///
/// What is seen is the expectation over all receivers and channels with the light turned at random:
/// its square is the mean of Σ_i w_i² e_i² with the weights of lightErrorWeights, and the mean
/// radiance that of T_0 L_0, as all else averages to nothing.
///
/// Of matrices it is incident radiance, all over the hemisphere: its squared error is at most
/// Σ_i (Σ_j e_ij L_j)² / 2π on average, its mean l_00/√π, since what comes in comes from above.
///
/// @param compressed, original  of the same receivers, channels and coefficients
/// @param light                 n² coefficients or fewer bands, not all 0; empty: none
CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const CompressedLayer& original,
                                         std::span<const Vec3d> light = {});
CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const TransferLayer& original,
                                         std::span<const Vec3d> light = {});

}  // namespace prt

#pragma once

#include <cstddef>
#include <cstdint>

#include "prt/transfer/stored_table.h"

namespace prt {

/// Matrices as sums of those of their clusters.
struct ClusteredMatrices {
    TransferEncoding encoding = TransferEncoding::float32;  ///< of weights
    std::size_t componentCount = 0;                         ///< the most that a cluster has
    const std::uint32_t* clusters = nullptr;                ///< of each matrix
    const std::byte* weights = nullptr;                     ///< [matrix][component]
    const std::uint32_t* firstVectors = nullptr;  ///< of each cluster, and behind them of none
};

/// Adds up R_k0 + Σ_p w_p R_kp for matrices from the first on.
///
/// @param vectorSize  floats of one R, a multiple of 16
/// @param products    R_k0, and for each component R_kp over the stored number that stands for 1;
///                    aligned to 64 bytes
/// @param stride      floats from one matrix's incident radiance to the next's
/// @param incident    vectorSize floats a matrix, written
void weighProducts(const ClusteredMatrices& matrices, const float* products, std::size_t vectorSize,
                   std::size_t matrixCount, std::size_t stride, float* incident);

}  // namespace prt

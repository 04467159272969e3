#pragma once

#include <array>
#include <cstddef>

#include "prt/basis/sh.h"
#include "prt/math/vector.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// Vectors are multiplied in blocks of as many.
inline constexpr std::size_t kRelightBlockSize = 16;

/// Lighting with the scale and bias of the stored transfer folded in, so that the stored numbers q
/// are multiplied as they are:
///
///   Σ_i (b_i + s_i q_i) L_i  =  Σ_i b_i L_i  +  Σ_i q_i (s_i L_i)
struct FoldedLight {
    std::size_t coefficientCount = 0;
    std::array<Vec3f, shCoefficientCount(kMaxBandCount)> coefficients;  ///< s_i L_i
    Vec3f constant{0.0f, 0.0f, 0.0f};                                   ///< Σ_i b_i L_i
};

/// Transfer as the kernel reads it: for every 16 receivers a block
/// [coefficient][channel][16 lanes], the last one filled up. Fewer bands of light than of
/// transfer then read the front of each block.
struct TransferBlocks {
    TransferEncoding encoding = TransferEncoding::float32;
    std::size_t channelCount = 1;
    std::size_t coefficientCount = 0;
    const std::byte* data = nullptr;  ///< aligned to 64 bytes
};

/// How results are written.
enum class ResultStore {
    cached,     ///< through the caches: for results that stay there until they are read
    streaming,  ///< past the caches: saves reading what is about to be overwritten
};

/// Writes the outgoing radiance of `receiverCount` receivers from the first block on.
void relightBlocks(const TransferBlocks& blocks, const FoldedLight& light,
                   std::size_t receiverCount, ResultStore store, Vec3f* radiance);

}  // namespace prt

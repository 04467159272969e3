#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/aligned_bytes.h"
#include "prt/relight/relight_kernel.h"
#include "prt/relight/stored_range.h"
#include "prt/transfer/stored_table.h"

namespace prt {

/// Vectors of coefficients, to be multiplied by one light after the other:
///
///   R = Σ_i T_i L_i
///
/// In blocks of 16, in the precision of their table, so that one pass over memory serves red, green
/// and blue.
class VectorBlocks {
  public:
    /// @param vectors  rows of [channel][coefficient]
    /// @throws Error   outOfMemory
    VectorBlocks(const StoredTable& vectors, int bandCount, int channelCount);

    std::size_t vectorCount() const { return vectorCount_; }
    /// Of what is read for all products; the last block counts whole.
    std::size_t byteCount() const;

    /// @param lighting  with at most as many bands
    /// @param begin     a multiple of kRelightBlockSize
    /// @param products  of the vectors from begin on, written
    void relight(const Lighting& lighting, std::size_t begin, ResultStore store,
                 std::span<Vec3f> products) const;

  private:
    void pack(const StoredTable& vectors);
    FoldedLight fold(const Lighting& lighting) const;

    std::size_t vectorCount_ = 0;
    std::size_t blockBytes_ = 0;
    std::vector<StoredRange> ranges_;  ///< [channel][coefficient]
    AlignedBytes bytes_;
    TransferBlocks view_;
};

}  // namespace prt

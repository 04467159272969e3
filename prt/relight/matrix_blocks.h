#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/aligned_bytes.h"
#include "prt/relight/matrix_kernel.h"
#include "prt/relight/stored_range.h"
#include "prt/transfer/stored_table.h"

namespace prt {

/// Transfer matrices, to be multiplied by one light after the other:
///
///   l_i = Σ_j M_ij L_j  =  Σ_j b_ij L_j  +  Σ_j q_ij (s_ij L_j)
///
/// with q as their table stores them, so that one pass over memory serves red, green and blue, and
/// reads no more than is stored.
class MatrixBlocks {
  public:
    /// @param matrices  rows of [channel][i][j]
    /// @throws Error    outOfMemory
    MatrixBlocks(const StoredTable& matrices, int bandCount, int incidentBandCount,
                 int channelCount);

    std::size_t matrixCount() const { return matrixCount_; }
    /// Of what is read for all products; the last block counts whole.
    std::size_t byteCount() const;

    /// What is read for the block that begins there, nothing behind the last.
    std::span<const std::byte> block(std::size_t begin) const;

    /// A light as multiply() takes it, s_ij L_j and Σ_j b_ij L_j.
    ///
    /// @param lighting  with at most as many bands as there are columns for
    /// @throws Error    outOfMemory
    AlignedBytes fold(const Lighting& lighting) const;

    /// @param light     folded
    /// @param begin     a multiple of kMatrixBlockSize
    /// @param stride    floats from one matrix's incident radiance to the next's
    /// @param incident  [matrix][3][incidentIndex] of whole blocks from begin on, written; rows are
    ///                  padded with zeros
    void multiply(const AlignedBytes& light, std::size_t begin, std::size_t blockCount,
                  std::size_t stride, float* incident) const;

  private:
    std::size_t blockBytes() const;
    template <class Stored>
    void pack(const CoefficientTable& numbers);

    std::size_t matrixCount_ = 0;
    std::vector<std::size_t> rows_;  ///< of a matrix, in the order of incidentIndex
    std::vector<RowGroup> groups_;
    std::vector<StoredRange> ranges_;  ///< [channel][i][j]
    AlignedBytes bytes_;
    MatrixView view_;
};

}  // namespace prt

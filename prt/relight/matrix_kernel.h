#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/relight/incident_order.h"
#include "prt/transfer/stored_table.h"

namespace prt {

/// Matrices are multiplied in blocks of as many.
inline constexpr std::size_t kMatrixBlockSize = 16;

/// Rows of matrices that are multiplied together: 16, 8, 4 or 1.
struct RowGroup {
    std::size_t firstRow = 0;
    std::size_t width = 0;
};

/// As many groups of 16 as there are; what a square leaves over is 1, 4 or 9.
///
/// @param rowCount  a square
std::vector<RowGroup> cutRows(std::size_t rowCount);

/// Matrices as the kernel reads them. A vector of 16 numbers is a column of w rows of 16/w
/// matrices, so that nothing is padded but the last block:
///
///   [block][group of w rows][w vectors, up to four together][channel][column][vector of them]
struct MatrixView {
    TransferEncoding encoding = TransferEncoding::float32;
    std::size_t channelCount = 1;
    std::size_t rowCount = 0;            ///< n_in²
    std::size_t paddedRowCount = 0;      ///< of their incident radiance
    std::size_t columnCount = 0;         ///< n²
    std::span<const RowGroup> groups{};  ///< of its rows
    const std::byte* data = nullptr;     ///< aligned to 64 bytes

    std::size_t matrixSize() const { return channelCount * rowCount * columnCount; }
};

/// So many vectors of a group stand together.
constexpr std::size_t vectorsTogether(std::size_t width) {
    return width < 4 ? width : 4;
}

/// Multiplies blocks of matrices from the first on.
///
/// @param light     with scale and bias folded in: for each group of rows the sum of all biases
///                  times light, then a row for each column, each [3][16]; aligned to 64 bytes
/// @param stride    floats from one matrix's incident radiance to the next's
/// @param incident  [matrix][3][padded row], written
void multiplyMatrices(const MatrixView& matrices, const float* light, std::size_t blockCount,
                      std::size_t stride, float* incident);

}  // namespace prt

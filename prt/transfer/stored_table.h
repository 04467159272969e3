#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "prt/transfer/coefficient_table.h"

namespace prt {

/// How one number is stored.
enum class TransferEncoding {
    float32,
    unorm16,  ///< value = bias + scale · q/65535, with a scale and bias a column [Kautz04]
    unorm8,   ///< value = bias + scale · q/255
};

std::string_view encodingName(TransferEncoding encoding);
std::optional<TransferEncoding> parseEncoding(std::string_view name);
std::size_t bytesPerCoefficient(TransferEncoding encoding);

/// The stored number that stands for 1 before scale and bias: 65535, 255, or 1.
double largestStored(TransferEncoding encoding);

/// Rows of numbers as they are stored.
struct StoredTable {
    TransferEncoding encoding = TransferEncoding::float32;
    std::vector<float> scale{};  ///< [column]; empty for float32, and where all are 1
    std::vector<float> bias{};   ///< [column]; empty where scale is
    CoefficientTable numbers{};
};

/// Decodes rows [firstRow, firstRow + rowCount) to floats, [row][column].
std::vector<float> expandRows(const StoredTable& table, std::size_t firstRow, std::size_t rowCount);

/// Decodes all rows.
std::vector<float> expandTable(const StoredTable& table);

}  // namespace prt

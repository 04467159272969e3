#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "prt/transfer/coefficient_table.h"

namespace prt {

/// Reads rows of a table of floats, panel after panel.
///
/// @param indices  of the rows
/// @param rows     [row][column], written
void readRows(const CoefficientTable& numbers, std::span<const std::uint32_t> indices,
              std::span<float> rows);

/// The same for rows [firstRow, firstRow + count) that follow each other.
void readRows(const CoefficientTable& numbers, std::size_t firstRow, std::size_t count,
              std::span<float> rows);

}  // namespace prt

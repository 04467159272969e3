#pragma once

#include "prt/transfer/stored_table.h"

namespace prt {

/// Stores each number in fewer bits, the range of its column mapped to the integers [Kautz04].
///
/// The error of a number is at most half a step: its column's range / 131070 for unorm16, / 510 for
/// unorm8. float32 stores the numbers as they are.
///
/// @param numbers  finite floats; goes as it is stored, so that numbers that stay as they are need
///                 not be held twice
/// @return         in the same storage as the numbers
StoredTable quantiseTable(CoefficientTable numbers, TransferEncoding encoding);

}  // namespace prt

#pragma once

#include <vector>

#include "prt/transfer/stored_table.h"

namespace prt {

/// The factor and the summand that make a coefficient of a stored number q: scale · q + bias.
struct StoredRange {
    double scale = 1.0;
    double bias = 0.0;
};

/// Those of each column [Kautz04].
std::vector<StoredRange> storedRanges(const StoredTable& table);

}  // namespace prt

// Bibliography
//   [Kautz04]  Integer transfer with a scale and a bias for each coefficient
#include "prt/relight/stored_range.h"

#include "prt/base/assert.h"

namespace prt {

std::vector<StoredRange> storedRanges(const StoredTable& table) {
    const std::size_t columnCount = table.numbers.columnCount();
    const double largest = largestStored(table.encoding);
    std::vector<StoredRange> ranges(columnCount, {1.0 / largest, 0.0});
    if (table.encoding == TransferEncoding::float32 || table.scale.empty()) return ranges;
    PRT_ASSERT(table.scale.size() == columnCount && table.bias.size() == columnCount,
               "a scale and a bias for each column");
    for (std::size_t column = 0; column < columnCount; ++column) {
        ranges[column] = {static_cast<double>(table.scale[column]) / largest,
                          static_cast<double>(table.bias[column])};
    }
    return ranges;
}

}  // namespace prt

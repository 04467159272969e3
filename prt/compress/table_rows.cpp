#include "prt/compress/table_rows.h"

#include <algorithm>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// @param rowOf  which row of the table is the i-th
template <class RowOf>
void readPanels(const CoefficientTable& numbers, std::size_t count, std::span<float> rows,
                RowOf rowOf) {
    constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
    const std::size_t rowLength = numbers.columnCount();
    PRT_ASSERT(rows.size() >= count * rowLength, "there is room for the rows");
    for (std::size_t index = 0; index < numbers.panelCount(); ++index) {
        const std::span<const float> panel = floatPanel(numbers, index);
        const std::size_t begin = index * kWidth;
        const std::size_t used = std::min(kWidth, rowLength - begin);
        for (std::size_t i = 0; i < count; ++i)
            std::copy_n(&panel[rowOf(i) * kWidth], used, &rows[i * rowLength + begin]);
    }
}

}  // namespace

void readRows(const CoefficientTable& numbers, std::span<const std::uint32_t> indices,
              std::span<float> rows) {
    readPanels(numbers, indices.size(), rows, [&](std::size_t i) { return indices[i]; });
}

void readRows(const CoefficientTable& numbers, std::size_t firstRow, std::size_t count,
              std::span<float> rows) {
    PRT_ASSERT(firstRow + count <= numbers.rowCount(), "the rows are of the table");
    readPanels(numbers, count, rows, [&](std::size_t i) { return firstRow + i; });
}

}  // namespace prt

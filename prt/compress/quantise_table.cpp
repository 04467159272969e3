// Bibliography
//   [Kautz04]  Integers with a scale and a bias for each coefficient
#include "prt/compress/quantise_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace prt {
namespace {

constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
// So many are converted at a time, between one panel and another.
constexpr std::size_t kRowsAtOnce = 4096;

/// A column's smallest value and how far the others go beyond it.
struct Range {
    float low = 0.0f;
    float size = 0.0f;
};

std::array<Range, kWidth> findRanges(std::span<const float> panel) {
    std::array<Range, kWidth> ranges = {};
    if (panel.empty()) return ranges;
    std::array<float, kWidth> low;
    std::copy_n(panel.begin(), kWidth, low.begin());
    std::array<float, kWidth> high = low;
    for (std::size_t row = 0; row < panel.size(); row += kWidth)
        for (std::size_t column = 0; column < kWidth; ++column) {
            low[column] = std::min(low[column], panel[row + column]);
            high[column] = std::max(high[column], panel[row + column]);
        }
    for (std::size_t column = 0; column < kWidth; ++column)
        ranges[column] = {low[column], high[column] - low[column]};
    return ranges;
}

/// Rounds each value to the nearest step of its column's range; in double, which keeps the error
/// within half a step.
template <class Integer>
void quantisePanel(std::span<const float> panel, const std::array<Range, kWidth>& ranges,
                   double maxInteger, std::size_t index, CoefficientTable& quantised) {
    std::array<double, kWidth> stepsPerUnit = {};
    for (std::size_t column = 0; column < kWidth; ++column)
        if (ranges[column].size > 0.0f) stepsPerUnit[column] = maxInteger / ranges[column].size;

    std::vector<Integer> rows;
    for (std::size_t begin = 0; begin < panel.size(); begin += rows.size()) {
        rows.resize(std::min(kRowsAtOnce * kWidth, panel.size() - begin));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t column = i % kWidth;
            const double aboveLow = static_cast<double>(panel[begin + i]) - ranges[column].low;
            const double steps = std::min(aboveLow * stepsPerUnit[column], maxInteger);
            rows[i] = static_cast<Integer>(steps + 0.5);
        }
        quantised.writePanel(index, begin / kWidth, std::as_bytes(std::span(rows)));
    }
}

template <class Integer>
void quantise(const CoefficientTable& numbers, StoredTable& stored) {
    for (std::size_t index = 0; index < numbers.panelCount(); ++index) {
        const std::span<const float> panel = floatPanel(numbers, index);
        const std::array<Range, kWidth> ranges = findRanges(panel);
        quantisePanel<Integer>(panel, ranges, largestStored(stored.encoding), index,
                               stored.numbers);
        const std::size_t used = std::min(kWidth, numbers.columnCount() - index * kWidth);
        for (std::size_t column = 0; column < used; ++column) {
            stored.bias.push_back(ranges[column].low);
            stored.scale.push_back(ranges[column].size);
        }
        numbers.releaseMemory();
    }
}

}  // namespace

StoredTable quantiseTable(CoefficientTable numbers, TransferEncoding encoding) {
    if (encoding == TransferEncoding::float32) return {.numbers = std::move(numbers)};
    StoredTable stored{
        .encoding = encoding,
        .numbers = CoefficientTable(numbers.rowCount(), numbers.columnCount(),
                                    bytesPerCoefficient(encoding), numbers.storage())};
    if (encoding == TransferEncoding::unorm16)
        quantise<std::uint16_t>(numbers, stored);
    else
        quantise<std::uint8_t>(numbers, stored);
    return stored;
}

}  // namespace prt

#include "prt/transfer/stored_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// In the order of the enumeration.
constexpr std::array<std::string_view, 3> kEncodingNames = {"float32", "unorm16", "unorm8"};
constexpr std::array<std::size_t, 3> kEncodingBytes = {4, 2, 1};
constexpr std::array<double, 3> kLargestStored = {1.0, 65535.0, 255.0};

/// Decodes integers in double, so that each result is the float nearest to what is meant.
template <class Integer>
void expandIntegers(const StoredTable& table, std::size_t firstRow, std::span<float> values) {
    const std::size_t rowLength = table.numbers.columnCount();
    PRT_ASSERT(table.scale.size() == table.bias.size() &&
                   (table.scale.empty() || table.scale.size() == rowLength),
               "each column has a scale and a bias, or none has");
    const double largest = largestStored(table.encoding);
    const bool hasRanges = !table.scale.empty();
    std::vector<Integer> row(rowLength);
    for (std::size_t begin = 0; begin < values.size(); begin += rowLength) {
        table.numbers.readRow(firstRow++, std::span(row));
        for (std::size_t column = 0; column < rowLength; ++column) {
            const double fraction = static_cast<double>(row[column]) / largest;
            values[begin + column] = static_cast<float>(
                hasRanges ? table.bias[column] + table.scale[column] * fraction : fraction);
        }
    }
}

}  // namespace

std::string_view encodingName(TransferEncoding encoding) {
    return kEncodingNames[static_cast<std::size_t>(encoding)];
}

std::optional<TransferEncoding> parseEncoding(std::string_view name) {
    const auto found = std::find(kEncodingNames.begin(), kEncodingNames.end(), name);
    if (found == kEncodingNames.end()) return std::nullopt;
    return static_cast<TransferEncoding>(found - kEncodingNames.begin());
}

std::size_t bytesPerCoefficient(TransferEncoding encoding) {
    return kEncodingBytes[static_cast<std::size_t>(encoding)];
}

double largestStored(TransferEncoding encoding) {
    return kLargestStored[static_cast<std::size_t>(encoding)];
}

std::vector<float> expandRows(const StoredTable& table, std::size_t firstRow,
                              std::size_t rowCount) {
    const std::size_t rowLength = table.numbers.columnCount();
    PRT_ASSERT(table.numbers.elementBytes() == bytesPerCoefficient(table.encoding),
               "the numbers are stored as the table says");
    std::vector<float> values(rowCount * rowLength);
    switch (table.encoding) {
        case TransferEncoding::unorm16:
            expandIntegers<std::uint16_t>(table, firstRow, values);
            break;
        case TransferEncoding::unorm8:
            expandIntegers<std::uint8_t>(table, firstRow, values);
            break;
        case TransferEncoding::float32:
            for (std::size_t row = 0; row < rowCount; ++row)
                table.numbers.readRow(firstRow + row,
                                      std::span(values).subspan(row * rowLength, rowLength));
            break;
    }
    return values;
}

std::vector<float> expandTable(const StoredTable& table) {
    return expandRows(table, 0, table.numbers.rowCount());
}

}  // namespace prt

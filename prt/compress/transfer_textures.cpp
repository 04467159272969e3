// Bibliography
//   [Kautz04]  24 of 25 coefficients in six textures of 8 bits a channel
#include "prt/compress/transfer_textures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "prt/base/assert.h"
#include "prt/compress/quantise_table.h"

namespace prt {
namespace {

constexpr std::size_t kPerTexture = CoefficientTable::kPanelWidth;

/// What a column's numbers are around.
struct Spread {
    double mean = 0.0;
    double squares = 0.0;  ///< Σ (T − mean)²
    double largest = 0.0;  ///< of |T − mean|
};

/// The numbers of a column are every fourth of a panel.
///
/// @param mean  as it is stored: the squares are of what reading it back gives
Spread measureSpread(const CoefficientTable& table, std::size_t column) {
    const std::span<const float> panel = floatPanel(table, column / kPerTexture);
    Spread spread;
    for (std::size_t i = column % kPerTexture; i < panel.size(); i += kPerTexture)
        spread.mean += panel[i];
    spread.mean = static_cast<float>(spread.mean / static_cast<double>(table.rowCount()));
    for (std::size_t i = column % kPerTexture; i < panel.size(); i += kPerTexture) {
        const double error = std::abs(panel[i] - spread.mean);
        spread.squares += error * error;
        spread.largest = std::max(spread.largest, error);
    }
    return spread;
}

/// Finds the coefficient whose mean stands for it best.
LeftOutCoefficient chooseLeftOut(const TransferLayer& layer, int coefficientCount) {
    LeftOutCoefficient best;
    double leastSquares = 0.0;
    for (int i = 0; i < coefficientCount; ++i) {
        LeftOutCoefficient candidate{.index = i};
        double squares = 0.0;
        for (int channel = 0; channel < layer.channelCount; ++channel) {
            const auto column = static_cast<std::size_t>(channel * coefficientCount + i);
            const Spread spread = measureSpread(layer.coefficients, column);
            candidate.mean.push_back(static_cast<float>(spread.mean));
            candidate.largestError = std::max(candidate.largestError, spread.largest);
            squares += spread.squares;
        }
        if (i > 0 && squares >= leastSquares) continue;
        leastSquares = squares;
        best = std::move(candidate);
    }
    const std::size_t numberCount =
        layer.coefficients.rowCount() * static_cast<std::size_t>(layer.channelCount);
    best.rmse = std::sqrt(leastSquares / static_cast<double>(numberCount));
    return best;
}

/// Where the numbers of a texture's row stand in a row of the layer.
std::vector<std::size_t> storedColumns(const TransferTextures& textures) {
    std::vector<std::size_t> columns;
    for (int channel = 0; channel < textures.channelCount; ++channel)
        for (const int i : textures.coefficients)
            columns.push_back(
                static_cast<std::size_t>(channel * textures.bandCount * textures.bandCount + i));
    return columns;
}

}  // namespace

TransferTextures packTransferTextures(const TransferLayer& layer, int bandCount, int width,
                                      int height) {
    const CoefficientTable& table = layer.coefficients;
    PRT_ASSERT(bandCount >= 2, "the coefficients fill a texture");
    PRT_ASSERT(!isGlossy(layer.transport), "a layer of vectors");
    PRT_ASSERT(
        width > 0 && height > 0 &&
            table.rowCount() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
        "there is a receiver for each texel");
    PRT_ASSERT(table.columnCount() == coefficientsPerReceiver(bandCount, layer.channelCount),
               "each receiver has all coefficients");
    TransferTextures textures{.transport = layer.transport,
                              .bandCount = bandCount,
                              .channelCount = layer.channelCount,
                              .width = width,
                              .height = height};
    const int coefficientCount = bandCount * bandCount;
    // The square of an odd number is one more than a multiple of four.
    if (bandCount % 2 == 1) textures.leftOut = chooseLeftOut(layer, coefficientCount);
    for (int i = 0; i < coefficientCount; ++i)
        if (!textures.leftOut || textures.leftOut->index != i) textures.coefficients.push_back(i);

    const std::vector<std::size_t> columns = storedColumns(textures);
    CoefficientTable stored(table.rowCount(), columns.size(), sizeof(float), table.storage());
    std::vector<float> row(table.columnCount()), storedRow(columns.size());
    for (std::size_t texel = 0; texel < table.rowCount(); ++texel) {
        table.readRow(texel, std::span(row));
        for (std::size_t s = 0; s < columns.size(); ++s)
            storedRow[s] = row[columns[s]];
        stored.writeRows(texel, std::span<const float>(storedRow));
    }
    // A panel of a table of bytes is a texture.
    textures.table = quantiseTable(std::move(stored), TransferEncoding::unorm8);
    return textures;
}

TransferLayer unpackTransferTextures(const TransferTextures& textures) {
    const std::size_t rowLength =
        coefficientsPerReceiver(textures.bandCount, textures.channelCount);
    std::vector<float> row(rowLength);
    if (textures.leftOut) {
        const LeftOutCoefficient& leftOut = *textures.leftOut;
        const std::size_t perChannel = rowLength / leftOut.mean.size();
        for (std::size_t channel = 0; channel < leftOut.mean.size(); ++channel)
            row[channel * perChannel + static_cast<std::size_t>(leftOut.index)] =
                leftOut.mean[channel];
    }
    const std::vector<std::size_t> columns = storedColumns(textures);
    const CoefficientTable& numbers = textures.table.numbers;
    CoefficientTable table(numbers.rowCount(), rowLength, sizeof(float), numbers.storage());
    for (std::size_t texel = 0; texel < table.rowCount(); ++texel) {
        const std::vector<float> stored = expandRows(textures.table, texel, 1);
        for (std::size_t s = 0; s < columns.size(); ++s)
            row[columns[s]] = stored[s];
        table.writeRows(texel, std::span<const float>(row));
    }
    return {textures.transport, textures.channelCount, std::move(table)};
}

}  // namespace prt

#include "prt/asset/check_asset.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "prt/basis/sh.h"

namespace prt {
namespace {

// What rounding in the bake and in expansion may add, relative to the bound.
constexpr double kTolerance = 1e-3;
// So many numbers are expanded at a time: clusters are small in the file, and large when expanded.
constexpr std::size_t kNumbersAtOnce = std::size_t{1} << 22;
// Dielectrics of glTF return up to 1.85 of the light around them, seen along the surface
// (docs/architecture.md), and lobes that end at n_in bands ring: so much more light is not doubted.
constexpr double kMostReflected = 2.0;
// None of millions of elements is further from its mean than this, in standard deviations.
constexpr double kDeviations = 6.0;
// More unlit vertices than closed solids standing in each other usually have.
constexpr double kSuspiciousDarkShare = 0.25;

/// How many vertices of a layer are out of bounds, and how many are unlit.
struct LayerCounts {
    std::size_t tooLarge = 0;
    std::size_t negativeMean = 0;
    std::size_t dark = 0;
};

/// √(2l+1) for each coefficient: √4π times the largest magnitude of its basis function.
std::vector<double> basisPeaks(int bandCount) {
    std::vector<double> peaks;
    for (int i = 0; i < shCoefficientCount(bandCount); ++i)
        peaks.push_back(std::sqrt(2 * shDegree(i) + 1));
    return peaks;
}

/// Of an element that is a mean over rays: their own bound, and what so few of them may add.
/// M_00 is a mean of numbers within its bound.
double elementBound(Transport transport, double incidentPeak, double lightPeak, double noise) {
    if (lightPeak == 1.0 && incidentPeak == 1.0) noise = 0.0;
    if (transport == Transport::glossyShadowed)
        return 0.5 * (1.0 + noise * std::min(incidentPeak, lightPeak));
    return 0.5 * kMostReflected * lightPeak * (1.0 + noise);
}

/// The largest magnitude of each coefficient of a channel, as check_asset.h says.
std::vector<double> coefficientBounds(int bandCount, const CompressedLayer& layer,
                                      int sampleCount) {
    std::vector<double> bounds = basisPeaks(bandCount);
    if (!isGlossy(layer.transport)) {
        for (double& bound : bounds)
            bound /= std::sqrt(4.0 * std::numbers::pi);
        return bounds;
    }
    const std::vector<double> lightPeaks = std::move(bounds);
    const double noise = kDeviations / std::sqrt(std::max(1, sampleCount));
    bounds.clear();
    for (const double incidentPeak : basisPeaks(layer.incidentBandCount))
        for (const double lightPeak : lightPeaks)
            bounds.push_back(elementBound(layer.transport, incidentPeak, lightPeak, noise));
    return bounds;
}

/// @param values        of some receivers
/// @param largestError  of each of them
/// @param counts        added to
void countDoubts(std::span<const float> values, const std::vector<double>& bounds,
                 std::size_t rowLength, double largestError, LayerCounts& counts) {
    const auto tolerance = [&](std::size_t i) { return bounds[i] * kTolerance + largestError; };
    for (std::size_t row = 0; row < values.size(); row += rowLength) {
        bool isTooLarge = false;
        bool isNegative = false;
        bool isDark = true;
        for (std::size_t column = 0; column < rowLength; ++column) {
            const std::size_t i = column % bounds.size();
            const double value = values[row + column];
            isTooLarge |= std::abs(value) > bounds[i] + tolerance(i);
            if (i > 0) continue;
            isNegative |= value < -tolerance(0);
            isDark &= value <= bounds[0] * kTolerance;
        }
        counts.tooLarge += isTooLarge;
        counts.negativeMean += isNegative;
        counts.dark += isDark;
    }
}

LayerCounts countDoubts(const Asset& asset, const CompressedLayer& layer) {
    const CompressedTransfer& transfer = asset.transfer;
    const LayerDecoder decoder(layer);
    const std::vector<double> bounds =
        coefficientBounds(transfer.bandCount, layer, asset.provenance.sampleCount);
    const std::size_t rowLength = coefficientsPerReceiver(transfer.bandCount, layer);
    const std::size_t rowsAtOnce = std::max<std::size_t>(1, kNumbersAtOnce / rowLength);
    LayerCounts counts;
    for (std::size_t begin = 0; begin < transfer.receiverCount; begin += rowsAtOnce)
        countDoubts(decoder.expand(begin, std::min(rowsAtOnce, transfer.receiverCount - begin)),
                    bounds, rowLength, layer.largestError, counts);
    return counts;
}

void reportLayer(const Asset& asset, const CompressedLayer& layer,
                 std::vector<std::string>& problems) {
    const LayerCounts counts = countDoubts(asset, layer);
    const std::string ofVertices =
        " of " + std::to_string(asset.transfer.receiverCount) + " vertices ";
    const std::string where = "layer " + std::string(transportName(layer.transport)) + ": ";
    const bool isOfMatrices = isGlossy(layer.transport);
    if (counts.tooLarge > 0)
        problems.push_back(where + std::to_string(counts.tooLarge) + ofVertices +
                           (isOfMatrices ? "receive more light than there can be"
                                         : "return more light than reflectances up to 1 can"));
    if (counts.negativeMean > 0)
        problems.push_back(where + std::to_string(counts.negativeMean) + ofVertices +
                           (isOfMatrices ? "receive a negative amount of uniform light"
                                         : "answer uniform light with negative radiance"));
    if (static_cast<double>(counts.dark) >
        kSuspiciousDarkShare * static_cast<double>(asset.transfer.receiverCount))
        problems.push_back(where + std::to_string(counts.dark) + ofVertices +
                           "receive no light; are faces turned inside out?");
}

}  // namespace

std::vector<std::string> findAssetProblems(const Asset& asset) {
    std::vector<std::string> problems;
    if (asset.transfer.receiverCount == 0) problems.push_back("the scene has no vertices");
    for (const CompressedLayer& layer : asset.transfer.layers)
        reportLayer(asset, layer, problems);
    return problems;
}

}  // namespace prt

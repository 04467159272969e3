#include "prt/asset/check_asset.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "prt/basis/sh.h"

namespace prt {
namespace {

// What rounding in the bake and in expansion may add, relative to the bound.
constexpr double kTolerance = 1e-3;
// So many receivers are expanded at a time: clusters are small in the file, and large when
// expanded.
constexpr std::size_t kReceiversAtOnce = 65536;
// More unlit vertices than closed solids standing in each other usually have.
constexpr double kSuspiciousDarkShare = 0.25;

/// How many vertices of a layer are out of bounds, and how many are unlit.
struct LayerCounts {
    std::size_t tooLarge = 0;
    std::size_t negativeMean = 0;
    std::size_t dark = 0;
};

/// √((2l+1)/4π) for each coefficient: the largest magnitude of its basis function over the sphere.
std::vector<double> coefficientBounds(int bandCount) {
    std::vector<double> bounds;
    for (int i = 0; i < shCoefficientCount(bandCount); ++i)
        bounds.push_back(std::sqrt((2 * shDegree(i) + 1) / (4.0 * std::numbers::pi)));
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

LayerCounts countDoubts(const CompressedTransfer& transfer, const CompressedLayer& layer) {
    const LayerDecoder decoder(layer);
    LayerCounts counts;
    for (std::size_t begin = 0; begin < transfer.receiverCount; begin += kReceiversAtOnce)
        countDoubts(
            decoder.expand(begin, std::min(kReceiversAtOnce, transfer.receiverCount - begin)),
            coefficientBounds(transfer.bandCount),
            coefficientsPerReceiver(transfer.bandCount, layer), layer.largestError, counts);
    return counts;
}

void reportLayer(const Asset& asset, const CompressedLayer& layer,
                 std::vector<std::string>& problems) {
    const LayerCounts counts = countDoubts(asset.transfer, layer);
    const std::string ofVertices =
        " of " + std::to_string(asset.transfer.receiverCount) + " vertices ";
    const std::string where = "layer " + std::string(transportName(layer.transport)) + ": ";
    if (counts.tooLarge > 0)
        problems.push_back(where + std::to_string(counts.tooLarge) + ofVertices +
                           "return more light than reflectances up to 1 can");
    if (counts.negativeMean > 0)
        problems.push_back(where + std::to_string(counts.negativeMean) + ofVertices +
                           "answer uniform light with negative radiance");
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

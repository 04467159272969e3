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
// What clusters may add, whose sums of few vectors can be off by a large part of a coefficient.
constexpr double kToleranceOfClusters = 0.5;
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

LayerCounts countDoubts(std::span<const float> values, int channelCount,
                        const std::vector<double>& bounds, double tolerance) {
    LayerCounts counts;
    const std::size_t rowLength = bounds.size() * static_cast<std::size_t>(channelCount);
    for (std::size_t row = 0; row < values.size(); row += rowLength) {
        bool isTooLarge = false;
        bool isNegative = false;
        bool isDark = true;
        for (std::size_t column = 0; column < rowLength; ++column) {
            const std::size_t i = column % bounds.size();
            const double value = values[row + column];
            isTooLarge |= std::abs(value) > bounds[i] * (1.0 + tolerance);
            if (i > 0) continue;
            isNegative |= value < -bounds[0] * tolerance;
            isDark &= value <= bounds[0] * kTolerance;
        }
        counts.tooLarge += isTooLarge;
        counts.negativeMean += isNegative;
        counts.dark += isDark;
    }
    return counts;
}

void reportLayer(const Asset& asset, const CompressedLayer& layer,
                 std::vector<std::string>& problems) {
    const std::vector<float> values = expandLayer(layer);
    const LayerCounts counts =
        countDoubts(values, layer.channelCount, coefficientBounds(asset.transfer.bandCount),
                    layer.bases ? kToleranceOfClusters : kTolerance);
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

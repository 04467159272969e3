#include "prt/gpu/panel_light.h"

#include "prt/base/assert.h"
#include "prt/transfer/coefficient_table.h"

namespace prt {
namespace {

constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;

}  // namespace

PanelLight foldLight(std::span<const StoredRange> ranges, int bandCount, const Lighting& lighting) {
    PRT_ASSERT(lighting.bandCount <= bandCount, "light has no more bands than transfer");
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const bool isGrey = ranges.size() == coefficientCount;
    PRT_ASSERT(isGrey || ranges.size() == 3 * coefficientCount, "grey or coloured transfer");

    PanelLight light;
    light.factors.resize(CoefficientTable::countPanels(ranges.size()) * 3 * kWidth);
    Vec3d biasRadiance(0.0);
    for (std::size_t column = 0; column < ranges.size(); ++column) {
        const std::size_t i = column % coefficientCount;
        if (i >= lighting.coefficients.size()) continue;
        for (int channel = 0; channel < 3; ++channel) {
            const bool isFed =
                isGrey || column / coefficientCount == static_cast<std::size_t>(channel);
            if (!isFed) continue;
            const double value = lighting.coefficients[i][channel];
            const std::size_t row = column / kWidth * 3 + static_cast<std::size_t>(channel);
            light.factors[row * kWidth + column % kWidth] =
                static_cast<float>(value * ranges[column].scale);
            biasRadiance[channel] += value * ranges[column].bias;
        }
        light.panelCount = column / kWidth + 1;
    }
    light.biasRadiance = Vec3f(biasRadiance);
    return light;
}

}  // namespace prt

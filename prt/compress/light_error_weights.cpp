#include "prt/compress/light_error_weights.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {

std::vector<float> lightErrorWeights(std::span<const Vec3d> light, int bandCount,
                                     int channelCount) {
    constexpr double kLeastShare = 1e-3;
    PRT_ASSERT(bandCount >= 1 && (channelCount == 1 || channelCount == 3),
               "there are bands, and one channel or three");
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<double> weights;
    for (int channel = 0; channel < channelCount; ++channel) {
        for (int l = 0; l < bandCount; ++l) {
            double energy = 0.0;
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<std::size_t>(shIndex(l, m));
                if (i >= light.size()) continue;
                energy += channelCount == 3 ? light[i][channel] * light[i][channel]
                                            : light[i].dot(light[i]) / 3.0;
            }
            weights.insert(weights.end(), static_cast<std::size_t>(2 * l + 1),
                           std::sqrt(energy / (2 * l + 1)));
        }
    }
    PRT_ASSERT(weights.size() == coefficientCount * static_cast<std::size_t>(channelCount),
               "every coefficient has a weight");
    const double largest = *std::max_element(weights.begin(), weights.end());
    PRT_ASSERT(largest > 0.0 && std::isfinite(largest), "there is light");
    std::vector<float> rounded;
    for (const double weight : weights)
        rounded.push_back(static_cast<float>(std::max(weight, kLeastShare * largest)));
    return rounded;
}

std::vector<float> weighRows(std::span<const Vec3d> light, std::size_t rowLength, int channelCount,
                             int incidentBandCount) {
    if (light.empty()) return {};
    const auto rowCount = static_cast<std::size_t>(
        incidentBandCount == 0 ? 1 : shCoefficientCount(incidentBandCount));
    const auto channels = static_cast<std::size_t>(channelCount);
    const std::size_t coefficientCount = rowLength / (channels * rowCount);
    const auto bandCount =
        static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficientCount))));
    const std::vector<float> once = lightErrorWeights(light, bandCount, channelCount);
    PRT_ASSERT(once.size() * rowCount == rowLength, "a row has all bands of its channels");
    std::vector<float> weights;
    for (std::size_t channel = 0; channel < channels; ++channel)
        for (std::size_t i = 0; i < rowCount; ++i)
            for (std::size_t j = 0; j < coefficientCount; ++j)
                weights.push_back(once[channel * coefficientCount + j]);
    return weights;
}

}  // namespace prt

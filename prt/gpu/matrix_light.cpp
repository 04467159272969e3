#include "prt/gpu/matrix_light.h"

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/relight/incident_order.h"
#include "prt/transfer/coefficient_table.h"

namespace prt {

MatrixLight foldMatrixLight(std::span<const StoredRange> ranges, int bandCount,
                            int incidentBandCount, const Lighting& lighting) {
    PRT_ASSERT(lighting.bandCount <= bandCount, "light has no more bands than transfer");
    constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
    const auto columnCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const auto rowCount = static_cast<std::size_t>(shCoefficientCount(incidentBandCount));
    const std::size_t channelCount = ranges.size() / (rowCount * columnCount);
    PRT_ASSERT(ranges.size() == channelCount * rowCount * columnCount &&
                   (channelCount == 1 || channelCount == 3),
               "grey or coloured matrices");

    MatrixLight light;
    light.rows.resize(channelCount * rowCount + 1);
    light.factors.resize(CoefficientTable::countPanels(ranges.size()) * 3 * kWidth);
    for (std::size_t channel = 0; channel < channelCount; ++channel) {
        for (int l = 0; l < incidentBandCount; ++l) {
            for (int m = -l; m <= l; ++m) {
                const std::size_t row =
                    channel * rowCount + static_cast<std::size_t>(shIndex(l, m));
                Vec3d bias(0.0);
                for (std::size_t j = 0; j < lighting.coefficients.size(); ++j) {
                    const std::size_t column = row * columnCount + j;
                    for (std::size_t color = 0; color < 3; ++color) {
                        if (channelCount == 3 && color != channel) continue;
                        const double value = lighting.coefficients[j][static_cast<int>(color)];
                        light.factors[(column / kWidth * 3 + color) * kWidth + column % kWidth] =
                            static_cast<float>(value * ranges[column].scale);
                        bias[static_cast<int>(color)] += value * ranges[column].bias;
                    }
                }
                light.rows[row] = {
                    Vec3f(bias), static_cast<std::uint32_t>(
                                     channel * rowCount + incidentIndex(incidentBandCount, l, m))};
            }
        }
    }
    return light;
}

}  // namespace prt

#pragma once

#include <cstddef>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/relighter.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt::test {

/// What vertices reflect before their albedo, or, of matrices, what arrives there.
inline std::vector<double> relightLayer(const CompressedTransfer& transfer,
                                        const CompressedLayer& layer, const Lighting& lighting) {
    std::vector<double> numbers;
    if (!isGlossy(layer.transport)) {
        std::vector<Vec3f> radiance(transfer.receiverCount);
        Relighter(transfer, layer.transport).relight(lighting, radiance);
        for (const Vec3f& rgb : radiance)
            numbers.insert(numbers.end(), {rgb.x, rgb.y, rgb.z});
        return numbers;
    }
    const std::vector<float> matrices = expandLayer(layer);
    const std::size_t columns = lighting.coefficients.size();
    const auto rows = static_cast<std::size_t>(layer.incidentBandCount * layer.incidentBandCount);
    const auto channels = static_cast<std::size_t>(layer.channelCount);
    for (std::size_t vertex = 0; vertex < transfer.receiverCount; ++vertex)
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::size_t row = (vertex * channels + channel % channels) * rows + i;
                double sum = 0.0;
                for (std::size_t j = 0; j < columns; ++j)
                    sum += matrices[row * columns + j] *
                           lighting.coefficients[j][static_cast<int>(channel)];
                numbers.push_back(sum);
            }
    return numbers;
}

}  // namespace prt::test

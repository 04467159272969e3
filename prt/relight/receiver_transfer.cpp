// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
#include "prt/relight/receiver_transfer.h"

#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/basis/zonal.h"
#include "prt/relight/require_layer.h"

namespace prt {

Lighting expandReceiver(const CompressedTransfer& transfer, Transport transport,
                        std::size_t receiver) {
    const CompressedLayer& layer = requireLayer(transfer, transport);
    PRT_ASSERT(isComplete(transfer, layer) && receiver < transfer.receiverCount,
               "transfer of this receiver");
    const std::vector<float> values = LayerDecoder(layer).expand(receiver, 1);

    std::vector<double> rowWeights = {1.0};  // [i], of a vector's only row
    if (isGlossy(transport)) {
        const std::vector<double> cosine = clampedCosineZonal(layer.incidentBandCount);
        rowWeights.assign(static_cast<std::size_t>(shCoefficientCount(layer.incidentBandCount)), 0);
        for (int l = 0; l < layer.incidentBandCount; ++l)
            rowWeights[static_cast<std::size_t>(shIndex(l, 0))] =
                cosine[static_cast<std::size_t>(l)] * std::numbers::inv_pi;
    }

    Lighting expanded(transfer.bandCount);
    const std::size_t columnCount = expanded.coefficients.size();
    for (int color = 0; color < 3; ++color) {
        const std::size_t channel = layer.channelCount == 3 ? static_cast<std::size_t>(color) : 0;
        const float* row = &values[channel * rowWeights.size() * columnCount];
        for (const double weight : rowWeights) {
            for (std::size_t j = 0; j < columnCount; ++j)
                expanded.coefficients[j][color] += weight * static_cast<double>(row[j]);
            row += columnCount;
        }
    }
    return expanded;
}

Lighting expandReceiver(const GlossyRelighter& relighter, const Vec3f& eye, std::size_t receiver,
                        const Vec3f& baseColor) {
    PRT_ASSERT(receiver < relighter.receiverCount(), "a receiver of this layer");
    const std::size_t begin = receiver / kGlossyPartSize * kGlossyPartSize;
    std::vector<ExitRadiance> part(receiver - begin + 1);
    Lighting expanded(relighter.bandCount());
    for (int i = 0; i < shCoefficientCount(expanded.bandCount); ++i) {
        relighter.relight(makeBasisLighting(expanded.bandCount, i), eye, begin, part);
        const ExitRadiance& sent = part.back();
        expanded.coefficients[static_cast<std::size_t>(i)] =
            Vec3d(baseColor * sent.perBaseColor + sent.constant);
    }
    return expanded;
}

}  // namespace prt

#include "prt/compress/compression_error.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/compress/light_error_weights.h"

namespace prt {
namespace {

/// Of coefficients [receiver][channel][coefficient].
struct Comparison {
    const std::vector<float>& stored;
    const std::vector<float>& truth;
    int channelCount;
    std::size_t rowLength;
};

/// The error as it is seen; see CompressionError.
double measureSeenError(const Comparison& comparison, std::span<const Vec3d> light) {
    const auto channelCount = static_cast<std::size_t>(comparison.channelCount);
    const std::size_t coefficientCount = comparison.rowLength / channelCount;
    const auto bandCount = std::lround(std::sqrt(static_cast<double>(coefficientCount)));
    const std::vector<float> weights =
        lightErrorWeights(light, static_cast<int>(bandCount), comparison.channelCount);
    PRT_ASSERT(weights.size() == comparison.rowLength, "a row has all bands of its channels");
    const auto meanLight = [&](std::size_t channel) {
        return channelCount == 3 ? light[0][static_cast<int>(channel)]
                                 : (light[0][0] + light[0][1] + light[0][2]) / 3.0;
    };
    double squares = 0.0, radiance = 0.0;
    for (std::size_t i = 0; i < comparison.truth.size(); ++i) {
        const std::size_t column = i % comparison.rowLength;
        const double error = double{comparison.stored[i]} - double{comparison.truth[i]};
        squares += weights[column] * error * weights[column] * error;
        if (column % coefficientCount == 0)
            radiance += comparison.truth[i] * meanLight(column / coefficientCount);
    }
    const double count =
        static_cast<double>(comparison.truth.size()) / static_cast<double>(coefficientCount);
    return radiance != 0.0 ? std::sqrt(squares / count) / std::abs(radiance / count) : 0.0;
}

CompressionError compare(const Comparison& comparison, std::span<const Vec3d> light) {
    const std::vector<float>& truth = comparison.truth;
    PRT_ASSERT(comparison.stored.size() == truth.size(), "both layers have the same coefficients");
    CompressionError error;
    double squares = 0.0, truthSquares = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = double{comparison.stored[i]} - double{truth[i]};
        squares += difference * difference;
        truthSquares += double{truth[i]} * double{truth[i]};
        error.largest = std::max(error.largest, std::abs(difference));
    }
    if (truth.empty()) return error;
    error.rmse = std::sqrt(squares / static_cast<double>(truth.size()));
    if (truthSquares > 0.0) error.relativeRmse = std::sqrt(squares / truthSquares);
    if (!light.empty()) error.seen = measureSeenError(comparison, light);
    return error;
}

std::size_t rowLengthOf(const CompressedLayer& layer) {
    return (layer.bases ? layer.bases->vectors : layer.table).numbers.columnCount();
}

}  // namespace

CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const CompressedLayer& original,
                                         std::span<const Vec3d> light) {
    const std::vector<float> stored = expandLayer(compressed), truth = expandLayer(original);
    return compare({stored, truth, original.channelCount, rowLengthOf(original)}, light);
}

CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const TransferLayer& original,
                                         std::span<const Vec3d> light) {
    const std::vector<float> stored = expandLayer(compressed);
    const std::vector<float> truth = copyRows<float>(original.coefficients);
    return compare({stored, truth, original.channelCount, original.coefficients.columnCount()},
                   light);
}

}  // namespace prt

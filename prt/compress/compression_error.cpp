#include "prt/compress/compression_error.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"

namespace prt {

CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const CompressedLayer& original) {
    const std::vector<float> stored = expandLayer(compressed), truth = expandLayer(original);
    PRT_ASSERT(stored.size() == truth.size(), "both layers have the same coefficients");
    CompressionError error;
    double squares = 0.0, truthSquares = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = static_cast<double>(stored[i]) - static_cast<double>(truth[i]);
        squares += difference * difference;
        truthSquares += static_cast<double>(truth[i]) * static_cast<double>(truth[i]);
        error.largest = std::max(error.largest, std::abs(difference));
    }
    if (truth.empty()) return error;
    error.rmse = std::sqrt(squares / static_cast<double>(truth.size()));
    if (truthSquares > 0.0) error.relativeRmse = std::sqrt(squares / truthSquares);
    return error;
}

}  // namespace prt

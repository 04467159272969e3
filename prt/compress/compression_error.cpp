#include "prt/compress/compression_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/compress/light_error_weights.h"
#include "prt/compress/table_rows.h"

namespace prt {
namespace {

constexpr std::size_t kNumbersAtOnce = std::size_t{1} << 20;

/// Sums over the coefficients of receivers, which are added block by block.
class ErrorSums {
  public:
    /// @param layer      whose kind it is
    /// @param rowLength  coefficients of all channels
    ErrorSums(std::span<const Vec3d> light, std::size_t rowLength, const CompressedLayer& layer)
        : light_(light),
          weights_(weighRows(light, rowLength, layer.channelCount, layer.incidentBandCount)),
          rowLength_(rowLength),
          channelCount_(static_cast<std::size_t>(layer.channelCount)),
          // From coefficients of incident radiance to the hemisphere's mean: 1/2π of the squares,
          // and 1/√π of the constant.
          seenPerCoefficient_(layer.incidentBandCount > 0 ? std::numbers::sqrt2 / 2.0 : 1.0) {}

    void add(std::span<const float> stored, std::span<const float> truth) {
        PRT_ASSERT(stored.size() == truth.size(), "both layers have the same coefficients");
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double difference = double{stored[i]} - double{truth[i]};
            squares_ += difference * difference;
            truthSquares_ += double{truth[i]} * double{truth[i]};
            largest_ = std::max(largest_, std::abs(difference));
            if (!light_.empty()) addSeen(i % rowLength_, difference, truth[i]);
        }
        count_ += truth.size();
    }

    CompressionError result() const {
        CompressionError error;
        error.largest = largest_;
        if (count_ == 0) return error;
        error.rmse = std::sqrt(squares_ / static_cast<double>(count_));
        if (truthSquares_ > 0.0) error.relativeRmse = std::sqrt(squares_ / truthSquares_);
        const double vectorCount =
            static_cast<double>(count_) / static_cast<double>(coefficientCount());
        if (radiance_ != 0.0)
            error.seen = seenPerCoefficient_ * std::sqrt(seenSquares_ / vectorCount) /
                         std::abs(radiance_ / vectorCount);
        return error;
    }

  private:
    std::size_t coefficientCount() const { return rowLength_ / channelCount_; }

    void addSeen(std::size_t column, double difference, float truth) {
        seenSquares_ += weights_[column] * difference * weights_[column] * difference;
        if (column % coefficientCount() == 0)
            radiance_ += truth * meanLight(column / coefficientCount());
    }

    double meanLight(std::size_t channel) const {
        return channelCount_ == 3 ? light_[0][static_cast<int>(channel)]
                                  : (light_[0][0] + light_[0][1] + light_[0][2]) / 3.0;
    }

    std::span<const Vec3d> light_;
    std::vector<float> weights_;
    std::size_t rowLength_;
    std::size_t channelCount_;
    double seenPerCoefficient_;
    std::size_t count_ = 0;
    double squares_ = 0.0, truthSquares_ = 0.0, largest_ = 0.0;
    double seenSquares_ = 0.0, radiance_ = 0.0;
};

/// @param readTruth  gives the floats of receivers [first, first + count)
template <class ReadTruth>
CompressionError compare(const CompressedLayer& compressed, std::size_t rowLength,
                         std::span<const Vec3d> light, ReadTruth readTruth) {
    const LayerDecoder decoder(compressed);
    ErrorSums sums(light, rowLength, compressed);
    const std::size_t receiverCount = compressed.table.numbers.rowCount();
    const std::size_t receiversAtOnce = std::max<std::size_t>(1, kNumbersAtOnce / rowLength);
    for (std::size_t begin = 0; begin < receiverCount; begin += receiversAtOnce) {
        const std::size_t count = std::min(receiversAtOnce, receiverCount - begin);
        sums.add(decoder.expand(begin, count), readTruth(begin, count));
    }
    return sums.result();
}

std::size_t rowLengthOf(const CompressedLayer& layer) {
    return (layer.bases ? layer.bases->vectors : layer.table).numbers.columnCount();
}

}  // namespace

CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const CompressedLayer& original,
                                         std::span<const Vec3d> light) {
    PRT_ASSERT(compressed.table.numbers.rowCount() == original.table.numbers.rowCount(),
               "both layers have the same receivers");
    const LayerDecoder decoder(original);
    return compare(
        compressed, rowLengthOf(original), light,
        [&](std::size_t first, std::size_t count) { return decoder.expand(first, count); });
}

CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const TransferLayer& original,
                                         std::span<const Vec3d> light) {
    const CoefficientTable& truth = original.coefficients;
    PRT_ASSERT(compressed.table.numbers.rowCount() == truth.rowCount(),
               "both layers have the same receivers");
    return compare(compressed, truth.columnCount(), light,
                   [&](std::size_t first, std::size_t count) {
                       std::vector<float> rows(count * truth.columnCount());
                       readRows(truth, first, count, rows);
                       return rows;
                   });
}

}  // namespace prt

#include "prt/relight/matrix_blocks.h"

#include <algorithm>
#include <cstdint>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

constexpr std::size_t kLanes = kIncidentLanes;

/// Where the numbers of one matrix of a block stand, in a group of its rows.
struct GroupPlace {
    std::size_t firstColumn = 0;   ///< of channel 0
    std::size_t columnStride = 0;  ///< and of the next
    std::size_t channelStride = 0;

    GroupPlace(const MatrixView& shape, const RowGroup& group, std::size_t matrix) {
        const std::size_t together = vectorsTogether(group.width);
        const std::size_t vector = matrix * group.width / kLanes;
        columnStride = together * kLanes;
        channelStride = shape.columnCount * columnStride;
        firstColumn = group.firstRow * kMatrixBlockSize * shape.channelCount * shape.columnCount +
                      vector / together * shape.channelCount * channelStride +
                      vector % together * kLanes + matrix * group.width % kLanes;
    }
};

/// The rows of a matrix, in the order in which incident radiance is kept.
std::vector<std::size_t> orderRows(int incidentBandCount) {
    std::vector<std::size_t> rows(static_cast<std::size_t>(shCoefficientCount(incidentBandCount)));
    for (int l = 0; l < incidentBandCount; ++l)
        for (int m = -l; m <= l; ++m)
            rows[incidentIndex(incidentBandCount, l, m)] = static_cast<std::size_t>(shIndex(l, m));
    return rows;
}

}  // namespace

MatrixBlocks::MatrixBlocks(const StoredTable& matrices, int bandCount, int incidentBandCount,
                           int channelCount)
    : matrixCount_(matrices.numbers.rowCount()),
      rows_(orderRows(incidentBandCount)),
      ranges_(storedRanges(matrices)) {
    view_.encoding = matrices.encoding;
    view_.channelCount = static_cast<std::size_t>(channelCount);
    view_.rowCount = rows_.size();
    view_.paddedRowCount = incidentRowSize(incidentBandCount);
    view_.columnCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    PRT_ASSERT(matrices.numbers.columnCount() == view_.matrixSize(),
               "a number for each channel, row and column");
    groups_ = cutRows(view_.rowCount);
    view_.groups = groups_;
    bytes_ = allocateAlignedBytes(std::max<std::size_t>(byteCount(), 1));
    view_.data = bytes_.get();
    switch (view_.encoding) {
        case TransferEncoding::float32:
            pack<float>(matrices.numbers);
            break;
        case TransferEncoding::unorm16:
            pack<std::uint16_t>(matrices.numbers);
            break;
        case TransferEncoding::unorm8:
            pack<std::uint8_t>(matrices.numbers);
            break;
    }
}

template <class Stored>
void MatrixBlocks::pack(const CoefficientTable& numbers) {
    auto* const packed = reinterpret_cast<Stored*>(bytes_.get());
    std::fill_n(packed, byteCount() / sizeof(Stored), Stored{0});
    std::vector<Stored> matrix(view_.matrixSize());
    for (std::size_t r = 0; r < matrixCount_; ++r) {
        numbers.readRow(r, std::span(matrix));
        const std::size_t inBlock = r % kMatrixBlockSize;
        Stored* const block = packed + (r - inBlock) * matrix.size();
        for (const RowGroup& group : groups_) {
            const GroupPlace place(view_, group, inBlock);
            for (std::size_t channel = 0; channel < view_.channelCount; ++channel)
                for (std::size_t row = 0; row < group.width; ++row) {
                    const Stored* const from =
                        &matrix[(channel * view_.rowCount + rows_[group.firstRow + row]) *
                                view_.columnCount];
                    Stored* const to =
                        block + place.firstColumn + channel * place.channelStride + row;
                    for (std::size_t j = 0; j < view_.columnCount; ++j)
                        to[j * place.columnStride] = from[j];
                }
        }
    }
}

std::size_t MatrixBlocks::blockBytes() const {
    return kMatrixBlockSize * view_.matrixSize() * bytesPerCoefficient(view_.encoding);
}

std::size_t MatrixBlocks::byteCount() const {
    return (matrixCount_ + kMatrixBlockSize - 1) / kMatrixBlockSize * blockBytes();
}

std::span<const std::byte> MatrixBlocks::block(std::size_t begin) const {
    if (begin >= matrixCount_) return {};
    return {bytes_.get() + begin / kMatrixBlockSize * blockBytes(), blockBytes()};
}

AlignedBytes MatrixBlocks::fold(const Lighting& lighting) const {
    PRT_ASSERT(lighting.coefficients.size() <= view_.columnCount,
               "light has no more bands than transfer");
    const std::size_t groupSize = (1 + view_.columnCount) * 3 * kLanes;
    const std::size_t floatCount = groups_.size() * groupSize;
    AlignedBytes bytes = allocateAlignedBytes(floatCount * sizeof(float));
    auto* folded = reinterpret_cast<float*>(bytes.get());
    std::fill_n(folded, floatCount, 0.0f);
    for (const RowGroup& group : groups_) {
        for (std::size_t color = 0; color < 3; ++color)
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const std::size_t channel = view_.channelCount == 3 ? color : 0;
                const std::size_t i = rows_[group.firstRow + lane % group.width];
                float* const at = folded + color * kLanes + lane;
                double constant = 0.0;
                for (std::size_t j = 0; j < lighting.coefficients.size(); ++j) {
                    const StoredRange& range =
                        ranges_[(channel * view_.rowCount + i) * view_.columnCount + j];
                    const double light = lighting.coefficients[j][static_cast<int>(color)];
                    at[(1 + j) * 3 * kLanes] = static_cast<float>(range.scale * light);
                    constant += range.bias * light;
                }
                *at = static_cast<float>(constant);
            }
        folded += groupSize;
    }
    return bytes;
}

void MatrixBlocks::multiply(const AlignedBytes& light, std::size_t begin, std::size_t blockCount,
                            std::size_t stride, float* incident) const {
    PRT_ASSERT(begin % kMatrixBlockSize == 0, "what is asked for begins with a block");
    PRT_ASSERT(begin + blockCount * kMatrixBlockSize < matrixCount_ + kMatrixBlockSize,
               "what is asked for is there");
    MatrixView blocks = view_;
    blocks.data += begin / kMatrixBlockSize * blockBytes();
    multiplyMatrices(blocks, reinterpret_cast<const float*>(light.get()), blockCount, stride,
                     incident);
}

}  // namespace prt

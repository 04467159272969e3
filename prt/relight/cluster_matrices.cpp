// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/relight/cluster_matrices.h"

#include <algorithm>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

std::size_t countBlocks(std::size_t matrixCount) {
    return (matrixCount + kMatrixBlockSize - 1) / kMatrixBlockSize;
}

}  // namespace

ClusterMatrices::ClusterMatrices(const CompressedLayer& layer, int bandCount)
    : vectorSize_(3 * incidentRowSize(layer.incidentBandCount)),
      bases_(layer.bases->vectors, bandCount, layer.incidentBandCount, layer.channelCount),
      clusters_(layer.table.numbers.rowCount()) {
    for (const std::size_t first : layer.bases->firstVectors())
        firstVectors_.push_back(static_cast<std::uint32_t>(first));
    readClusters(layer, 0, clusters_);
    view_.encoding = layer.table.encoding;
    view_.componentCount = layer.bases->componentCount();
    weightBytes_ =
        clusters_.size() * view_.componentCount * bytesPerCoefficient(layer.table.encoding);
    weights_ = allocateAlignedBytes(std::max<std::size_t>(weightBytes_, 1));
    switch (layer.table.encoding) {
        case TransferEncoding::float32:
            copyWeights<float>(layer.table.numbers);
            break;
        case TransferEncoding::unorm16:
            copyWeights<std::uint16_t>(layer.table.numbers);
            break;
        case TransferEncoding::unorm8:
            copyWeights<std::uint8_t>(layer.table.numbers);
            break;
    }
}

template <class Stored>
void ClusterMatrices::copyWeights(const CoefficientTable& rows) {
    auto* const weights = reinterpret_cast<Stored*>(weights_.get());
    std::vector<Stored> row(rows.columnCount());
    for (std::size_t r = 0; r < rows.rowCount(); ++r) {
        rows.readRow(r, std::span(row));
        std::copy(row.begin() + 1, row.end(), weights + r * view_.componentCount);
    }
}

std::size_t ClusterMatrices::byteCount() const {
    return bases_.byteCount() + std::span(firstVectors_).size_bytes() +
           std::span(clusters_).size_bytes() + weightBytes_;
}

AlignedBytes ClusterMatrices::fold(const Lighting& lighting) const {
    const std::size_t blockCount = countBlocks(bases_.matrixCount());
    AlignedBytes bytes = allocateAlignedBytes(
        std::max<std::size_t>(blockCount * kMatrixBlockSize * vectorSize_ * sizeof(float), 1));
    auto* const products = reinterpret_cast<float*>(bytes.get());
    bases_.multiply(bases_.fold(lighting), 0, blockCount, vectorSize_, products);
    // Let components take the weights as they are stored.
    const auto fraction = static_cast<float>(1.0 / largestStored(view_.encoding));
    for (std::size_t k = 0; k + 1 < firstVectors_.size(); ++k)
        std::for_each(products + (firstVectors_[k] + 1) * vectorSize_,
                      products + firstVectors_[k + 1] * vectorSize_,
                      [fraction](float& number) { number *= fraction; });
    return bytes;
}

void ClusterMatrices::multiply(const AlignedBytes& light, std::size_t begin, std::size_t blockCount,
                               std::size_t stride, float* incident) const {
    PRT_ASSERT(begin <= clusters_.size(), "what is asked for is there");
    ClusteredMatrices matrices = view_;
    matrices.clusters = clusters_.data() + begin;
    matrices.firstVectors = firstVectors_.data();
    matrices.weights =
        weights_.get() + begin * view_.componentCount * bytesPerCoefficient(view_.encoding);
    weighProducts(matrices, reinterpret_cast<const float*>(light.get()), vectorSize_,
                  std::min(blockCount * kMatrixBlockSize, clusters_.size() - begin), stride,
                  incident);
}

}  // namespace prt

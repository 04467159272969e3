// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/transfer/compressed_transfer.h"

#include <algorithm>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// The first column of rows is the cluster, as it is: the integers, or a float that is one.
template <class Stored>
void readFirstColumn(const CoefficientTable& numbers, std::size_t firstRow,
                     std::span<std::uint32_t> clusters) {
    constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
    const auto* panel = reinterpret_cast<const Stored*>(numbers.panel(0).data());
    for (std::size_t i = 0; i < clusters.size(); ++i)
        clusters[i] = static_cast<std::uint32_t>(panel[(firstRow + i) * kWidth]);
}

/// Whether each receiver's cluster is one of the layer.
bool hasItsClusters(const CompressedLayer& layer) {
    std::vector<std::uint32_t> clusters(layer.table.numbers.rowCount());
    readClusters(layer, 0, clusters);
    return std::ranges::all_of(clusters,
                               [&](std::uint32_t k) { return k < layer.bases->clusterCount(); });
}

bool isComplete(const ClusterBases& bases, std::size_t dimension) {
    const StoredTable& vectors = bases.vectors;
    return bases.clusterCount() > 0 && vectors.numbers.columnCount() == dimension &&
           vectors.numbers.rowCount() == bases.firstVectors().back() &&
           vectors.numbers.elementBytes() == bytesPerCoefficient(vectors.encoding);
}

}  // namespace

std::size_t ClusterBases::componentCount() const {
    return componentCounts.empty() ? 0 : std::ranges::max(componentCounts);
}

std::vector<std::size_t> ClusterBases::firstVectors() const {
    std::vector<std::size_t> first = {0};
    for (const std::uint32_t count : componentCounts)
        first.push_back(first.back() + 1 + count);
    return first;
}

const CompressedLayer* CompressedTransfer::findLayer(Transport transport) const {
    const auto found = std::find_if(
        layers.begin(), layers.end(),
        [transport](const CompressedLayer& layer) { return layer.transport == transport; });
    return found == layers.end() ? nullptr : &*found;
}

std::size_t coefficientsPerReceiver(int bandCount, const CompressedLayer& layer) {
    return coefficientsPerReceiver(bandCount, layer.channelCount, layer.incidentBandCount);
}

std::size_t bytesPerReceiver(const CompressedLayer& layer) {
    return layer.table.numbers.columnCount() * layer.table.numbers.elementBytes();
}

std::size_t countSharedBytes(const CompressedLayer& layer) {
    return layer.bases ? layer.bases->vectors.numbers.byteCount() : 0;
}

double sharedBytesPerReceiver(const CompressedLayer& layer) {
    const std::size_t receiverCount = layer.table.numbers.rowCount();
    if (receiverCount == 0) return 0.0;
    return static_cast<double>(countSharedBytes(layer)) / static_cast<double>(receiverCount);
}

bool isComplete(const CompressedTransfer& transfer, const CompressedLayer& layer) {
    const CoefficientTable& numbers = layer.table.numbers;
    const std::size_t dimension = coefficientsPerReceiver(transfer.bandCount, layer);
    if (numbers.rowCount() != transfer.receiverCount ||
        numbers.elementBytes() != bytesPerCoefficient(layer.table.encoding))
        return false;
    if (!layer.bases) return numbers.columnCount() == dimension;
    return isComplete(*layer.bases, dimension) &&
           numbers.columnCount() == 1 + layer.bases->componentCount() && hasItsClusters(layer);
}

void readClusters(const CompressedLayer& layer, std::size_t firstReceiver,
                  std::span<std::uint32_t> clusters) {
    const CoefficientTable& numbers = layer.table.numbers;
    PRT_ASSERT(layer.bases && firstReceiver + clusters.size() <= numbers.rowCount(),
               "the receivers are some of a layer with clusters");
    switch (layer.table.encoding) {
        case TransferEncoding::float32:
            return readFirstColumn<float>(numbers, firstReceiver, clusters);
        case TransferEncoding::unorm16:
            return readFirstColumn<std::uint16_t>(numbers, firstReceiver, clusters);
        case TransferEncoding::unorm8:
            return readFirstColumn<std::uint8_t>(numbers, firstReceiver, clusters);
    }
}

LayerDecoder::LayerDecoder(const CompressedLayer& layer) : layer_(layer) {
    if (!layer.bases) return;
    vectors_ = expandTable(layer.bases->vectors);
    firstVectors_ = layer.bases->firstVectors();
}

std::vector<float> LayerDecoder::expand(std::size_t firstReceiver,
                                        std::size_t receiverCount) const {
    return layer_.bases ? expandClusters(firstReceiver, receiverCount)
                        : expandRows(layer_.table, firstReceiver, receiverCount);
}

/// b_k0 + Σ_p w_p b_kp for each receiver, summed in double.
std::vector<float> LayerDecoder::expandClusters(std::size_t firstReceiver,
                                                std::size_t receiverCount) const {
    const std::size_t dimension = layer_.bases->vectors.numbers.columnCount();
    const std::size_t rowLength = layer_.table.numbers.columnCount();
    std::vector<std::uint32_t> clusters(receiverCount);
    readClusters(layer_, firstReceiver, clusters);
    const std::vector<float> rows = expandRows(layer_.table, firstReceiver, receiverCount);
    std::vector<float> values;
    values.reserve(receiverCount * dimension);
    std::vector<double> sum(dimension);
    for (std::size_t i = 0; i < receiverCount; ++i) {
        const std::uint32_t k = clusters[i];
        const float* vector = &vectors_[firstVectors_[k] * dimension];
        std::copy_n(vector, dimension, sum.begin());
        for (std::uint32_t p = 1; p <= layer_.bases->componentCounts[k]; ++p) {
            vector += dimension;
            const double weight = rows[i * rowLength + p];
            for (std::size_t j = 0; j < dimension; ++j)
                sum[j] += weight * vector[j];
        }
        for (const double value : sum)
            values.push_back(static_cast<float>(value));
    }
    return values;
}

std::vector<float> expandLayer(const CompressedLayer& layer) {
    return LayerDecoder(layer).expand(0, layer.table.numbers.rowCount());
}

TransferField expandTransfer(const CompressedTransfer& transfer) {
    TransferField field;
    field.bandCount = transfer.bandCount;
    field.receiverCount = transfer.receiverCount;
    field.receiverOfVertex = transfer.receiverOfVertex;
    for (const CompressedLayer& layer : transfer.layers)
        field.layers.push_back(
            {layer.transport, layer.channelCount,
             makeTable(coefficientsPerReceiver(transfer.bandCount, layer), expandLayer(layer)),
             layer.incidentBandCount});
    return field;
}

}  // namespace prt

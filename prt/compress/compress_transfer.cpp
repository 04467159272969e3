#include "prt/compress/compress_transfer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "prt/base/assert.h"
#include "prt/compress/compression_error.h"
#include "prt/compress/light_error_weights.h"
#include "prt/compress/quantise_table.h"

namespace prt {
namespace {

bool isFinite(const CoefficientTable& coefficients) {
    for (std::size_t index = 0; index < coefficients.panelCount(); ++index) {
        const std::span<const float> panel = floatPanel(coefficients, index);
        if (!std::all_of(panel.begin(), panel.end(),
                         [](float value) { return std::isfinite(value); }))
            return false;
        coefficients.releaseMemory();
    }
    return true;
}

/// Whether a layer is stored by its columns, which its numbers can go to.
bool isByColumns(const TransferLayer& layer, const CompressOptions& options) {
    return (!options.clusters && !options.budget) || layer.coefficients.rowCount() == 0;
}

CompressedLayer compressColumns(TransferLayer layer, const CompressOptions& options) {
    return {.transport = layer.transport,
            .channelCount = layer.channelCount,
            .table = quantiseTable(std::move(layer.coefficients), options.encoding),
            .incidentBandCount = layer.incidentBandCount};
}

void checkLayer(const TransferLayer& layer, int bandCount) {
    PRT_ASSERT(layer.coefficients.columnCount() == coefficientsPerReceiver(bandCount, layer),
               "the layer has all coefficients");
    PRT_ASSERT(isFinite(layer.coefficients), "every coefficient is finite");
}

CompressedLayer compressByClusters(const TransferLayer& layer, const CompressOptions& options) {
    const ClusterOptions clusters = options.clusters.value_or(ClusterOptions{});
    if (options.budget)
        return compressToBudget(layer, clusters, *options.budget, options.threadCount,
                                options.progress);
    ClusteredTable clustered =
        compressClusters(layer.coefficients,
                         weighRows(clusters.light, layer.coefficients.columnCount(),
                                   layer.channelCount, layer.incidentBandCount),
                         clusters, options.encoding, options.threadCount, options.progress);
    return {.transport = layer.transport,
            .channelCount = layer.channelCount,
            .table = std::move(clustered.table),
            .bases = std::move(clustered.bases),
            .incidentBandCount = layer.incidentBandCount};
}

}  // namespace

CompressedLayer compressLayer(const TransferLayer& layer, int bandCount,
                              const CompressOptions& options) {
    checkLayer(layer, bandCount);
    if (isByColumns(layer, options)) return compressColumns(layer, options);
    CompressedLayer compressed = compressByClusters(layer, options);
    if (compressed.bases)
        compressed.largestError =
            static_cast<float>(measureCompressionError(compressed, layer).largest);
    return compressed;
}

CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options) {
    CompressedTransfer transfer;
    transfer.bandCount = field.bandCount;
    transfer.receiverCount = field.receiverCount;
    transfer.receiverOfVertex = std::move(field.receiverOfVertex);
    for (TransferLayer& layer : field.layers) {
        PRT_ASSERT(layer.coefficients.rowCount() == field.receiverCount,
                   "the layer has all receivers");
        if (isByColumns(layer, options)) {
            checkLayer(layer, field.bandCount);
            transfer.layers.push_back(compressColumns(std::move(layer), options));
        } else {
            transfer.layers.push_back(compressLayer(layer, field.bandCount, options));
            layer.coefficients = {};
        }
    }
    return transfer;
}

}  // namespace prt

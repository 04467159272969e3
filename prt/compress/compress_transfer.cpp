#include "prt/compress/compress_transfer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "prt/base/assert.h"
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

CompressedLayer compressLayer(TransferLayer layer, int bandCount, const CompressOptions& options) {
    const bool isEmpty = layer.coefficients.rowCount() == 0;
    if (options.budget && !isEmpty)
        return compressToBudget(layer, options.clusters.value_or(ClusterOptions{}), *options.budget,
                                options.threadCount, options.progress);
    CompressedLayer compressed{.transport = layer.transport, .channelCount = layer.channelCount};
    if (!options.clusters || isEmpty) {
        compressed.table = quantiseTable(std::move(layer.coefficients), options.encoding);
        return compressed;
    }
    const std::vector<Vec3d>& light = options.clusters->light;
    std::vector<float> errorWeights;
    if (!light.empty()) errorWeights = lightErrorWeights(light, bandCount, layer.channelCount);
    ClusteredTable clustered =
        compressClusters(layer.coefficients, errorWeights, *options.clusters, options.encoding,
                         options.threadCount, options.progress);
    compressed.table = std::move(clustered.table);
    compressed.bases = std::move(clustered.bases);
    return compressed;
}

}  // namespace

CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options) {
    CompressedTransfer transfer;
    transfer.bandCount = field.bandCount;
    transfer.receiverCount = field.receiverCount;
    transfer.receiverOfVertex = std::move(field.receiverOfVertex);
    for (TransferLayer& layer : field.layers) {
        PRT_ASSERT(layer.coefficients.rowCount() == field.receiverCount &&
                       layer.coefficients.columnCount() ==
                           coefficientsPerReceiver(field.bandCount, layer.channelCount),
                   "the layer has all coefficients of all receivers");
        PRT_ASSERT(isFinite(layer.coefficients), "every coefficient is finite");
        transfer.layers.push_back(compressLayer(std::move(layer), field.bandCount, options));
    }
    return transfer;
}

}  // namespace prt

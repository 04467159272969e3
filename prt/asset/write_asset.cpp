#include "prt/asset/asset.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "prt/asset/asset_header.h"
#include "prt/base/assert.h"
#include "prt/gltf/glb_writer.h"

namespace prt {
namespace {

/// The coefficients of one mesh's vertices: a part of the scene-wide list of receivers.
using Receivers = std::span<const std::uint32_t>;

/// Copies the coefficients [4·part, 4·part + 4) of each vertex's receiver.
void copyAttribute(const CoefficientTable& data, std::size_t part, Receivers receivers,
                   std::span<std::byte> values) {
    const std::span<const std::byte> panel = data.panel(part);
    const std::size_t elementBytes = kCoefficientsPerAttribute * data.elementBytes();
    for (std::size_t vertex = 0; vertex < receivers.size(); ++vertex)
        std::memcpy(values.data() + vertex * elementBytes,
                    panel.data() + receivers[vertex] * elementBytes, elementBytes);
    data.releaseMemory();
}

std::vector<GlbAccessor> makeAttributes(const CompressedTransfer& transfer, Receivers receivers) {
    std::vector<GlbAccessor> attributes;
    for (const CompressedLayer& layer : transfer.layers) {
        const AccessorInfo info = attributeInfo(layer, receivers.size());
        for (std::size_t part = 0; part < countAttributes(transfer.bandCount, layer); ++part) {
            const auto write = [&layer, part, receivers](std::span<std::byte> values) {
                copyAttribute(layer.table.numbers, part, receivers, values);
            };
            attributes.push_back({attributeSemantic(attributes.size()), info, write});
        }
    }
    return attributes;
}

/// The vectors of clusters, in the order of arrangeVectors.
std::vector<GlbAccessor> makeAccessors(const CompressedTransfer& transfer) {
    std::vector<GlbAccessor> accessors;
    for (const CompressedLayer& layer : transfer.layers) {
        if (!layer.bases) continue;
        const auto write = [&bases = *layer.bases](std::span<std::byte> values) {
            std::ranges::copy(packVectors(bases), values.begin());
        };
        const std::size_t dimension = coefficientsPerReceiver(transfer.bandCount, layer);
        accessors.push_back(
            {"the vectors of clusters", vectorsInfo(*layer.bases, dimension), write});
    }
    return accessors;
}

void checkTransfer(const Scene& scene, const CompressedTransfer& transfer) {
    PRT_ASSERT(transfer.receiverOfVertex.size() == scene.vertexCount(),
               "each vertex of the scene has a receiver");
    PRT_ASSERT(
        std::all_of(transfer.receiverOfVertex.begin(), transfer.receiverOfVertex.end(),
                    [&](std::uint32_t receiver) { return receiver < transfer.receiverCount; }),
        "each vertex's receiver is one of the transfer");
    for (const CompressedLayer& layer : transfer.layers) {
        PRT_ASSERT(isComplete(transfer, layer), "each layer has all coefficients of all receivers");
        PRT_ASSERT(isGlossy(layer.transport) == (layer.incidentBandCount > 0),
                   "matrices have bands of incident radiance, and vectors have none");
        if (!layer.bases) continue;
        PRT_ASSERT(layer.table.scale.empty(), "weights have no ranges of their own");
        checkClusterCounts(layer);
    }
}

/// Meshes without a triangle are not written.
std::size_t countWrittenVertices(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.triangleCount() > 0) count += mesh.vertexCount();
    return count;
}

GlbExtension makeExtension(const Scene& scene, const CompressedTransfer& transfer,
                           const Provenance& provenance) {
    checkTransfer(scene, transfer);
    GlbExtension extension;
    extension.name = kAssetExtension;
    extension.rootJson = formatHeader(transfer, countWrittenVertices(scene), provenance);
    extension.accessors = makeAccessors(transfer);
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        extension.meshJson.push_back("{}");
        extension.attributes.push_back(makeAttributes(
            transfer, Receivers(transfer.receiverOfVertex)
                          .subspan(offsets[mesh], offsets[mesh + 1] - offsets[mesh])));
    }
    return extension;
}

}  // namespace

std::vector<std::byte> encodeAsset(const Scene& scene, const CompressedTransfer& transfer,
                                   const Provenance& provenance, const AssetOptions& options) {
    const GlbExtension extension = makeExtension(scene, transfer, provenance);
    return encodeGlb(scene, &extension, {.meshopt = options.meshopt});
}

void writeAsset(const std::filesystem::path& path, const Scene& scene,
                const CompressedTransfer& transfer, const Provenance& provenance,
                const AssetOptions& options) {
    const GlbExtension extension = makeExtension(scene, transfer, provenance);
    writeGlb(path, scene, &extension, {.meshopt = options.meshopt});
}

}  // namespace prt

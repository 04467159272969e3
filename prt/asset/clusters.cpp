#include "prt/asset/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <type_traits>

#include "prt/asset/reject_asset.h"
#include "prt/asset/table_header.h"
#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/gltf/glb_writer.h"

namespace prt {
namespace {

using gltf::JsonCursor;

// What a word, and a byte, can tell apart.
constexpr std::size_t kMaxClusterCount = 65536;
constexpr std::size_t kMaxClusterCountInBytes = 256;
constexpr std::size_t kMaxComponentCount = 255;

std::size_t maxClusterCount(const CompressedLayer& layer) {
    return layer.table.encoding == TransferEncoding::unorm8 ? kMaxClusterCountInBytes
                                                            : kMaxClusterCount;
}

/// Calls `check(receiver, number)` for all of a column.
template <class Stored, class Check>
void visitColumn(const CoefficientTable& numbers, std::size_t column, Check check) {
    constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
    const auto* panel = reinterpret_cast<const Stored*>(numbers.panel(column / kWidth).data());
    for (std::size_t i = 0; i < numbers.rowCount(); ++i)
        check(i, panel[i * kWidth + column % kWidth]);
}

template <class Stored>
void checkRows(const CompressedLayer& layer) {
    const CoefficientTable& numbers = layer.table.numbers;
    const std::vector<std::uint32_t>& componentCounts = layer.bases->componentCounts;
    visitColumn<Stored>(numbers, 0, [&](std::size_t, double k) {
        if (!(k >= 0.0 && k < static_cast<double>(componentCounts.size()) && k == std::floor(k)))
            rejectAsset("has a vertex in a cluster that is not there");
    });
    std::vector<std::uint32_t> clusters(numbers.rowCount());
    readClusters(layer, 0, clusters);
    const double largest = largestStored(layer.table.encoding);
    for (std::size_t p = 1; p < numbers.columnCount(); ++p)
        visitColumn<Stored>(numbers, p, [&](std::size_t i, double weight) {
            if (!(weight >= 0.0 && weight <= largest)) rejectAsset("holds a weight beyond 0 and 1");
            if (weight != 0.0 && p > componentCounts[clusters[i]])
                rejectAsset("holds a weight for a component that its cluster does not have");
        });
}

}  // namespace

void checkClusterCounts(const CompressedLayer& layer) {
    const std::size_t clusterCount = layer.bases->clusterCount();
    if (clusterCount > maxClusterCount(layer))
        throw Error(ErrorCode::limitExceeded,
                    "has " + std::to_string(clusterCount) + " clusters, more than the " +
                        std::to_string(maxClusterCount(layer)) + " that " +
                        std::string(encodingName(layer.table.encoding)) + " can count");
    const std::size_t componentCount = layer.bases->componentCount();
    if (componentCount > kMaxComponentCount)
        throw Error(ErrorCode::limitExceeded, "has a cluster of " + std::to_string(componentCount) +
                                                  " components, more than the " +
                                                  std::to_string(kMaxComponentCount) +
                                                  " that an asset can have");
}

AccessorInfo vectorsInfo(const ClusterBases& bases, std::size_t dimension) {
    return storedInfo(bases.vectors.encoding, bases.firstVectors().back() * dimension, 1);
}

std::vector<std::byte> packVectors(const ClusterBases& bases) {
    const CoefficientTable& numbers = bases.vectors.numbers;
    const std::size_t rowBytes = numbers.columnCount() * numbers.elementBytes();
    std::vector<std::byte> bytes(numbers.rowCount() * rowBytes);
    for (std::size_t row = 0; row < numbers.rowCount(); ++row)
        numbers.readRow(row, std::span(bytes).subspan(row * rowBytes, rowBytes));
    return bytes;
}

nlohmann::ordered_json describeClusters(const CompressedLayer& layer, const VectorsPlace& place) {
    nlohmann::ordered_json object;
    object["weights"] = encodingName(layer.table.encoding);
    object["components"] = layer.bases->componentCounts;
    object["encoding"] = encodingName(layer.bases->vectors.encoding);
    describeRanges(layer.bases->vectors, object);
    object["accessor"] = place.accessor;
    object["checksum"] = place.checksum;
    return object;
}

std::string clusterChecksumText(const CompressedLayer& layer, const VectorsPlace& place) {
    std::string text = std::string(encodingName(layer.table.encoding)) + " " +
                       std::string(encodingName(layer.bases->vectors.encoding)) + " " +
                       place.checksum;
    for (const std::uint32_t count : layer.bases->componentCounts)
        text += " " + std::to_string(count);
    return text;
}

VectorsPlace parseClusters(const JsonCursor& object, std::size_t dimension,
                           CompressedLayer& layer) {
    const JsonCursor components = object.at("components");
    if (components.size() == 0 || components.size() > maxClusterCount(layer))
        components.reject("must be of 1 to " + std::to_string(maxClusterCount(layer)) +
                          " clusters");
    for (std::size_t k = 0; k < components.size(); ++k) {
        const std::size_t count = components[k].toCount();
        if (count > kMaxComponentCount)
            components[k].reject("is more than " + std::to_string(kMaxComponentCount));
        layer.bases->componentCounts.push_back(static_cast<std::uint32_t>(count));
    }
    parseRanges(object, dimension, layer.bases->vectors);
    return {object.at("accessor").toCount(), object.at("checksum").toString()};
}

void readVectors(const GltfDocument& document, const VectorsPlace& place, int bandCount,
                 CompressedLayer& layer) {
    const std::size_t dimension = coefficientsPerReceiver(bandCount, layer);
    const std::string name = "accessor " + std::to_string(place.accessor);
    if (place.accessor >= document.accessorCount())
        rejectAsset("has no " + name + ", which should hold the vectors of clusters");
    const AccessorInfo expected = vectorsInfo(*layer.bases, dimension);
    if (document.describeAccessor(place.accessor) != expected)
        rejectAsset(name + " is not of the form that its layer's clusters need");
    const std::vector<std::byte> bytes = document.readRaw(place.accessor);
    if (formatChecksum(computeCrc32(bytes)) != place.checksum)
        rejectAsset(name +
                    " does not hold the vectors of the layer's clusters: its checksum differs");
    StoredTable& vectors = layer.bases->vectors;
    vectors.numbers = CoefficientTable(expected.count / dimension, dimension,
                                       bytesPerCoefficient(vectors.encoding));
    vectors.numbers.writeRows(0, std::span<const std::byte>(bytes));
    checkCoefficients(vectors);
}

void checkWeights(const CompressedLayer& layer) {
    switch (layer.table.encoding) {
        case TransferEncoding::float32:
            return checkRows<float>(layer);
        case TransferEncoding::unorm16:
            return checkRows<std::uint16_t>(layer);
        case TransferEncoding::unorm8:
            return checkRows<std::uint8_t>(layer);
    }
}

}  // namespace prt

#include "prt/asset/asset_header.h"

#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "prt/asset/table_header.h"
#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/basis/sh_convention.h"
#include "prt/gltf/glb_writer.h"
#include "prt/gltf/json_cursor.h"

namespace prt {
namespace {

using gltf::JsonCursor;

// What the coefficients of this format are: outgoing radiance over the receiver's albedo (C6, C7).
constexpr const char* kQuantity = "outgoingRadianceOverAlbedo";
// Version 1.0 has no clusters, and 1.1 no matrices.
constexpr int kClustersSinceMinor = 1;
constexpr int kMatricesSinceMinor = 2;

std::string formatVersion() {
    return std::to_string(kAssetVersionMajor) + "." + std::to_string(kAssetVersionMinor);
}

/// What a layer says, but for the checksum of that.
struct LayerDescription {
    int bandCount = 0;
    const CompressedLayer& layer;
    const AttributeRange& range;
    const VectorsPlace& vectors;
};

std::string encodingText(const CompressedLayer& layer) {
    return layer.bases ? kClusters : std::string(encodingName(layer.table.encoding));
}

/// The CRC-32 of a layer's description: a line of text with all that it
/// says, and its ranges as floats.
std::string computeLayerChecksum(const LayerDescription& description) {
    const CompressedLayer& layer = description.layer;
    std::string bytes = std::string(transportName(layer.transport)) + " " + encodingText(layer);
    for (const std::size_t number : {static_cast<std::size_t>(layer.channelCount),
                                     static_cast<std::size_t>(description.bandCount),
                                     description.range.first, description.range.count})
        bytes += " " + std::to_string(number);
    if (isGlossy(layer.transport)) bytes += " " + std::to_string(layer.incidentBandCount);
    if (layer.bases) bytes += " " + clusterChecksumText(layer, description.vectors);
    bytes += rangeBytes(layer.bases ? layer.bases->vectors : layer.table);
    if (layer.largestError > 0.0f)
        bytes.append(reinterpret_cast<const char*>(&layer.largestError), sizeof(float));
    return formatChecksum(computeCrc32(std::as_bytes(std::span(bytes))));
}

nlohmann::ordered_json describeLayer(const LayerDescription& description) {
    const CompressedLayer& layer = description.layer;
    nlohmann::ordered_json object;
    object["transport"] = transportName(layer.transport);
    object["channels"] = layer.channelCount;
    if (isGlossy(layer.transport)) object["incidentBands"] = layer.incidentBandCount;
    object["encoding"] = encodingText(layer);
    object["attributes"] = {{"first", description.range.first}, {"count", description.range.count}};
    if (layer.bases)
        object["clusters"] = describeClusters(layer, description.vectors);
    else
        describeRanges(layer.table, object);
    if (layer.largestError > 0.0f) object["largestError"] = layer.largestError;
    object["checksum"] = computeLayerChecksum(description);
    return object;
}

int parseCount(const JsonCursor& cursor) {
    const std::size_t count = cursor.toCount();
    if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        cursor.reject("is too large");
    return static_cast<int>(count);
}

/// A 64-bit number as decimal text, since JSON numbers are doubles to many programs.
std::uint64_t parseSeed(const JsonCursor& cursor) {
    const std::string& digits = cursor.toString();
    std::uint64_t seed = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    if (failure != std::errc() || end != digits.data() + digits.size())
        cursor.reject("must be a whole number below 2^64, as text");
    return seed;
}

Provenance parseProvenance(const JsonCursor& object) {
    Provenance provenance;
    provenance.generator = object.at("generator").toString();
    provenance.command = object.at("command").toString();
    provenance.sampleCount = parseCount(object.at("sampleCount"));
    provenance.bounceCount = parseCount(object.at("bounceCount"));
    provenance.seed = parseSeed(object.at("seed"));
    provenance.isa = object.at("isa").toString();
    return provenance;
}

[[noreturn]] void rejectAsTooNew(const JsonCursor& member, int minorVersion) {
    member.reject("is none that a file of version 1." + std::to_string(minorVersion) + " can have");
}

/// The transport and the encodings of a layer; nothing where a newer minor version names one that
/// is not known here.
std::optional<CompressedLayer> parseKind(const JsonCursor& object, int minorVersion) {
    const JsonCursor kind = object.at("encoding");
    const bool hasClusters = kind.toString() == kClusters;
    if (hasClusters && minorVersion < kClustersSinceMinor) rejectAsTooNew(kind, minorVersion);
    const JsonCursor ofTable = hasClusters ? object.at("clusters").at("weights") : kind;
    const JsonCursor ofVectors = hasClusters ? object.at("clusters").at("encoding") : kind;
    const auto transport = parseTransport(object.at("transport").toString());
    const auto tableEncoding = parseEncoding(ofTable.toString());
    const auto vectorsEncoding = parseEncoding(ofVectors.toString());
    const bool isKnown = transport && tableEncoding && vectorsEncoding;
    if (!isKnown && minorVersion > kAssetVersionMinor) return std::nullopt;
    if (!transport) object.at("transport").reject("is no kind of transport");
    if (!tableEncoding) ofTable.reject("is no encoding");
    if (!vectorsEncoding) ofVectors.reject("is no encoding");
    if (isGlossy(*transport) && minorVersion < kMatricesSinceMinor)
        rejectAsTooNew(object.at("transport"), minorVersion);

    CompressedLayer layer;
    layer.transport = *transport;
    layer.table.encoding = *tableEncoding;
    if (hasClusters) layer.bases.emplace().vectors.encoding = *vectorsEncoding;
    return layer;
}

/// Of a layer of matrices.
int parseIncidentBands(const JsonCursor& member, int bandCount) {
    const int largest = kMaxBandCount + 1 - bandCount;
    const int count = parseCount(member);
    if (count < 1 || count > largest)
        member.reject("must be from 1 to " + std::to_string(largest) + " beside " +
                      std::to_string(bandCount) + " bands of light");
    return count;
}

float parseLargestError(const JsonCursor& layer) {
    const std::optional<JsonCursor> member = layer.find("largestError");
    if (!member) return 0.0f;
    const double error = member->toNumber();
    if (!(error > 0.0 && error <= kMaxCoefficient)) member->reject("must be above 0, at most 100");
    return static_cast<float>(error);
}

/// One member of the header's list of layers.
void parseLayer(const JsonCursor& object, int minorVersion, AssetHeader& header) {
    std::optional<CompressedLayer> known = parseKind(object, minorVersion);
    if (!known) return;
    CompressedLayer layer = *std::move(known);
    layer.channelCount = parseCount(object.at("channels"));
    if (layer.channelCount != 1 && layer.channelCount != 3)
        object.at("channels").reject("must be 1 or 3");
    if (isGlossy(layer.transport))
        layer.incidentBandCount = parseIncidentBands(object.at("incidentBands"), header.bandCount);
    const std::size_t dimension = coefficientsPerReceiver(header.bandCount, layer);
    VectorsPlace vectors;
    if (layer.bases)
        vectors = parseClusters(object.at("clusters"), dimension, layer);
    else
        parseRanges(object, dimension, layer.table);

    layer.largestError = parseLargestError(object);

    const JsonCursor attributes = object.at("attributes");
    const AttributeRange range{attributes.at("first").toCount(), attributes.at("count").toCount()};
    if (range.count != countAttributes(header.bandCount, layer))
        attributes.at("count").reject(layer.bases ? "does not fit the components of the clusters"
                                                  : "does not fit the bands and channels");
    if (object.at("checksum").toString() !=
        computeLayerChecksum({header.bandCount, layer, range, vectors}))
        object.reject("is damaged: its checksum differs");
    header.layers.push_back(std::move(layer));
    header.ranges.push_back(range);
    header.vectors.push_back(std::move(vectors));
}

/// Demands that layers are of different kinds, ascending, and share no attribute.
void checkLayers(const JsonCursor& list, const AssetHeader& header) {
    if (header.layers.empty()) list.reject("has no layer that can be read");
    for (std::size_t i = 1; i < header.layers.size(); ++i) {
        if (header.layers[i].transport <= header.layers[i - 1].transport)
            list.reject("must be of different kinds, ascending");
        const AttributeRange& before = header.ranges[i - 1];
        const AttributeRange& range = header.ranges[i];
        if (range.first < before.first || range.first - before.first < before.count)
            list.reject("must take attributes one after the other");
    }
}

/// The file's minor version. @throws Error  unsupported for another major version
int parseVersion(const JsonCursor& cursor) {
    const std::string& text = cursor.toString();
    int major = 0;
    int minor = 0;
    const char* end = text.data() + text.size();
    const auto majorEnd = std::from_chars(text.data(), end, major);
    const bool hasDot = majorEnd.ec == std::errc() && majorEnd.ptr != end && *majorEnd.ptr == '.';
    if (!hasDot) cursor.reject("must be two numbers and a dot");
    const auto minorEnd = std::from_chars(majorEnd.ptr + 1, end, minor);
    if (minorEnd.ec != std::errc() || minorEnd.ptr != end || major < 0 || minor < 0)
        cursor.reject("must be two numbers and a dot");
    if (major != kAssetVersionMajor)
        throw Error(ErrorCode::unsupported,
                    "has radiance transfer of version " + text +
                        ", and this library reads version " + formatVersion(),
                    {}, "use the OpenPRT that made it, or bake the scene again");
    return minor;
}

/// Demands the one value that this version knows.
void requireValue(const JsonCursor& object, const char* key, const std::string& known) {
    if (object.at(key).toString() != known)
        throw Error(ErrorCode::unsupported, object.at(key).place() + " is \"" +
                                                object.at(key).toString() +
                                                "\", and this library reads \"" + known + "\"");
}

}  // namespace

std::string attributeSemantic(std::size_t index) {
    return "_PRT_" + std::to_string(index);
}

AccessorInfo attributeInfo(const CompressedLayer& layer, std::size_t vertexCount) {
    return storedInfo(layer.table.encoding, vertexCount,
                      static_cast<int>(kCoefficientsPerAttribute));
}

std::size_t countNumbers(int bandCount, const CompressedLayer& layer) {
    return layer.bases ? 1 + layer.bases->componentCount()
                       : coefficientsPerReceiver(bandCount, layer);
}

std::size_t countAttributes(int bandCount, const CompressedLayer& layer) {
    return CoefficientTable::countPanels(countNumbers(bandCount, layer));
}

std::vector<AttributeRange> arrangeAttributes(const CompressedTransfer& transfer) {
    std::vector<AttributeRange> ranges;
    std::size_t first = 0;
    for (const CompressedLayer& layer : transfer.layers) {
        ranges.push_back({first, countAttributes(transfer.bandCount, layer)});
        first += ranges.back().count;
    }
    return ranges;
}

std::vector<VectorsPlace> arrangeVectors(const CompressedTransfer& transfer) {
    std::vector<VectorsPlace> places;
    std::size_t accessor = 0;
    for (const CompressedLayer& layer : transfer.layers) {
        VectorsPlace& place = places.emplace_back();
        if (layer.bases)
            place = {accessor++, formatChecksum(computeCrc32(packVectors(*layer.bases)))};
    }
    return places;
}

std::string formatHeader(const CompressedTransfer& transfer, std::size_t vertexCount,
                         const Provenance& provenance) {
    nlohmann::ordered_json header;
    header["version"] = formatVersion();
    header["bands"] = transfer.bandCount;
    header["vertices"] = vertexCount;
    header["convention"] = shConventionName(ShConvention::cs);
    header["quantity"] = kQuantity;
    header["provenance"] = {
        {"generator", provenance.generator},       {"command", provenance.command},
        {"sampleCount", provenance.sampleCount},   {"bounceCount", provenance.bounceCount},
        {"seed", std::to_string(provenance.seed)}, {"isa", provenance.isa}};
    header["layers"] = nlohmann::ordered_json::array();
    const std::vector<AttributeRange> ranges = arrangeAttributes(transfer);
    const std::vector<VectorsPlace> vectors = arrangeVectors(transfer);
    for (std::size_t i = 0; i < ranges.size(); ++i)
        header["layers"].push_back(
            describeLayer({transfer.bandCount, transfer.layers[i], ranges[i], vectors[i]}));
    return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

AssetHeader parseHeader(const std::string& json) {
    const gltf::Json parsed = gltf::parseJson(json);
    const JsonCursor root(parsed, kAssetExtension);
    const int minorVersion = parseVersion(root.at("version"));
    requireValue(root, "convention", std::string(shConventionName(ShConvention::cs)));
    requireValue(root, "quantity", kQuantity);

    AssetHeader header;
    header.bandCount = parseCount(root.at("bands"));
    if (header.bandCount < 1 || header.bandCount > kMaxBandCount)
        root.at("bands").reject("must be from 1 to " + std::to_string(kMaxBandCount));
    header.vertexCount = root.at("vertices").toCount();
    header.provenance = parseProvenance(root.at("provenance"));
    const JsonCursor layers = root.at("layers");
    for (std::size_t i = 0; i < layers.size(); ++i)
        parseLayer(layers[i], minorVersion, header);
    checkLayers(layers, header);
    const JsonCursor checksums = root.at("checksums");
    for (std::size_t i = 0; i < checksums.size(); ++i)
        header.checksums.push_back(checksums[i].toString());
    return header;
}

}  // namespace prt

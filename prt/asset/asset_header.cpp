#include "prt/asset/asset_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

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

std::string formatVersion() {
    return std::to_string(kAssetVersionMajor) + "." + std::to_string(kAssetVersionMinor);
}

/// The CRC-32 of a layer's description: a line of text with all that it
/// says, and its ranges as floats.
std::string computeLayerChecksum(int bandCount, const CompressedLayer& layer,
                                 const AttributeRange& range) {
    std::string bytes = std::string(transportName(layer.transport)) + " " +
                        std::string(encodingName(layer.table.encoding));
    for (const std::size_t number : {static_cast<std::size_t>(layer.channelCount),
                                     static_cast<std::size_t>(bandCount), range.first, range.count})
        bytes += " " + std::to_string(number);
    for (const std::vector<float>* numbers : {&layer.table.scale, &layer.table.bias})
        bytes.append(reinterpret_cast<const char*>(numbers->data()),
                     numbers->size() * sizeof(float));
    return formatChecksum(computeCrc32(std::as_bytes(std::span(bytes))));
}

nlohmann::ordered_json describeLayer(int bandCount, const CompressedLayer& layer,
                                     const AttributeRange& range) {
    nlohmann::ordered_json object;
    object["transport"] = transportName(layer.transport);
    object["channels"] = layer.channelCount;
    object["encoding"] = encodingName(layer.table.encoding);
    object["attributes"] = {{"first", range.first}, {"count", range.count}};
    if (layer.table.encoding != TransferEncoding::float32) {
        object["scale"] = layer.table.scale;
        object["bias"] = layer.table.bias;
    }
    object["checksum"] = computeLayerChecksum(bandCount, layer, range);
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

/// Reads a list of floats, each of a size that a coefficient can have.
std::vector<float> parseCoefficients(const JsonCursor& list, std::size_t count) {
    if (list.size() != count) list.reject("must have " + std::to_string(count) + " numbers");
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double number = list[i].toNumber();
        if (!(std::abs(number) <= kMaxCoefficient)) list[i].reject("is beyond ±100");
        values[i] = static_cast<float>(number);
    }
    return values;
}

void parseRanges(const JsonCursor& object, std::size_t count, CompressedLayer& layer) {
    layer.table.scale = parseCoefficients(object.at("scale"), count);
    layer.table.bias = parseCoefficients(object.at("bias"), count);
    for (std::size_t i = 0; i < count; ++i)
        if (layer.table.scale[i] < 0.0f) object.at("scale")[i].reject("is negative");
}

/// One member of the header's list of layers; passed over if a newer minor
/// version names a kind not known here.
void parseLayer(const JsonCursor& object, bool isNewer, AssetHeader& header) {
    const auto transport = parseTransport(object.at("transport").toString());
    const auto encoding = parseEncoding(object.at("encoding").toString());
    if (isNewer && (!transport || !encoding)) return;
    if (!transport) object.at("transport").reject("is no kind of transport");
    if (!encoding) object.at("encoding").reject("is no encoding");

    CompressedLayer layer;
    layer.transport = *transport;
    layer.table.encoding = *encoding;
    layer.channelCount = parseCount(object.at("channels"));
    if (layer.channelCount != 1 && layer.channelCount != 3)
        object.at("channels").reject("must be 1 or 3");
    if (layer.table.encoding != TransferEncoding::float32)
        parseRanges(object, coefficientsPerReceiver(header.bandCount, layer.channelCount), layer);

    const JsonCursor attributes = object.at("attributes");
    const AttributeRange range{attributes.at("first").toCount(), attributes.at("count").toCount()};
    if (range.count != countAttributes(header.bandCount, layer))
        attributes.at("count").reject("does not fit the bands and channels");
    if (object.at("checksum").toString() != computeLayerChecksum(header.bandCount, layer, range))
        object.reject("is damaged: its checksum differs");
    header.layers.push_back(std::move(layer));
    header.ranges.push_back(range);
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

/// Whether the file's minor version is newer than ours. @throws Error
/// unsupported for another major version
bool parseVersion(const JsonCursor& cursor) {
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
    return minor > kAssetVersionMinor;
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
    AccessorInfo info{vertexCount, static_cast<int>(kCoefficientsPerAttribute)};
    if (layer.table.encoding == TransferEncoding::unorm16) info.type = ComponentType::uint16;
    if (layer.table.encoding == TransferEncoding::unorm8) info.type = ComponentType::uint8;
    info.normalized = layer.table.encoding != TransferEncoding::float32;
    return info;
}

std::size_t countAttributes(int bandCount, const CompressedLayer& layer) {
    return CoefficientTable::countPanels(coefficientsPerReceiver(bandCount, layer.channelCount));
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
    for (std::size_t i = 0; i < ranges.size(); ++i)
        header["layers"].push_back(
            describeLayer(transfer.bandCount, transfer.layers[i], ranges[i]));
    return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

AssetHeader parseHeader(const std::string& json) {
    const gltf::Json parsed = gltf::parseJson(json);
    const JsonCursor root(parsed, kAssetExtension);
    const bool isNewer = parseVersion(root.at("version"));
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
        parseLayer(layers[i], isNewer, header);
    checkLayers(layers, header);
    const JsonCursor checksums = root.at("checksums");
    for (std::size_t i = 0; i < checksums.size(); ++i)
        header.checksums.push_back(checksums[i].toString());
    return header;
}

}  // namespace prt

#include "prt/asset/table_header.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "prt/base/error.h"

namespace prt {
namespace {

using gltf::JsonCursor;

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

}  // namespace

AccessorInfo storedInfo(TransferEncoding encoding, std::size_t count, int componentCount) {
    AccessorInfo info{count, componentCount};
    if (encoding == TransferEncoding::unorm16) info.type = ComponentType::uint16;
    if (encoding == TransferEncoding::unorm8) info.type = ComponentType::uint8;
    info.normalized = encoding != TransferEncoding::float32;
    return info;
}

ColumnRanges rangesOf(const StoredTable& table) {
    if (table.encoding == TransferEncoding::float32) return {};
    if (!table.scale.empty()) return {table.scale, table.bias};
    const std::size_t columnCount = table.numbers.columnCount();
    return {std::vector<float>(columnCount, 1.0f), std::vector<float>(columnCount, 0.0f)};
}

void describeRanges(const StoredTable& table, nlohmann::ordered_json& object) {
    if (table.encoding == TransferEncoding::float32) return;
    const ColumnRanges ranges = rangesOf(table);
    object["scale"] = ranges.scale;
    object["bias"] = ranges.bias;
}

void parseRanges(const JsonCursor& object, std::size_t columnCount, StoredTable& table) {
    if (table.encoding == TransferEncoding::float32) return;
    table.scale = parseCoefficients(object.at("scale"), columnCount);
    table.bias = parseCoefficients(object.at("bias"), columnCount);
    for (std::size_t i = 0; i < columnCount; ++i)
        if (table.scale[i] < 0.0f) object.at("scale")[i].reject("is negative");
}

std::string rangeBytes(const StoredTable& table) {
    const ColumnRanges ranges = rangesOf(table);
    std::string bytes;
    for (const std::vector<float>* numbers : {&ranges.scale, &ranges.bias})
        bytes.append(reinterpret_cast<const char*>(numbers->data()),
                     numbers->size() * sizeof(float));
    return bytes;
}

void checkCoefficients(const StoredTable& table) {
    if (table.encoding != TransferEncoding::float32) return;
    for (std::size_t part = 0; part < table.numbers.panelCount(); ++part)
        for (const float value : floatPanel(table.numbers, part))
            if (!(std::abs(value) <= kMaxCoefficient))
                throw Error(ErrorCode::malformed,
                            "holds a coefficient beyond ±" +
                                std::to_string(static_cast<int>(kMaxCoefficient)));
}

}  // namespace prt

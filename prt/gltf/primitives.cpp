#include "prt/gltf/primitives.h"

#include <array>
#include <limits>
#include <numeric>

#include "prt/base/error.h"

namespace prt::gltf {
namespace {

bool isSigned(ComponentType type) {
    return type == ComponentType::int8 || type == ComponentType::int16;
}

bool isUnsigned(ComponentType type) {
    return type == ComponentType::uint8 || type == ComponentType::uint16;
}

/// Whether an attribute may have a format [glTF 2.0, 3.7.2.1; KHR_mesh_quantization].
bool isFormatAllowed(std::string_view semantic, const AccessorInfo& info, bool isQuantized) {
    const bool isFloat = info.type == ComponentType::float32;
    if (info.type == ComponentType::uint32) return false;  // for indices alone
    const bool isShort = isSigned(info.type) || isUnsigned(info.type);
    const bool isUnsignedFraction = isUnsigned(info.type) && info.normalized;
    if (semantic == "POSITION")
        return info.componentCount == 3 && (isFloat || (isQuantized && isShort));
    if (semantic == "NORMAL")
        return info.componentCount == 3 &&
               (isFloat || (isQuantized && isSigned(info.type) && info.normalized));
    if (semantic.starts_with("TEXCOORD_"))
        return info.componentCount == 2 &&
               (isFloat || isUnsignedFraction || (isQuantized && isShort));
    if (semantic.starts_with("COLOR_"))
        return (info.componentCount == 3 || info.componentCount == 4) &&
               (isFloat || isUnsignedFraction);
    return true;
}

void checkAttribute(const JsonCursor& value, std::string_view semantic, const Accessor& accessor,
                    bool isQuantized) {
    if (!isFormatAllowed(semantic, accessor.info, isQuantized))
        value.reject("refers to " + accessor.place + ", whose format it cannot have");
    if (!accessor.isAligned)
        value.reject("refers to " + accessor.place + ", which is not aligned to four bytes");
}

void parseAttributes(const JsonCursor& value, const std::vector<Accessor>& accessors,
                     bool isQuantized, Primitive& primitive) {
    std::optional<std::size_t> count;
    for (const auto& [semantic, attribute] : value.members()) {
        const std::size_t index = attribute.toIndex(accessors.size(), "accessors");
        const Accessor& accessor = accessors[index];
        checkAttribute(attribute, semantic, accessor, isQuantized);
        if (count && *count != accessor.info.count)
            value.reject("have different numbers of elements");
        count = accessor.info.count;
        primitive.attributes.emplace(semantic, index);
    }
}

void checkIndices(const JsonCursor& primitive, const Accessor& accessor) {
    const AccessorInfo& info = accessor.info;
    const bool isIndex = isUnsigned(info.type) || info.type == ComponentType::uint32;
    if (!isIndex || info.componentCount != 1 || info.normalized || !accessor.isPacked)
        primitive.at("indices").reject("refers to " + accessor.place + ", which holds no indices");
}

Topology parseTopology(const JsonCursor& primitive) {
    constexpr std::size_t kTopologyCount = 7;
    const std::size_t mode =
        primitive.countOr("mode", static_cast<std::size_t>(Topology::triangles));
    if (mode >= kTopologyCount) primitive.at("mode").reject("is not a primitive mode");
    return static_cast<Topology>(mode);
}

Primitive parsePrimitive(const JsonCursor& value, const std::vector<Accessor>& accessors,
                         std::size_t materialCount, bool isQuantized) {
    Primitive primitive;
    primitive.place = value.place();
    primitive.topology = parseTopology(value);
    parseAttributes(value.at("attributes"), accessors, isQuantized, primitive);
    primitive.indices = value.findIndex("indices", accessors.size(), "accessors");
    if (primitive.indices) checkIndices(value, accessors[*primitive.indices]);
    primitive.material = value.findIndex("material", materialCount, "materials");
    primitive.hasTargets = countElements(value, "targets") > 0;
    return primitive;
}

/// The largest value of an index type, which would end a strip and start another.
std::uint32_t restartIndex(ComponentType type) {
    switch (type) {
        case ComponentType::uint8:
            return std::numeric_limits<std::uint8_t>::max();
        case ComponentType::uint16:
            return std::numeric_limits<std::uint16_t>::max();
        default:
            return std::numeric_limits<std::uint32_t>::max();
    }
}

/// The vertices in the order in which they are drawn.
std::vector<std::uint32_t> readCorners(const Primitive& primitive,
                                       const std::vector<Accessor>& accessors) {
    const std::size_t vertexCount = countVertices(primitive, accessors);
    std::vector<std::uint32_t> corners;
    if (!primitive.indices) {
        corners.resize(vertexCount);
        std::iota(corners.begin(), corners.end(), 0u);
        return corners;
    }
    const Accessor& accessor = accessors[*primitive.indices];
    corners = readIndices(accessor);
    const std::uint32_t restart = restartIndex(accessor.info.type);
    for (const std::uint32_t corner : corners)
        if (corner >= vertexCount || corner == restart)
            throw Error(ErrorCode::malformed, primitive.place + ".indices holds " +
                                                  std::to_string(corner) + ", but there are " +
                                                  std::to_string(vertexCount) + " vertices");
    return corners;
}

}  // namespace

std::optional<std::size_t> Primitive::findAttribute(std::string_view semantic) const {
    const auto attribute = attributes.find(semantic);
    if (attribute == attributes.end()) return std::nullopt;
    return attribute->second;
}

std::vector<MeshRecord> parseMeshes(const JsonCursor& root, const std::vector<Accessor>& accessors,
                                    bool isQuantized) {
    const std::size_t materialCount = countElements(root, "materials");
    return parseEach(root, "meshes", [&](const JsonCursor& value) {
        if (countElements(value, "primitives") == 0) value.reject("has no primitives");
        return MeshRecord{value.stringOr("name", ""),
                          parseEach(value, "primitives", [&](const JsonCursor& item) {
                              return parsePrimitive(item, accessors, materialCount, isQuantized);
                          })};
    });
}

std::size_t countVertices(const Primitive& primitive, const std::vector<Accessor>& accessors) {
    const std::optional<std::size_t> position = primitive.findAttribute("POSITION");
    return position ? accessors[*position].info.count : 0;
}

std::size_t countCorners(const Primitive& primitive, const std::vector<Accessor>& accessors) {
    return primitive.indices ? accessors[*primitive.indices].info.count
                             : countVertices(primitive, accessors);
}

std::size_t countTriangles(const Primitive& primitive, const std::vector<Accessor>& accessors) {
    const std::size_t cornerCount = countCorners(primitive, accessors);
    const bool isStripOrFan = primitive.topology == Topology::triangleStrip ||
                              primitive.topology == Topology::triangleFan;
    if (primitive.topology == Topology::triangles) return cornerCount / 3;
    return isStripOrFan && cornerCount >= 3 ? cornerCount - 2 : 0;
}

std::vector<std::uint32_t> readTriangles(const Primitive& primitive,
                                         const std::vector<Accessor>& accessors) {
    std::vector<std::uint32_t> corners = readCorners(primitive, accessors);
    const std::size_t triangleCount = countTriangles(primitive, accessors);
    if (primitive.topology == Topology::triangles) {
        corners.resize(triangleCount * 3);
        return corners;
    }
    // Every other triangle of a strip would turn the wrong way; a fan's
    // triangles end at its first vertex.
    std::vector<std::uint32_t> triangles;
    triangles.reserve(triangleCount * 3);
    for (std::size_t i = 0; i < triangleCount; ++i) {
        const std::array<std::size_t, 3> strip = {i, i + 1 + i % 2, i + 2 - i % 2};
        const std::array<std::size_t, 3> fan = {i + 1, i + 2, 0};
        for (const std::size_t k : primitive.topology == Topology::triangleStrip ? strip : fan)
            triangles.push_back(corners[k]);
    }
    return triangles;
}

}  // namespace prt::gltf

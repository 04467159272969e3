#include "prt/gltf/accessor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "prt/base/assert.h"
#include "prt/base/error.h"

namespace prt::gltf {
namespace {

constexpr std::size_t kMaxComponentCount = 16;
constexpr std::size_t kMaxElementBytes = kMaxComponentCount * sizeof(float);

ComponentType parseComponentType(const JsonCursor& value) {
    switch (value.toCount()) {
        case 5120:
            return ComponentType::int8;
        case 5121:
            return ComponentType::uint8;
        case 5122:
            return ComponentType::int16;
        case 5123:
            return ComponentType::uint16;
        case 5125:
            return ComponentType::uint32;
        case 5126:
            return ComponentType::float32;
        default:
            value.reject("is not a component type");
    }
}

struct Shape {
    const char* name;
    int columnCount;
    int rowCount;
};

/// No components for a type that a later version may define.
Shape parseShape(const JsonCursor& value) {
    static constexpr std::array<Shape, 7> kShapes = {{{"SCALAR", 1, 1},
                                                      {"VEC2", 1, 2},
                                                      {"VEC3", 1, 3},
                                                      {"VEC4", 1, 4},
                                                      {"MAT2", 2, 2},
                                                      {"MAT3", 3, 3},
                                                      {"MAT4", 4, 4}}};
    const std::string& name = value.toString();
    for (const Shape& shape : kShapes)
        if (name == shape.name) return shape;
    return {"", 0, 0};
}

/// How many elements lie in memory, and how.
struct Extent {
    std::size_t count;
    std::size_t byteStride;
    std::size_t lastElementBytes;
};

/// The part of a view from an offset on, once it is known to hold the elements.
std::span<const std::byte> sliceView(const JsonCursor& place, const BufferView& view,
                                     std::size_t byteOffset, const Extent& extent) {
    const std::size_t viewBytes = view.byteLength;
    const bool fits =
        byteOffset <= viewBytes && extent.lastElementBytes <= viewBytes - byteOffset &&
        extent.count - 1 <= (viewBytes - byteOffset - extent.lastElementBytes) / extent.byteStride;
    if (!fits) place.reject("ends beyond its buffer view");
    return view.bytes.empty() ? view.bytes : view.bytes.subspan(byteOffset);
}

void checkAlignment(const JsonCursor& place, const BufferView& view, std::size_t byteOffset,
                    std::size_t alignment) {
    if (byteOffset % alignment != 0 || (view.byteOffset + byteOffset) % alignment != 0)
        place.reject("is not aligned to its component type");
}

/// One of the two packed arrays of a sparse accessor.
std::span<const std::byte> sliceSparseArray(const JsonCursor& array,
                                            const std::vector<BufferView>& views,
                                            const Extent& extent, std::size_t alignment) {
    const BufferView& view = views[array.at("bufferView").toIndex(views.size(), "buffer views")];
    const std::size_t byteOffset = array.countOr("byteOffset", 0);
    if (view.byteStride != 0) array.reject("must not have a buffer view with a stride");
    checkAlignment(array, view, byteOffset, alignment);
    return sliceView(array, view, byteOffset, extent);
}

SparseElements parseSparse(const JsonCursor& sparse, const Accessor& accessor,
                           const std::vector<BufferView>& views) {
    SparseElements elements;
    elements.count = sparse.at("count").toCount();
    if (elements.count == 0 || elements.count > accessor.info.count)
        sparse.reject("must replace from one to all elements");

    const JsonCursor indices = sparse.at("indices");
    elements.indexType = parseComponentType(indices.at("componentType"));
    if (elements.indexType != ComponentType::uint8 && elements.indexType != ComponentType::uint16 &&
        elements.indexType != ComponentType::uint32)
        indices.reject("must be unsigned integers");
    const std::size_t indexBytes = componentBytes(elements.indexType);
    elements.indices =
        sliceSparseArray(indices, views, {elements.count, indexBytes, indexBytes}, indexBytes);
    elements.values =
        sliceSparseArray(sparse.at("values"), views,
                         {elements.count, accessor.elementBytes, accessor.lastElementBytes},
                         componentBytes(accessor.info.type));
    return elements;
}

void checkCount(const JsonCursor& accessor, std::size_t count, std::size_t limit,
                const char* hint) {
    if (count > limit)
        throw Error(ErrorCode::limitExceeded,
                    accessor.place() + " has " + std::to_string(count) +
                        " elements, more than the limit of " + std::to_string(limit),
                    {}, hint);
}

void locateElements(const JsonCursor& value, const std::vector<BufferView>& views,
                    const GltfLimits& limits, Accessor& accessor) {
    const auto viewIndex = value.findIndex("bufferView", views.size(), "buffer views");
    const std::size_t byteOffset = value.countOr("byteOffset", 0);
    accessor.byteStride = accessor.elementBytes;
    if (!viewIndex) {
        if (value.find("byteOffset")) value.reject("has an offset but no buffer view");
        checkCount(value, accessor.info.count, limits.maxZeroElementCount,
                   "store them in a buffer view");
        return;
    }
    const BufferView& view = views[*viewIndex];
    if (view.byteStride != 0) accessor.byteStride = view.byteStride;
    if (accessor.byteStride < accessor.elementBytes)
        value.reject("has elements larger than its buffer view's stride");
    checkAlignment(value, view, byteOffset, componentBytes(accessor.info.type));
    accessor.bytes =
        sliceView(value, view, byteOffset,
                  {accessor.info.count, accessor.byteStride, accessor.lastElementBytes});
    accessor.isPlaceholder = view.bytes.empty();
    accessor.isPacked = view.byteStride == 0;
    accessor.isAligned =
        byteOffset % kAlignmentBytes == 0 && accessor.byteStride % kAlignmentBytes == 0;
}

Accessor parseAccessor(const JsonCursor& value, const std::vector<BufferView>& views,
                       const GltfLimits& limits) {
    Accessor accessor;
    accessor.place = value.place();
    AccessorInfo& info = accessor.info;
    info.type = parseComponentType(value.at("componentType"));
    info.normalized = value.boolOr("normalized", false);
    if (info.normalized &&
        (info.type == ComponentType::float32 || info.type == ComponentType::uint32))
        value.reject("is normalized, but its component type cannot be");

    info.count = value.at("count").toCount();
    if (info.count == 0) value.reject("has no elements");
    checkCount(value, info.count, std::max(limits.maxVertexCount, limits.maxIndexCount),
               "allow more with --max-vertices");

    const Shape shape = parseShape(value.at("type"));
    info.componentCount = shape.columnCount * shape.rowCount;
    if (info.componentCount == 0) return accessor;
    accessor.rowCount = shape.rowCount;
    const std::size_t columnBytes =
        static_cast<std::size_t>(shape.rowCount) * componentBytes(info.type);
    accessor.columnBytes = shape.columnCount == 1 ? columnBytes : alignUp(columnBytes);
    accessor.elementBytes = static_cast<std::size_t>(shape.columnCount) * accessor.columnBytes;
    accessor.lastElementBytes = accessor.elementBytes - (accessor.columnBytes - columnBytes);
    locateElements(value, views, limits, accessor);
    if (const auto sparse = value.find("sparse")) {
        accessor.sparse = parseSparse(*sparse, accessor, views);
        accessor.isPlaceholder |=
            accessor.sparse->indices.empty() || accessor.sparse->values.empty();
    }
    return accessor;
}

std::uint32_t readIndex(const std::byte* bytes, ComponentType type) {
    const auto load = [bytes](auto value) {
        std::memcpy(&value, bytes, sizeof(value));
        return static_cast<std::uint32_t>(value);
    };
    switch (type) {
        case ComponentType::uint8:
            return load(std::uint8_t{});
        case ComponentType::uint16:
            return load(std::uint16_t{});
        default:
            return load(std::uint32_t{});
    }
}

/// Calls `visit(i, bytes)` for each element i, and once more for those
/// that a sparse accessor replaces.
template <class Visit>
void visitElements(const Accessor& accessor, Visit visit) {
    static constexpr std::array<std::byte, kMaxElementBytes> kZeros{};
    if (accessor.isPlaceholder)
        throw Error(ErrorCode::malformed, accessor.place + " lies in a buffer without bytes", {},
                    "the buffer has neither a URI nor a binary chunk");
    if (accessor.info.componentCount == 0) return;
    const bool isZero = accessor.bytes.empty();
    for (std::size_t i = 0; i < accessor.info.count; ++i)
        visit(i, isZero ? kZeros.data() : accessor.bytes.data() + i * accessor.byteStride);

    if (!accessor.sparse) return;
    const SparseElements& sparse = *accessor.sparse;
    const std::size_t indexBytes = componentBytes(sparse.indexType);
    std::size_t next = 0;
    for (std::size_t k = 0; k < sparse.count; ++k) {
        const std::size_t i = readIndex(sparse.indices.data() + k * indexBytes, sparse.indexType);
        if (i < next || i >= accessor.info.count)
            throw Error(ErrorCode::malformed,
                        accessor.place + ".sparse has indices that do not ascend to its count");
        next = i + 1;
        visit(i, sparse.values.data() + k * accessor.elementBytes);
    }
}

/// Calls `visit(k, bytes)` for each component k of the accessor, counted over all elements.
template <class Visit>
void visitComponents(const Accessor& accessor, Visit visit) {
    const std::size_t componentCount = static_cast<std::size_t>(accessor.info.componentCount);
    const std::size_t rowCount = static_cast<std::size_t>(accessor.rowCount);
    std::array<std::size_t, kMaxComponentCount> offsets{};
    for (std::size_t c = 0; c < componentCount; ++c)
        offsets[c] =
            c / rowCount * accessor.columnBytes + c % rowCount * componentBytes(accessor.info.type);
    visitElements(accessor, [&](std::size_t i, const std::byte* element) {
        for (std::size_t c = 0; c < componentCount; ++c)
            visit(i * componentCount + c, element + offsets[c]);
    });
}

template <class Stored>
void convertNumbers(const Accessor& accessor, std::span<float> numbers) {
    // A normalised integer is c / max, and the most negative one −1 as well [glTF 2.0, 3.11].
    const bool isFraction = accessor.info.normalized;
    visitComponents(accessor, [&](std::size_t k, const std::byte* bytes) {
        Stored stored;
        std::memcpy(&stored, bytes, sizeof(stored));
        const float number = static_cast<float>(stored);
        constexpr float kMax = static_cast<float>(std::numeric_limits<Stored>::max());
        numbers[k] = isFraction ? std::max(number / kMax, -1.0f) : number;
    });
}

}  // namespace

std::size_t componentBytes(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        default:
            return 4;
    }
}

std::vector<Accessor> parseAccessors(const JsonCursor& root, const std::vector<BufferView>& views,
                                     const GltfLimits& limits) {
    return parseEach(root, "accessors",
                     [&](const JsonCursor& value) { return parseAccessor(value, views, limits); });
}

std::vector<std::byte> readComponents(const Accessor& accessor) {
    const std::size_t bytesPerComponent = componentBytes(accessor.info.type);
    std::vector<std::byte> packed(accessor.info.count *
                                  static_cast<std::size_t>(accessor.info.componentCount) *
                                  bytesPerComponent);
    visitComponents(accessor, [&](std::size_t k, const std::byte* bytes) {
        std::memcpy(packed.data() + k * bytesPerComponent, bytes, bytesPerComponent);
    });
    return packed;
}

void readNumbers(const Accessor& accessor, std::span<float> numbers) {
    PRT_ASSERT(numbers.size() ==
                   accessor.info.count * static_cast<std::size_t>(accessor.info.componentCount),
               "there is room for each component");
    switch (accessor.info.type) {
        case ComponentType::int8:
            return convertNumbers<std::int8_t>(accessor, numbers);
        case ComponentType::uint8:
            return convertNumbers<std::uint8_t>(accessor, numbers);
        case ComponentType::int16:
            return convertNumbers<std::int16_t>(accessor, numbers);
        case ComponentType::uint16:
            return convertNumbers<std::uint16_t>(accessor, numbers);
        case ComponentType::uint32:
            return convertNumbers<std::uint32_t>(accessor, numbers);
        case ComponentType::float32:
            return convertNumbers<float>(accessor, numbers);
    }
}

void checkFinite(std::span<const float> numbers, const std::string& place) {
    if (!std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); }))
        throw Error(ErrorCode::malformed, place + " holds a number that is not finite");
}

std::vector<std::uint32_t> readIndices(const Accessor& accessor) {
    std::vector<std::uint32_t> indices(accessor.info.count);
    visitElements(accessor, [&](std::size_t i, const std::byte* bytes) {
        indices[i] = readIndex(bytes, accessor.info.type);
    });
    return indices;
}

}  // namespace prt::gltf

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prt/gltf/buffers.h"
#include "prt/gltf/gltf_document.h"
#include "prt/gltf/json_cursor.h"

namespace prt::gltf {

/// Of vertex attributes, of columns of matrices, and of the chunks of a binary glTF.
inline constexpr std::size_t kAlignmentBytes = 4;

/// The next multiple of it.
constexpr std::size_t alignUp(std::size_t byteCount) {
    return (byteCount + kAlignmentBytes - 1) / kAlignmentBytes * kAlignmentBytes;
}

/// Elements of an accessor that replace those of its buffer view.
struct SparseElements {
    std::size_t count = 0;
    ComponentType indexType = ComponentType::uint32;
    std::span<const std::byte> indices;
    std::span<const std::byte> values;
};

/// A typed view of a buffer, which is known to have room for all of its elements. Of a type that
/// glTF 2.0 does not know it has no components.
struct Accessor {
    std::string place;
    AccessorInfo info;
    int rowCount = 1;             ///< of a matrix's column; all components of a vector
    std::size_t columnBytes = 0;  ///< with a matrix's padding
    std::size_t elementBytes = 0;
    std::size_t lastElementBytes = 0;  ///< without the padding of its last column
    std::size_t byteStride = 0;
    std::span<const std::byte> bytes;  ///< from the first element on; empty if all are 0
    std::optional<SparseElements> sparse;
    bool isPlaceholder = false;  ///< some of its bytes are in no file: reading it is an error
    bool isAligned = true;       ///< to four bytes, each element, as vertex attributes must be
    bool isPacked = true;        ///< its view has no stride, as that of indices must not
};

std::vector<Accessor> parseAccessors(const JsonCursor& root, const std::vector<BufferView>& views,
                                     const GltfLimits& limits);

std::size_t componentBytes(ComponentType type);

/// Components as stored, without padding.
std::vector<std::byte> readComponents(const Accessor& accessor);

/// Components as numbers, normalised integers as their fractions.
///
/// @param numbers  count × componentCount of them
void readNumbers(const Accessor& accessor, std::span<float> numbers);

/// The same as vectors of as many components.
template <class Vector>
std::vector<Vector> readVectors(const Accessor& accessor) {
    std::vector<Vector> vectors(accessor.info.count);
    readNumbers(accessor, {&vectors.data()->x, vectors.size() * Vector::dimensions()});
    return vectors;
}

/// @throws Error  malformed, naming the place, if a number is not finite
void checkFinite(std::span<const float> numbers, const std::string& place);

/// The elements of an index accessor: unsigned integers, one component.
std::vector<std::uint32_t> readIndices(const Accessor& accessor);

}  // namespace prt::gltf

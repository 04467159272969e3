#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "prt/gltf/gltf_document.h"
#include "prt/gltf/json_cursor.h"
#include "prt/transfer/stored_table.h"

namespace prt {

/// No number that scale, bias or a float stands for is larger: it is beyond any coefficient that
/// reflectances up to 1 can give, 1.23 or of matrices 2.18 (docs/format.md), and far from where
/// sums overflow.
inline constexpr float kMaxCoefficient = 100.0f;

/// The form of an accessor whose components are stored so.
AccessorInfo storedInfo(TransferEncoding encoding, std::size_t count, int componentCount);

/// What a file says of a table's columns: none for floats; else one a column, 1 and 0 where the
/// table has none.
struct ColumnRanges {
    std::vector<float> scale{};
    std::vector<float> bias{};
};
ColumnRanges rangesOf(const StoredTable& table);

/// Adds the members "scale" and "bias", if there are any.
void describeRanges(const StoredTable& table, nlohmann::ordered_json& object);

/// Reads them into the table, whose encoding is known.
void parseRanges(const gltf::JsonCursor& object, std::size_t columnCount, StoredTable& table);

/// Both as little-endian floats, for checksums.
std::string rangeBytes(const StoredTable& table);

/// Demands that floats are finite and of a size that transfer can have; integers are so by their
/// ranges.
void checkCoefficients(const StoredTable& table);

}  // namespace prt

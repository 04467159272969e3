#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// Everything by which vertices are told apart, as bits; unused words are 0.
using VertexKey = std::array<std::uint32_t, 7>;

/// For hash tables of keys.
struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const;
};

/// Writes the bits of a vector to the key's words first, first + 1, first + 2, with −0 as 0.
void putVector(VertexKey& key, std::size_t first, const Vec3f& vector);

/// Numbers distinct keys in the order in which they first come: a hash table of group numbers.
class VertexGrouping {
  public:
    /// @param vertexCount  no more keys than this will come
    explicit VertexGrouping(std::size_t vertexCount);

    /// The number of the key's group, new if the key is.
    std::uint32_t groupOf(const VertexKey& key);

    std::size_t groupCount() const { return keys_.size(); }

  private:
    std::vector<VertexKey> keys_;        // one a group
    std::vector<std::uint32_t> groups_;  // slots of the table, a power of two
};

}  // namespace prt

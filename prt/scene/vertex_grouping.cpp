#include "prt/scene/vertex_grouping.h"

#include <bit>

#include "prt/base/assert.h"
#include "prt/base/random.h"

namespace prt {
namespace {

constexpr std::uint32_t kEmptySlot = 0xffffffffu;

}  // namespace

std::size_t VertexKeyHash::operator()(const VertexKey& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : key)
        hash = mixBits(hash ^ word);
    return static_cast<std::size_t>(hash);
}

void putVector(VertexKey& key, std::size_t first, const Vec3f& vector) {
    // Adding +0 turns -0 into +0 and changes nothing else.
    key[first] = std::bit_cast<std::uint32_t>(vector.x + 0.0f);
    key[first + 1] = std::bit_cast<std::uint32_t>(vector.y + 0.0f);
    key[first + 2] = std::bit_cast<std::uint32_t>(vector.z + 0.0f);
}

VertexGrouping::VertexGrouping(std::size_t vertexCount)
    : groups_(std::bit_ceil(2 * vertexCount + 1), kEmptySlot) {
    PRT_ASSERT(vertexCount < kEmptySlot, "vertices are numbered with 32 bits");
}

std::uint32_t VertexGrouping::groupOf(const VertexKey& key) {
    const std::size_t mask = groups_.size() - 1;
    std::size_t slot = VertexKeyHash()(key) & mask;
    while (groups_[slot] != kEmptySlot && keys_[groups_[slot]] != key)
        slot = (slot + 1) & mask;
    if (groups_[slot] == kEmptySlot) {
        groups_[slot] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
    }
    return groups_[slot];
}

}  // namespace prt

#pragma once

#include <cstddef>
#include <memory>

namespace prt {

struct FreeAlignedBytes {
    void operator()(std::byte* bytes) const;
};

/// Memory that begins where the widest vectors of numbers may.
using AlignedBytes = std::unique_ptr<std::byte[], FreeAlignedBytes>;

/// @throws Error  outOfMemory
AlignedBytes allocateAlignedBytes(std::size_t count);

}  // namespace prt

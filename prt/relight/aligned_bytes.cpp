#include "prt/relight/aligned_bytes.h"

#include <hwy/aligned_allocator.h>

#include "prt/base/error.h"

namespace prt {

void FreeAlignedBytes::operator()(std::byte* bytes) const {
    hwy::FreeAlignedBytes(bytes, nullptr, nullptr);
}

AlignedBytes allocateAlignedBytes(std::size_t count) {
    void* const bytes = hwy::AllocateAlignedBytes(count, nullptr, nullptr);
    if (!bytes) throw Error(ErrorCode::outOfMemory, "relighting does not fit in memory");
    return AlignedBytes(static_cast<std::byte*>(bytes));
}

}  // namespace prt

#include "prt/transport/hit_matrix.h"

#include <algorithm>
#include <utility>

#include "prt/base/error.h"

namespace prt {
namespace {

std::size_t bytesOf(const HitSlab& slab) {
    return slab.entries.size() * sizeof(BounceEntry);
}

}  // namespace

HitMatrix::HitMatrix(std::size_t memoryBytes, std::filesystem::path scratchFolder)
    : memoryBytes_(memoryBytes), scratchFolder_(std::move(scratchFolder)) {}

void HitMatrix::addSlab(HitSlab slab, EntryLoader loader) {
    // Rows were appended one by one, which leaves up to half of the room empty.
    slab.entries.shrink_to_fit();
    const std::lock_guard lock(adding_);
    const std::size_t bytes = bytesOf(slab);
    const bool fits = entryBytes_ + bytes <= memoryBytes_;
    entryBytes_ += bytes;
    rowCount_ += slab.receivers.size();
    if (fits) {
        loader = {};
    } else {
        if (!loader) loader = spillEntries(slab.entries);
        std::vector<BounceEntry>().swap(slab.entries);
    }
    slabs_.push_back({std::move(slab), std::move(loader)});
}

EntryLoader HitMatrix::spillEntries(std::span<const BounceEntry> entries) {
    if (!spill_) spill_ = std::make_unique<ScratchFile>(scratchFolder_);
    const std::uint64_t offset = spilledBytes_;
    spill_->write(offset, std::as_bytes(entries));
    spilledBytes_ += entries.size_bytes();
    return [this, offset, count = entries.size()](std::span<const std::uint32_t>) {
        std::vector<BounceEntry> loaded(count);
        spill_->read(offset, std::as_writable_bytes(std::span(loaded)));
        return loaded;
    };
}

void HitMatrix::sortSlabs() {
    std::sort(slabs_.begin(), slabs_.end(), [](const StoredSlab& a, const StoredSlab& b) {
        return a.slab.receivers < b.slab.receivers;
    });
}

void HitMatrix::visitSlab(std::size_t index,
                          const std::function<void(const HitSlab&)>& visit) const {
    const StoredSlab& stored = slabs_[index];
    if (!stored.loader) {
        visit(stored.slab);
        return;
    }
    const HitSlab loaded{stored.slab.receivers, stored.slab.rowEnds,
                         stored.loader(stored.slab.receivers)};
    if (loaded.entries.size() != (loaded.rowEnds.empty() ? 0 : loaded.rowEnds.back()))
        throw Error(ErrorCode::unreadable, "the hits of some rays are no longer what they were");
    visit(loaded);
}

}  // namespace prt

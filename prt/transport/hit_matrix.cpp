#include "prt/transport/hit_matrix.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "prt/base/error.h"

namespace prt {
namespace {

std::size_t bytesOf(const HitSlab& slab) {
    return slab.entries.size() * sizeof(BounceEntry);
}

}  // namespace

/// A file that has no name, so that it vanishes with the process however that ends.
class HitMatrix::SpillFile {
  public:
    explicit SpillFile(const std::filesystem::path& folder) : folder_(folder) {
        std::string name = (folder / "openprt-hits-XXXXXX").string();
        descriptor_ = ::mkstemp(name.data());
        if (descriptor_ < 0) fail(ErrorCode::writeFailed);
        ::unlink(name.c_str());
    }
    ~SpillFile() { ::close(descriptor_); }
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    /// @return  where the bytes begin in the file
    std::uint64_t append(std::span<const std::byte> bytes) {
        const std::uint64_t begin = end_;
        while (!bytes.empty()) {
            const ssize_t written =
                ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(end_));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(ErrorCode::writeFailed);
            end_ += static_cast<std::uint64_t>(written);
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        return begin;
    }

    void read(std::uint64_t offset, std::span<std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t count =
                ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) fail(ErrorCode::unreadable);
            offset += static_cast<std::uint64_t>(count);
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        }
    }

  private:
    [[noreturn]] void fail(ErrorCode code) const {
        throw Error(code,
                    std::string("hits that do not fit in memory cannot be kept here: ") +
                        std::strerror(errno),
                    folder_.string(), "allow more memory, or name another scratch folder");
    }

    std::filesystem::path folder_;
    int descriptor_ = -1;
    std::uint64_t end_ = 0;
};

HitMatrix::HitMatrix(std::size_t memoryBytes, std::filesystem::path scratchFolder)
    : memoryBytes_(memoryBytes),
      scratchFolder_(scratchFolder.empty() ? std::filesystem::temp_directory_path()
                                           : std::move(scratchFolder)) {}

HitMatrix::~HitMatrix() = default;

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
    if (!spill_) spill_ = std::make_unique<SpillFile>(scratchFolder_);
    const std::uint64_t offset = spill_->append(std::as_bytes(entries));
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

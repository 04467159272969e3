#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "prt/base/scratch_file.h"
#include "prt/transport/gather_kernels.h"

namespace prt {

/// Some rows of the bounce matrix.
struct HitSlab {
    std::vector<std::uint32_t> receivers;  ///< whose rows these are
    std::vector<std::uint32_t> rowEnds;    ///< one a row: the end of its entries
    std::vector<BounceEntry> entries;

    std::span<const BounceEntry> row(std::size_t index) const {
        const std::size_t begin = index == 0 ? 0 : rowEnds[index - 1];
        return std::span(entries).subspan(begin, rowEnds[index] - begin);
    }
};

/// Brings back the entries of the slab of these receivers, always the same.
/// @throws Error  unreadable
using EntryLoader =
    std::function<std::vector<BounceEntry>(std::span<const std::uint32_t> receivers)>;

/// The sparse matrix of a bounce, receivers × receivers: slabs of rows in memory, and on disk when
/// they are more than the memory allowed.
class HitMatrix {
  public:
    /// @param memoryBytes    for entries; slabs beyond it go to a nameless file in scratchFolder
    /// @param scratchFolder  as of a ScratchFile
    HitMatrix(std::size_t memoryBytes, std::filesystem::path scratchFolder);

    /// Adds rows; may be called from many threads.
    ///
    /// @param loader  where the entries are kept elsewhere too, so that they are not written again
    /// @throws Error  writeFailed
    void addSlab(HitSlab slab, EntryLoader loader = {});

    /// Puts the slabs into the order of their first receivers, once all
    /// are added: threads add them in any.
    void sortSlabs();

    std::size_t slabCount() const { return slabs_.size(); }
    /// Whose rows a slab holds.
    std::span<const std::uint32_t> slabReceivers(std::size_t index) const {
        return slabs_[index].slab.receivers;
    }
    std::size_t rowCount() const { return rowCount_; }
    std::size_t entryBytes() const { return entryBytes_; }

    /// Calls `visit` with one slab; may be called from many threads once all are
    /// added. @throws Error  unreadable
    void visitSlab(std::size_t index, const std::function<void(const HitSlab&)>& visit) const;

  private:
    struct StoredSlab {
        HitSlab slab;  // its entries are empty while they are on disk
        EntryLoader loader;
    };

    EntryLoader spillEntries(std::span<const BounceEntry> entries);

    std::mutex adding_;
    std::size_t memoryBytes_;
    std::filesystem::path scratchFolder_;
    std::size_t rowCount_ = 0;
    std::size_t entryBytes_ = 0;
    std::vector<StoredSlab> slabs_;
    std::unique_ptr<ScratchFile> spill_;
    std::uint64_t spilledBytes_ = 0;
};

}  // namespace prt

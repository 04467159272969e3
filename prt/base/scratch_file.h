#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace prt {

/// A file for what does not fit in memory. It has no name, so that it vanishes with the process
/// however that ends. All methods may be called from many threads, for different bytes.
class ScratchFile {
  public:
    /// @param folder  empty: the system's folder for temporary files
    /// @throws Error  writeFailed, as write, with the system's reason and the folder
    explicit ScratchFile(std::filesystem::path folder);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    void write(std::uint64_t offset, std::span<const std::byte> bytes);

    /// @throws Error  unreadable
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

    /// Makes the file as long as this; what was never written is zero, and takes no room.
    void resize(std::uint64_t byteCount);

    /// For mapping.
    int descriptor() const { return descriptor_; }

  private:
    std::filesystem::path folder_;
    int descriptor_ = -1;
};

/// A scratch file's bytes where they can be read like an array: pages come into memory as they are
/// touched, and go again when they are released.
class ScratchView {
  public:
    /// @param byteCount  of the file, at least 1
    /// @throws Error     unreadable
    ScratchView(const ScratchFile& file, std::size_t byteCount);
    ~ScratchView();
    ScratchView(const ScratchView&) = delete;
    ScratchView& operator=(const ScratchView&) = delete;

    const std::byte* data() const { return data_; }

    /// Gives the memory of what was touched back to the system. The bytes stay.
    void release() const;

  private:
    std::byte* data_;
    std::size_t byteCount_;
};

}  // namespace prt

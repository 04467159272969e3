#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// Reads a whole file.
///
/// @param maxBytes  refuse anything larger, before allocating
/// @throws Error    notFound, unreadable, or limitExceeded, with `path` as its place
std::vector<std::byte> readFile(const std::filesystem::path& path, std::uintmax_t maxBytes);

/// A file in the making: its path holds either its old content or, once committed, all of the new.
/// The bytes go to a temporary name beside it, which is gone unless they are committed.
class AtomicFile {
  public:
    /// @throws Error  writeFailed, as all others, with the system's reason
    explicit AtomicFile(const std::filesystem::path& destination);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Adds bytes at the end.
    void append(std::span<const std::byte> bytes);

    /// Flushes the bytes to the disk, and then lets the name point at them [OSDI14].
    void commit();

  private:
    /// Some file systems lose what they have accepted.
    void requireSize() const;

    std::filesystem::path destination_;
    std::string temporary_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// Writes a whole file as an AtomicFile. @throws Error writeFailed; no temporary file is left
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same for text.
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

/// Checks that a file can be created at `path`, so that long work does not fail at its end.
///
/// @throws Error  writeFailed if the folder is missing or not writable; nothing is left behind
void checkWritable(const std::filesystem::path& path);

}  // namespace prt

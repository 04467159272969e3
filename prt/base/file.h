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

/// Writes a whole file so that `path` holds either its old content or all of the new: the bytes go
/// to a temporary name beside it, are flushed to the disk, and are then renamed.
///
/// @throws Error  writeFailed, with the system's reason; no temporary file is left
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same for text.
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

/// Checks that a file can be created at `path`, so that long work does not fail at its end.
///
/// @throws Error  writeFailed if the folder is missing or not writable; nothing is left behind
void checkWritable(const std::filesystem::path& path);

}  // namespace prt

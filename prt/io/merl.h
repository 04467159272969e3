#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "prt/brdf/measured_brdf.h"

namespace prt {

/// A measured BRDF from a file, and what had to be mended in it.
struct LoadedMerlBrdf {
    std::shared_ptr<const MeasuredBrdf> brdf;
    /// Values below 0, which became 0: the database marks what cannot be measured with them.
    std::size_t negativeCount = 0;
};

/// Reads a `.binary` of the MERL database [Matusik03], 34,992,012 bytes, little endian: the sizes
/// 90, 90 and 180 as 32-bit integers, then doubles [channel][θ_h][θ_d][φ_d] that are to be
/// multiplied by 1/1500, 1.15/1500 and 1.66/1500 for red, green and blue.
///
/// @throws Error  notFound, unreadable; malformed where the size is another, or a value is not
///                finite
LoadedMerlBrdf readMerlBrdf(const std::filesystem::path& path);

/// The same of a file in memory.
///
/// @param name  how to call it in an error
LoadedMerlBrdf parseMerlBrdf(std::span<const std::byte> file, const std::string& name);

/// Writes such a file, from which reading makes the same table.
///
/// @throws Error  writeFailed
void writeMerlBrdf(const std::filesystem::path& path, const MeasuredBrdf& brdf);

}  // namespace prt

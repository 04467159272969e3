#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace prt {

/// CRC-32 as PNG and zlib compute it [ISO 3309]: detects every change confined to 32 consecutive
/// bits. Not a defence against forgery.
std::uint32_t computeCrc32(std::span<const std::byte> bytes);

}  // namespace prt

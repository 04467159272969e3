#include "prt/base/checksum.h"

#include <zlib.h>

namespace prt {

std::uint32_t computeCrc32(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace prt

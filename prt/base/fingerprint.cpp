#include "prt/base/fingerprint.h"

#include <algorithm>
#include <cstring>

#include "prt/base/random.h"

namespace prt {

void Fingerprint::add(std::span<const std::byte> bytes) {
    // The length goes first, so that no two ways to cut a sequence agree.
    state_ = mixBits(state_ ^ bytes.size());
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t count = std::min(bytes.size(), sizeof(word));
        std::memcpy(&word, bytes.data(), count);
        state_ = mixBits(state_ ^ word);
        bytes = bytes.subspan(count);
    }
}

std::string Fingerprint::hex() const {
    std::string digits(16, '0');
    for (std::size_t i = 0; i < digits.size(); ++i)
        digits[i] = "0123456789abcdef"[state_ >> (60 - 4 * i) & 15];
    return digits;
}

}  // namespace prt

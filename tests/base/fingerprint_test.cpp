#include "prt/base/fingerprint.h"

#include <gtest/gtest.h>

#include <set>

namespace prt {
namespace {

std::uint64_t fingerprintOf(const std::vector<std::uint8_t>& bytes) {
    Fingerprint fingerprint;
    fingerprint.add(std::as_bytes(std::span(bytes)));
    return fingerprint.value();
}

TEST(Fingerprint, EveryBitAndTheLengthCount) {
    // The words end within, at and after the eighth byte.
    std::set<std::uint64_t> seen;
    std::size_t count = 0;
    for (std::size_t size = 0; size <= 24; ++size) {
        std::vector<std::uint8_t> bytes(size);
        seen.insert(fingerprintOf(bytes));
        ++count;
        for (std::size_t bit = 0; bit < 8 * size; ++bit, ++count) {
            bytes[bit / 8] = static_cast<std::uint8_t>(1u << bit % 8);
            seen.insert(fingerprintOf(bytes));
            bytes[bit / 8] = 0;
        }
    }
    EXPECT_EQ(seen.size(), count);
}

TEST(Fingerprint, TheOrderAndTheCutsCount) {
    const auto fingerprintLists = [](const std::vector<int>& first,
                                     const std::vector<int>& second) {
        Fingerprint fingerprint;
        fingerprint.add(first);
        fingerprint.add(second);
        return fingerprint.value();
    };
    const std::set<std::uint64_t> seen = {
        fingerprintLists({1, 2}, {3}), fingerprintLists({1}, {2, 3}),
        fingerprintLists({}, {1, 2, 3}), fingerprintLists({3}, {1, 2}),
        fingerprintLists({2, 1}, {3})};
    EXPECT_EQ(seen.size(), 5u);
}

TEST(Fingerprint, HexShowsAllDigits) {
    Fingerprint fingerprint;
    EXPECT_EQ(fingerprint.hex(), "0000000000000000");
    fingerprint.add(1);
    EXPECT_EQ(std::stoull(fingerprint.hex(), nullptr, 16), fingerprint.value());
    EXPECT_EQ(fingerprint.hex().size(), 16u);
}

}  // namespace
}  // namespace prt

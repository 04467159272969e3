#include "prt/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace prt {
namespace {

// Four standard errors: one seed in 16,000 would be unlucky, and ours are fixed.
constexpr double kSigmas = 4.0;

TEST(MixBits, IsSplitMix64) {
    // The first outputs of the reference generator started at 0 [Steele14].
    static_assert(mixBits(0) == 0xe220a8397b1dcdafu);
    static_assert(mixBits(0x9e3779b97f4a7c15u) == 0x6e789e6aa1b965f4u);
    static_assert(mixBits(2 * 0x9e3779b97f4a7c15u) == 0x06c45d188009454fu);
}

TEST(Conventions, C10_SameSeedAndStreamGiveTheSameBits) {
    RandomStream first(7, 123);
    RandomStream second(7, 123);

    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(first.nextBits(), second.nextBits());
}

TEST(RandomStream, NeighbouringSeedsAndStreamsShareNoNumbers) {
    // Of 40,000 numbers of 32 bits some 0.19 pairs coincide by chance; streams
    // that overlap would give thousands.
    constexpr std::size_t kAllowedCoincidences = 3;
    constexpr std::size_t kNumbersPerStream = 1000;
    std::set<std::uint32_t> seen;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        for (std::uint64_t stream = 0; stream < 10; ++stream) {
            RandomStream random(seed, stream);
            for (std::size_t i = 0; i < kNumbersPerStream; ++i)
                seen.insert(random.nextBits());
        }
    }

    EXPECT_GE(seen.size() + kAllowedCoincidences, 40 * kNumbersPerStream);
}

TEST(RandomStream, NeighbouringStreamsAreUncorrelated) {
    constexpr int kCount = 100'000;
    for (std::uint64_t stream = 0; stream < 8; ++stream) {
        RandomStream a(1, stream);
        RandomStream b(1, stream + 1);
        double productSum = 0.0;
        for (int i = 0; i < kCount; ++i)
            productSum += (a.nextUnitDouble() - 0.5) * (b.nextUnitDouble() - 0.5);
        const double correlation = 12.0 * productSum / kCount;

        EXPECT_NEAR(correlation, 0.0, kSigmas / std::sqrt(kCount));
    }
}

TEST(RandomStream, UnitNumbersHaveTheMeanAndVarianceOfTheUniformDistribution) {
    constexpr int kCount = 1'000'000;
    RandomStream floats(1, 0);
    RandomStream doubles(1, 1);
    double floatSum = 0.0;
    double doubleSum = 0.0;
    double squareSum = 0.0;
    for (int i = 0; i < kCount; ++i) {
        const float x = floats.nextUnitFloat();
        const double y = doubles.nextUnitDouble();
        ASSERT_TRUE(x >= 0.0f && x < 1.0f);
        ASSERT_TRUE(y >= 0.0 && y < 1.0);
        floatSum += x;
        doubleSum += y;
        squareSum += y * y;
    }

    const double meanError = std::sqrt(1.0 / 12.0 / kCount);
    const double squareError = std::sqrt(4.0 / 45.0 / kCount);
    EXPECT_NEAR(floatSum / kCount, 0.5, kSigmas * meanError);
    EXPECT_NEAR(doubleSum / kCount, 0.5, kSigmas * meanError);
    EXPECT_NEAR(squareSum / kCount, 1.0 / 3.0, kSigmas * squareError);
}

TEST(RandomStream, FirstNumbersOfTheStreamsFillTheInterval) {
    // Chi-square over 256 bins: mean 255, standard deviation √(2·255).
    constexpr int kBinCount = 256;
    constexpr int kStreamCount = 100'000;
    std::array<int, kBinCount> bins{};
    for (int stream = 0; stream < kStreamCount; ++stream) {
        RandomStream random(1, static_cast<std::uint64_t>(stream));
        ++bins[random.nextBits() >> 24];
    }
    constexpr double kExpected = static_cast<double>(kStreamCount) / kBinCount;
    double chiSquare = 0.0;
    for (const int count : bins)
        chiSquare += (count - kExpected) * (count - kExpected) / kExpected;

    EXPECT_NEAR(chiSquare, kBinCount - 1, kSigmas * std::sqrt(2.0 * (kBinCount - 1)));
}

}  // namespace
}  // namespace prt

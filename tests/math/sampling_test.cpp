#include "prt/math/sampling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "prt/base/random.h"

namespace prt {
namespace {

constexpr int kSampleCount = 1 << 16;
// Four standard errors of a mean of 65536 values of variance at most 1.
constexpr double kMeanTolerance = 4.0 / 256.0;

/// Whether 2^k points have one in each box of every subdivision into 2^a ×
/// 2^(k−a) boxes: a (0, k, 2)-net.
bool isNet(const std::vector<SquareBits>& points, int k) {
    for (int a = 0; a <= k; ++a) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
        for (const SquareBits& point : points)
            boxes.insert(
                {a == 0 ? 0u : point.x >> (32 - a), a == k ? 0u : point.y >> (32 - (k - a))});
        if (boxes.size() != points.size()) return false;
    }
    return true;
}

TEST(Sampling, SobolPointsAreANet) {
    constexpr int k = 8;
    std::vector<SquareBits> points;
    for (std::uint32_t i = 0; i < (1u << k); ++i)
        points.push_back(sobolPoint(i));
    EXPECT_TRUE(isNet(points, k));
}

TEST(Sampling, OwenScramblingKeepsTheNet) {
    constexpr int k = 8;
    for (std::uint32_t seed : {1u, 0x1234567u, 0xffffffffu}) {
        std::vector<SquareBits> points;
        for (std::uint32_t i = 0; i < (1u << k); ++i) {
            const SquareBits point = sobolPoint(i);
            points.push_back({owenScramble(point.x, seed), owenScramble(point.y, ~seed)});
        }
        EXPECT_TRUE(isNet(points, k)) << "seed " << seed;
    }
}

TEST(Sampling, OwenScramblingIsUniformOverSeeds) {
    RandomStream random(3, 0);
    double sum = 0.0;
    for (int i = 0; i < kSampleCount; ++i)
        sum += static_cast<double>(unitFloatFromBits(owenScramble(0x40000000u, random.nextBits())));
    EXPECT_NEAR(sum / kSampleCount, 0.5, kMeanTolerance);
}

TEST(Sampling, ReversingBitsTwiceGivesThemBack) {
    EXPECT_EQ(reverseBits(1u), 0x80000000u);
    EXPECT_EQ(reverseBits(reverseBits(0x12345678u)), 0x12345678u);
}

TEST(Sampling, UnitFloatsLieInsideTheInterval) {
    EXPECT_GT(unitFloatFromBits(0u), 0.0f);
    EXPECT_LT(unitFloatFromBits(0xffffffffu), 1.0f);
    EXPECT_NE(unitFloatFromBits(0x80000000u), 0.5f);
}

/// Counts of directions in cells of equal measure, which must all be
/// alike; chi-square against uniform.
double chiSquare(const std::vector<int>& counts, int total) {
    const double expected = static_cast<double>(total) / static_cast<double>(counts.size());
    double sum = 0.0;
    for (const int count : counts)
        sum += (count - expected) * (count - expected) / expected;
    return sum;
}

// 99.99 % quantile of chi-square with 255 degrees of freedom.
constexpr double kChiSquareLimit = 347.7;

std::size_t cellOf(double first, double phi) {
    const double turn = phi / (2.0 * std::numbers::pi) + 0.5;
    const auto row = static_cast<std::size_t>(std::min(15.0, first * 16.0));
    return row * 16 + static_cast<std::size_t>(std::min(15.0, turn * 16.0));
}

TEST(Sampling, CosineHemisphereFollowsItsDensity) {  // B2
    RandomStream random(5, 0);
    std::vector<int> counts(256);
    for (int i = 0; i < kSampleCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const Vec3f direction = sampleCosineHemisphere(u, unitFloatFromBits(random.nextBits()));
        ASSERT_NEAR(direction.length(), 1.0f, 1e-6f);
        ASSERT_GE(direction.z, 0.0f);
        // The cosine's integral over a cap is sin², so equal steps of sin² are equal shares.
        const double sinSquared =
            1.0 - static_cast<double>(direction.z) * static_cast<double>(direction.z);
        ++counts[cellOf(sinSquared, std::atan2(direction.y, direction.x))];
    }
    EXPECT_LT(chiSquare(counts, kSampleCount), kChiSquareLimit);
}

TEST(Sampling, UniformHemisphereFollowsItsDensity) {  // B2
    RandomStream random(6, 0);
    std::vector<int> counts(256);
    for (int i = 0; i < kSampleCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const Vec3f direction = sampleUniformHemisphere(u, unitFloatFromBits(random.nextBits()));
        ASSERT_NEAR(direction.length(), 1.0f, 1e-6f);
        ASSERT_GE(direction.z, 0.0f);
        // Zones of equal height have equal areas.
        ++counts[cellOf(static_cast<double>(direction.z), std::atan2(direction.y, direction.x))];
    }
    EXPECT_LT(chiSquare(counts, kSampleCount), kChiSquareLimit);
}

TEST(Sampling, UniformSphereFollowsItsDensity) {  // B2
    RandomStream random(7, 0);
    std::vector<int> counts(256);
    for (int i = 0; i < kSampleCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const Vec3f direction = sampleUniformSphere(u, unitFloatFromBits(random.nextBits()));
        ASSERT_NEAR(direction.length(), 1.0f, 1e-6f);
        ++counts[cellOf((static_cast<double>(direction.z) + 1.0) / 2.0,
                        std::atan2(direction.y, direction.x))];
    }
    EXPECT_LT(chiSquare(counts, kSampleCount), kChiSquareLimit);
}

TEST(Sampling, DensitiesMatchTheirDirections) {
    EXPECT_FLOAT_EQ(cosineHemispherePdf({0.0f, 0.0f, 1.0f}), std::numbers::inv_pi_v<float>);
    EXPECT_EQ(cosineHemispherePdf({0.0f, 0.0f, -1.0f}), 0.0f);
    EXPECT_FLOAT_EQ(uniformHemispherePdf({0.6f, 0.0f, 0.8f}) * 2.0f * std::numbers::pi_v<float>,
                    1.0f);
    EXPECT_EQ(uniformHemispherePdf({0.6f, 0.0f, -0.8f}), 0.0f);
    EXPECT_FLOAT_EQ(uniformSpherePdf() * 4.0f * std::numbers::pi_v<float>, 1.0f);
}

struct Estimate {
    double mean = 0.0;
    double variance = 0.0;
};

/// ∫ max(cos θ, 0) dω over the half of the sphere with x > 0, from single samples.
template <class Sample>
Estimate estimateHalfCosine(Sample sample) {
    RandomStream random(11, 0);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kSampleCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const double value = sample(u, unitFloatFromBits(random.nextBits()));
        sum += value;
        squares += value * value;
    }
    const double mean = sum / kSampleCount;
    return {mean, squares / kSampleCount - mean * mean};
}

TEST(Sampling, AllEstimatorsAgreeAndImportanceSamplingIsQuietest) {  // T-2, T-5
    const auto integrand = [](const Vec3f& w) { return w.x > 0.0f ? std::max(0.0f, w.z) : 0.0f; };
    const Estimate uniform = estimateHalfCosine([&](float u, float v) {
        const Vec3f w = sampleUniformSphere(u, v);
        return static_cast<double>(integrand(w) / uniformSpherePdf());
    });
    const Estimate hemisphere = estimateHalfCosine([&](float u, float v) {
        Vec3f w = sampleUniformSphere(u, v);
        w.z = std::abs(w.z);
        return static_cast<double>(integrand(w) / (2.0f * uniformSpherePdf()));
    });
    const Estimate cosine = estimateHalfCosine([&](float u, float v) {
        const Vec3f w = sampleCosineHemisphere(u, v);
        return static_cast<double>(integrand(w) / cosineHemispherePdf(w));
    });
    const double truth = std::numbers::pi / 2.0;
    EXPECT_NEAR(uniform.mean, truth, 4.0 * std::sqrt(uniform.variance / kSampleCount));
    EXPECT_NEAR(hemisphere.mean, truth, 4.0 * std::sqrt(hemisphere.variance / kSampleCount));
    EXPECT_NEAR(cosine.mean, truth, 4.0 * std::sqrt(cosine.variance / kSampleCount));
    // Variances in closed form: 4π·π/3 − π²/4, 2π·π/3 − π²/4, and π²/4.
    const double pi2 = std::numbers::pi * std::numbers::pi;
    EXPECT_NEAR(uniform.variance, pi2 * (4.0 / 3.0 - 0.25), 0.2);
    EXPECT_NEAR(hemisphere.variance, pi2 * (2.0 / 3.0 - 0.25), 0.2);
    EXPECT_NEAR(cosine.variance, pi2 * 0.25, 0.05);
}

}  // namespace
}  // namespace prt

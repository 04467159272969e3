#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/brdf/brdf.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::makeAllKinds;
using test::viewAt;

constexpr double kPi = std::numbers::pi;
constexpr int kRowCount = 8, kColumnCount = 16;  // of the upper hemisphere, equal in z and azimuth

/// ∫ density over the cells of the upper hemisphere, and over all that lies below it.
std::vector<double> integrateDensity(const Brdf& brdf, const Vec3d& view) {
    static const std::vector<QuadratureNode> kRule = gaussLegendre(40);
    std::vector<double> integrals;
    double above = 0.0;
    for (int row = 0; row < kRowCount; ++row)
        for (int column = 0; column < kColumnCount; ++column) {
            const double theta0 = std::acos((row + 1.0) / kRowCount);
            const double theta1 = std::acos(static_cast<double>(row) / kRowCount);
            double sum = 0.0;
            for (const QuadratureNode& polar : kRule)
                for (const QuadratureNode& azimuth : kRule) {
                    const double theta =
                        0.5 * (theta0 + theta1 + polar.position * (theta1 - theta0));
                    const double phi = kPi / kColumnCount * (2.0 * column + 1.0 + azimuth.position);
                    const Vec3d incident(std::sin(theta) * std::cos(phi),
                                         std::sin(theta) * std::sin(phi), std::cos(theta));
                    sum += polar.weight * azimuth.weight * std::sin(theta) *
                           brdfDensity(brdf, incident, view);
                }
            integrals.push_back(sum * 0.5 * (theta1 - theta0) * kPi / kColumnCount);
            above += integrals.back();
        }
    integrals.push_back(1.0 - above);
    return integrals;
}

std::size_t cellOf(const Vec3d& direction) {
    if (direction.z <= 0.0) return static_cast<std::size_t>(kRowCount * kColumnCount);
    const int row = std::min(static_cast<int>(direction.z * kRowCount), kRowCount - 1);
    const double turns =
        std::atan2(direction.y, direction.x) / (2.0 * kPi) + (direction.y < 0.0 ? 1.0 : 0.0);
    const int column = std::min(static_cast<int>(turns * kColumnCount), kColumnCount - 1);
    return static_cast<std::size_t>(row * kColumnCount + column);
}

// B2
TEST(BrdfSampling, HistogramsOfSamplesFollowTheDensity) {
    constexpr int kSampleCount = 200'000;
    constexpr double kSigmas = 5.0;   // of χ², whose variance is twice its degrees of freedom
    constexpr double kFewest = 10.0;  // expected in a cell that is looked at by itself
    int histogramCount = 0;
    for (const auto& [name, brdf] : makeAllKinds())
        for (const double degrees : {20.0, 70.0}) {
            const Vec3d view = viewAt(degrees);
            std::vector<int> histogram(kRowCount * kColumnCount + 1, 0);
            RandomStream random(7, 0);
            for (int i = 0; i < kSampleCount; ++i) {
                const double u = random.nextUnitDouble();
                ++histogram[cellOf(sampleBrdf(brdf, view, u, random.nextUnitDouble()).incident)];
            }
            const std::vector<double> expected = integrateDensity(brdf, view);
            // Cells in which few are expected count together.
            double chiSquare = 0.0, restExpected = 0.0, restFound = 0.0;
            int cellCount = 0;
            const auto compare = [&](double found, double hoped) {
                chiSquare += (found - hoped) * (found - hoped) / hoped;
                ++cellCount;
            };
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const double hoped = expected[i] * kSampleCount;
                if (hoped >= kFewest) {
                    compare(histogram[i], hoped);
                } else {
                    restExpected += hoped;
                    restFound += histogram[i];
                }
            }
            if (restExpected >= kFewest) compare(restFound, restExpected);
            const double freedom = cellCount - 1.0;
            EXPECT_GT(freedom, 20.0);
            EXPECT_LT(chiSquare, freedom + kSigmas * std::sqrt(2.0 * freedom))
                << name << " at " << degrees;
            ++histogramCount;
        }
    EXPECT_EQ(histogramCount, 16);
}

TEST(BrdfSampling, ASampleTellsItsDensityAndItsWeight) {
    constexpr double kRounding = 1e-12;
    RandomStream random(8, 0);
    for (const auto& [name, brdf] : makeAllKinds())
        for (int i = 0; i < 500; ++i) {
            const Vec3d view = test::drawUpward(random);
            const double u = random.nextUnitDouble();
            const BrdfSample sample = sampleBrdf(brdf, view, u, random.nextUnitDouble());
            ASSERT_NEAR(sample.incident.length(), 1.0, kRounding) << name;
            ASSERT_EQ(sample.density, brdfDensity(brdf, sample.incident, view)) << name;
            if (sample.incident.z <= 0.0) {
                ASSERT_EQ(sample.weight, Vec3d(0.0)) << name;
                continue;
            }
            const Vec3d value = evaluateBrdf(brdf, sample.incident, view) * sample.incident.z;
            ASSERT_NEAR((sample.weight * sample.density - value).length(), 0.0,
                        kRounding * (1.0 + value.length()))
                << name;
        }
}

// No sample weighs much more than the mean, or pictures would sparkle.
TEST(BrdfSampling, WeightsAreBounded) {
    RandomStream random(9, 0);
    for (const auto& [name, brdf] : makeAllKinds())
        for (int i = 0; i < 20'000; ++i) {
            const Vec3d view = test::drawUpward(random);
            const double u = random.nextUnitDouble();
            const BrdfSample sample = sampleBrdf(brdf, view, u, random.nextUnitDouble());
            ASSERT_LT(std::max({sample.weight.x, sample.weight.y, sample.weight.z}), 5.0)
                << name << " view " << view << " incident " << sample.incident;
        }
}

}  // namespace
}  // namespace prt

#include "prt/light/deringing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/irradiance.h"

namespace prt {
namespace {

const Vec3d kDirections[] = {Vec3d(0, 0, 1), Vec3d(0, 1, 0), Vec3d(2, -1, -2) / 3.0};

/// λ from the factor 1 / (1 + 4 λ) of degree 1.
double lambdaOf(const std::vector<double>& factors) {
    return (1.0 / factors[1] - 1.0) / 4.0;
}

/// Each band of each channel over a Fibonacci spiral, so that any λ is judged in no time.
class BruteForce {
  public:
    explicit BruteForce(const Lighting& lighting)
        : bandCount_(static_cast<std::size_t>(lighting.bandCount)) {
        std::vector<double> values(lighting.coefficients.size());
        for (int i = 0; i < kDirectionCount; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kDirectionCount;
            const double radius = std::sqrt(1.0 - z * z);
            const double phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            evaluateSh(Vec3d(radius * std::cos(phi), radius * std::sin(phi), z), lighting.bandCount,
                       values);
            std::size_t k = 0;
            for (std::size_t l = 0; l < bandCount_; ++l) {
                Vec3d sum(0.0);
                for (; k < (l + 1) * (l + 1); ++k)
                    sum += lighting.coefficients[k] * values[k];
                bands_.push_back(sum);
            }
        }
    }

    /// The least channel over all directions.
    double findLowest(const std::vector<double>& factors) const {
        double lowest = 1e300;
        for (std::size_t i = 0; i < bands_.size(); i += bandCount_) {
            Vec3d sum(0.0);
            for (std::size_t l = 0; l < bandCount_; ++l)
                sum += bands_[i + l] * factors[l];
            lowest = std::min({lowest, sum.x, sum.y, sum.z});
        }
        return lowest;
    }

  private:
    static constexpr int kDirectionCount = 20000;
    std::size_t bandCount_;
    std::vector<Vec3d> bands_;  // [direction][band]
};

Lighting makeRandomSuns(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting = uniformLighting(Vec3d(0.02), bandCount);
    for (int i = 0; i < 4; ++i) {
        const double z = 2.0 * random.nextUnitDouble() - 1.0;
        const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
        const double radius = std::sqrt(1.0 - z * z);
        Lighting sun =
            sunLighting(Vec3d(radius * std::cos(phi), radius * std::sin(phi), z), 0.1, bandCount);
        const Vec3d color(random.nextUnitDouble(), random.nextUnitDouble(),
                          random.nextUnitDouble());
        for (Vec3d& coefficient : sun.coefficients)
            coefficient *= color;
        lighting = add(lighting, sun);
    }
    return lighting;
}

/// Coefficients of any sign about a mean of 1: ringing of all degrees alike.
Lighting makeRandomNoise(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 1);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient =
            Vec3d(random.nextUnitDouble(), random.nextUnitDouble(), random.nextUnitDouble()) -
            Vec3d(0.5);
    lighting.coefficients[0] = Vec3d(1.0, 0.5, 2.0);
    return lighting;
}

TEST(Deringing, OfRadianceADirectionalLightNeedsThePublishedLambda) {
    constexpr double kPublishedPrecision = 1e-5;
    const struct {
        int bandCount;
        double lambda;
    } table[] = {{2, .5}, {3, .25}, {5, .31668}, {6, .34263}};
    for (const auto& [bandCount, lambda] : table) {
        for (const Vec3d& direction : kDirections) {
            EXPECT_NEAR(lambdaOf(deringingFactors(sunLighting(direction, 0.0, bandCount))), lambda,
                        kPublishedPrecision)
                << bandCount << " bands";
        }
    }
}

TEST(Deringing, OfIrradianceADirectionalLightNeedsThePublishedLambda) {
    constexpr double kPublishedPrecision = 1e-5;
    const struct {
        int bandCount;
        double lambda;
    } table[] = {{2, .25}, {3, .17773}, {5, .18042}, {6, .18042}};
    for (const auto& [bandCount, lambda] : table) {
        for (const Vec3d& direction : kDirections) {
            const auto factors =
                deringingFactors(sunLighting(direction, 0.0, bandCount), {NonNegative::irradiance});
            EXPECT_NEAR(lambdaOf(factors), lambda, kPublishedPrecision) << bandCount << " bands";
        }
    }
}

// E(z) = 1/4 + w_1 z/2 + w_2 5 (3z² − 1)/32 for a directional light along +z.
TEST(Deringing, AHannWindowLeavesIrradianceMoreNegativeThanNoneDoes) {
    constexpr double kPrintedPrecision = 1e-6;
    const Lighting sun = sunLighting(Vec3d(0, 0, 1), 0.0, 3);
    EXPECT_NEAR(evaluateIrradiance(sun, Vec3d(std::sqrt(1.0 - 64.0 / 225.0), 0, -8.0 / 15.0)).x,
                -.039583, kPrintedPrecision);
    const Lighting windowed = applyWindow(sun, windowFactors(ShWindow::hann, 3));
    EXPECT_NEAR(evaluateIrradiance(windowed, Vec3d(0, 0, -1)).x, -.046875, kPrintedPrecision);
}

TEST(Deringing, LeavesLightingWithoutNegativeLobesAlone) {
    const std::vector<double> identity(5, 1.0);
    EXPECT_EQ(deringingFactors(uniformLighting(Vec3d(1.0, 2.0, 0.0), 5)), identity);
    EXPECT_EQ(deringingFactors(Lighting(5)), identity);
    EXPECT_EQ(deringingFactors(Lighting(1)), std::vector<double>(1, 1.0));
    Lighting slope = uniformLighting(Vec3d(1.0), 5);
    slope.coefficients[1].x = 0.5;
    EXPECT_EQ(deringingFactors(slope), identity);
    // Its least radiance is 0 but for rounding.
    slope.coefficients[1].x = slope.coefficients[0].x / std::sqrt(3.0) * (1.0 + 1e-12);
    EXPECT_EQ(deringingFactors(slope), identity);
    // Radiance rings where irradiance does not.
    const Lighting sunny =
        add(sunLighting(Vec3d(0, 1, 0), 0.0, 5), uniformLighting(Vec3d(0.02), 5));
    EXPECT_LT(deringingFactors(sunny)[1], 1.0);
    EXPECT_EQ(deringingFactors(sunny, {NonNegative::irradiance}), identity);
}

TEST(Deringing, MakesEveryChannelNonNegativeWithTheLeastLambda) {
    constexpr double kRounding = 1e-9;
    constexpr double kLeast = 0.99;  // the spiral misses the lowest point by a little
    constexpr int kScanCount = 40;
    for (int bandCount = 2; bandCount <= 10; ++bandCount) {
        for (const Lighting& lighting :
             {makeRandomSuns(bandCount, 17), makeRandomSuns(bandCount, 18),
              makeRandomNoise(bandCount, 19)}) {
            for (const NonNegative nonNegative : {NonNegative::radiance, NonNegative::irradiance}) {
                const bool isIrradiance = nonNegative == NonNegative::irradiance;
                SCOPED_TRACE(testing::Message() << bandCount << " bands of "
                                                << (isIrradiance ? "irradiance" : "radiance"));
                const BruteForce truth(isIrradiance ? convolveWithCosine(lighting) : lighting);
                const auto factors = deringingFactors(lighting, {nonNegative});
                EXPECT_EQ(factors[0], 1.0);
                EXPECT_GT(truth.findLowest(factors),
                          -kRounding * lighting.coefficients[0].length());

                const double lambda = lambdaOf(factors);
                if (factors[1] == 1.0) continue;
                for (int i = 0; i < kScanCount; ++i) {
                    const double less = kLeast * lambda * i / (kScanCount - 1);
                    EXPECT_LT(truth.findLowest(laplacianFactors(less, bandCount)), 0.0)
                        << less << " of " << lambda;
                }
            }
        }
    }
}

TEST(Deringing, DoesNotDependOnExposure) {
    const Lighting lighting = makeRandomSuns(5, 20);
    const auto factors = deringingFactors(lighting);
    for (const double exposure : {0x1p-200, 0x1p-20, 0x1p200})
        EXPECT_EQ(deringingFactors(scale(lighting, exposure)), factors);
}

TEST(Deringing, AChannelThatIsBlackOrNegativeOnTheWholeIsLeftOut) {
    for (const double blue : {0.0, -1.0}) {
        Lighting lighting = sunLighting(Vec3d(0, 1, 0), 0.0, 3);
        for (Vec3d& coefficient : lighting.coefficients)
            coefficient.z *= blue;
        EXPECT_NEAR(lambdaOf(deringingFactors(lighting)), 0.25, 1e-5);
        lighting.coefficients[5].z = 100.0;
        EXPECT_NEAR(lambdaOf(deringingFactors(lighting)), 0.25, 1e-5);
    }
}

// What is all ringing and next to no light is smoothed away, and each mean stays.
TEST(Deringing, EndsWhateverTheRangeOfTheCoefficients) {
    constexpr double kRounding = 1e-9;
    constexpr double kUnderflow = 1e-299;  // of what no window of a double can take away
    for (const double mean : {1e-6, 1e-100, 1e-308, 5e-324}) {
        for (const int bandCount : {3, 10}) {
            Lighting lighting = makeRandomNoise(bandCount, 21);
            lighting.coefficients[0] = Vec3d(mean, 1.0, 1.0);
            const auto factors = deringingFactors(lighting);
            EXPECT_EQ(factors[0], 1.0);
            for (const double factor : factors)
                EXPECT_TRUE(factor >= 0.0 && factor <= 1.0) << factor;
            EXPECT_GE(BruteForce(lighting).findLowest(factors), -kRounding * mean - kUnderflow)
                << mean << ", " << bandCount << " bands";
        }
    }
}

}  // namespace
}  // namespace prt

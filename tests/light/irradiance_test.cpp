#include "prt/light/irradiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/basis/zonal.h"
#include "prt/light/analytic_lights.h"
#include "prt/math/quadrature.h"
#include "tests/support/published_probes.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;

Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient =
            Vec3d(random.nextUnitDouble(), random.nextUnitDouble(), random.nextUnitDouble()) * 2.0 -
            Vec3d(1.0);
    return lighting;
}

void expectNear(const Vec3d& value, const Vec3d& truth, double tolerance) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(value[channel], truth[channel], tolerance) << "channel " << channel;
}

/// The nine-coefficient polynomial as published: no phase, and axes of its own [Ramamoorthi01].
Vec3d evaluatePublishedPolynomial(const std::array<Vec3d, 9>& radiance, const Vec3d& n) {
    constexpr double kC1 = 0.429043, kC2 = 0.511664, kC3 = 0.743125, kC4 = 0.886227, kC5 = 0.247708;
    return radiance[8] * (kC1 * (n.x * n.x - n.y * n.y)) + radiance[6] * (kC3 * n.z * n.z) +
           radiance[0] * kC4 - radiance[6] * kC5 +
           (radiance[4] * (n.x * n.y) + radiance[7] * (n.x * n.z) + radiance[5] * (n.y * n.z)) *
               (2.0 * kC1) +
           (radiance[3] * n.x + radiance[1] * n.y + radiance[2] * n.z) * (2.0 * kC2);
}

/// What is published in the axes and signs of [Ramamoorthi01], in ours.
Lighting importPublished(const std::array<Vec3d, 9>& radiance) {
    Lighting lighting(3);
    std::copy(radiance.begin(), radiance.end(), lighting.coefficients.begin());
    return convertFrom(ShConvention::rh, lighting);
}

Vec3d ourDirection(const Vec3d& published) {
    return Vec3d(published.x, published.y, -published.z);
}

// T-12
TEST(Irradiance, IsTheSumOfItsBandsAndTheQuadraticForm) {
    for (const int bandCount : {1, 2, 3}) {
        const Lighting lighting = makeRandomLighting(bandCount, 1);
        const IrradianceMatrix matrix = makeIrradianceMatrix(lighting);
        std::vector<double> values(lighting.coefficients.size());
        for (const auto& [normal, weight] : sphereQuadrature(6)) {
            evaluateSh(normal, bandCount, values);
            const double factors[] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0};
            Vec3d sum(0.0);
            for (std::size_t i = 0; i < values.size(); ++i)
                sum +=
                    lighting.coefficients[i] * (factors[shDegree(static_cast<int>(i))] * values[i]);
            expectNear(evaluateIrradiance(lighting, normal), sum, kRounding);
            expectNear(evaluateIrradiance(matrix, normal), sum, kRounding);
        }
    }
}

TEST(Irradiance, FromTheMatrixIsThatOfTheFirstNineCoefficients) {
    const Lighting lighting = makeRandomLighting(6, 2);
    const IrradianceMatrix matrix = makeIrradianceMatrix(lighting);
    for (const auto& [normal, weight] : sphereQuadrature(6))
        expectNear(evaluateIrradiance(matrix, normal),
                   evaluateIrradiance(truncate(lighting, 3), normal), kRounding);
}

TEST(Irradiance, OfADirectionalLightIsTheClampedCosine) {
    constexpr double kTail = 2e-4;  // Σ A_l (2l+1)/4π beyond 100 bands
    const Vec3d sun = Vec3d(2.0, -1.0, 2.0) / 3.0;
    const Lighting lighting = sunLighting(sun, 0.0, 100);
    for (const auto& [normal, weight] : sphereQuadrature(6))
        expectNear(evaluateIrradiance(lighting, normal), Vec3d(std::max(sun.dot(normal), 0.0)),
                   10.0 * kTail);
}

// Two decimals of each coefficient, and irradiance computed elsewhere with the published constants,
// of which two are off in the sixth digit.
TEST(Irradiance, OfThePublishedGraceCathedralIsWhatItsTableGives) {
    constexpr double kPublishedConstants = 5e-6;
    const Lighting lighting = importPublished({{{.79, .44, .54},
                                                {.39, .35, .60},
                                                {-.34, -.18, -.27},
                                                {-.29, -.06, .01},
                                                {-.11, -.05, -.12},
                                                {-.26, -.22, -.47},
                                                {-.16, -.09, -.15},
                                                {.56, .21, .14},
                                                {.21, -.05, -.30}}});
    const struct {
        Vec3d normal;
        Vec3d irradiance;
    } table[] = {
        {{1, 0, 0}, {.533087, .329382, .397239}},
        {{-1, 0, 0}, {1.126617, .452181, .376773}},
        {{0, 1, 0}, {1.048752, .791851, 1.258428}},
        {{0, -1, 0}, {.250556, .075521, .030435}},
        {{0, 0, 1}, {.272921, .161153, .127951}},
        {{0, 0, -1}, {.968784, .529551, .680549}},
        {Vec3d(1, 1, 1).normalized(), {.612668, .437768, .550728}},
    };
    const IrradianceMatrix matrix = makeIrradianceMatrix(lighting);
    for (const auto& [normal, irradiance] : table)
        expectNear(evaluateIrradiance(matrix, ourDirection(normal)), irradiance,
                   kPublishedConstants);
}

TEST(Irradiance, OfFivePublishedProbesIsThePublishedPolynomial) {
    constexpr double kPublishedConstants = 5e-6;
    for (const PublishedProbe& probe : kPublishedProbes) {
        SCOPED_TRACE(probe.name);
        const IrradianceMatrix matrix = makeIrradianceMatrix(importPublished(probe.rh));
        for (const auto& [normal, weight] : sphereQuadrature(6))
            expectNear(evaluateIrradiance(matrix, ourDirection(normal)),
                       evaluatePublishedPolynomial(probe.rh, normal), kPublishedConstants);
    }
}

// T-13: |e| of a directional light in 1, 4, 9 and 25 coefficients, as fractions of its peak.
TEST(IrradianceErrors, OfADirectionalLightHaveTheirClosedForm) {
    constexpr double kPrintedPrecision = 6e-4;  // and what 80 bands lack of the clamped cosine
    constexpr double kRoundedKink = 5e-3;       // at the horizon, where the error is largest
    const auto errors =
        measureIrradianceErrors(sunLighting(Vec3d(2.0, -1.0, 2.0) / 3.0, 0.0, 80), 5);
    ASSERT_EQ(errors.size(), 5u);
    const struct {
        std::size_t bandCount;
        double mean;
        double keptEnergy;  ///< of max(cos θ, 0), which is 1/6 on average
        double largest;
    } table[] = {{1, .281, .375, .75},
                 {2, .125, .875, .25},
                 {3, .0307, .9921875, 3.0 / 32.0},
                 {5, .0148, .998046875, 3.0 / 32.0 - 9.0 / 256.0}};
    for (const auto& [bandCount, mean, keptEnergy, largest] : table) {
        const IrradianceError& error = errors[bandCount - 1];
        EXPECT_EQ(error.bandCount, static_cast<int>(bandCount));
        EXPECT_NEAR(error.mean, mean, kPrintedPrecision) << bandCount << " bands";
        EXPECT_NEAR(error.rms, std::sqrt((1.0 - keptEnergy) / 6.0), kPrintedPrecision)
            << bandCount << " bands";
        EXPECT_NEAR(error.largest, largest, kRoundedKink) << bandCount << " bands";
    }
}

TEST(IrradianceErrors, OfTheWorstLightAreThePublishedOnes) {
    // Computed for the reference data: means of 1, 4, 9 and 25 coefficients.
    const auto errors = worstIrradianceErrors(5);
    EXPECT_NEAR(errors[0].mean, 0.281, 5e-4);
    EXPECT_NEAR(errors[1].mean, 0.125, 5e-4);
    EXPECT_NEAR(errors[2].mean, 0.0307, 5e-5);
    EXPECT_NEAR(errors[2].rms, 0.0361, 5e-5);
    EXPECT_NEAR(errors[2].largest, 0.09375, 1e-9);
    EXPECT_NEAR(errors[4].mean, 0.0148, 5e-5);
    // A light seen in many bands comes close.
    const auto many = measureIrradianceErrors(sunLighting(Vec3d(0, 1, 0), 0.0, 50), 5);
    for (std::size_t l = 0; l < 5; ++l)
        EXPECT_NEAR(many[l].mean, errors[l].mean, 1e-3);
}

// "Average error under 3 % for any illumination" [Ramamoorthi01]: a single light is the worst.
TEST(IrradianceErrors, OfNineCoefficientsAreWithinThoseOfADirectionalLight) {
    RandomStream random(3, 0);
    Lighting many(30);
    for (const double halfAngle : {0.1, 0.3, 0.8, 1.4}) {
        const double z = 2.0 * random.nextUnitDouble() - 1.0;
        const Lighting one =
            sunLighting(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), halfAngle, many.bandCount);
        many = add(many, one);
        for (const Lighting& lighting : {one, many}) {
            const auto errors = measureIrradianceErrors(lighting);
            ASSERT_EQ(errors.size(), 3u);
            EXPECT_LT(errors[2].mean, 0.0307) << halfAngle;
            EXPECT_LT(errors[2].rms, 0.0361) << halfAngle;
            EXPECT_LT(errors[2].mean, errors[1].mean) << halfAngle;
            EXPECT_LT(errors[1].mean, errors[0].mean) << halfAngle;
        }
    }
}

TEST(IrradianceErrors, AreThoseOfLuminanceAndIndependentOfExposure) {
    Lighting blue = sunLighting(Vec3d(0, 1, 0), 0.2, 20);
    const auto white = measureIrradianceErrors(blue);
    for (Vec3d& coefficient : blue.coefficients)
        coefficient *= Vec3d(0.0, 0.0, 250.0);
    const auto errors = measureIrradianceErrors(blue);
    for (std::size_t l = 0; l < 3; ++l) {
        EXPECT_NEAR(errors[l].mean, white[l].mean, kRounding);
        EXPECT_NEAR(errors[l].rms, white[l].rms, kRounding);
        EXPECT_NEAR(errors[l].largest, white[l].largest, kRounding);
    }
    for (const IrradianceError& error : measureIrradianceErrors(Lighting(5))) {
        EXPECT_EQ(error.mean, 0.0);
        EXPECT_EQ(error.rms, 0.0);
        EXPECT_EQ(error.largest, 0.0);
    }
}

}  // namespace
}  // namespace prt

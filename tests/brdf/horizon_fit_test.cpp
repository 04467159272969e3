#include "prt/brdf/horizon_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/brdf_view_table.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

constexpr double kRounding = 1e-10;
constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 32, .azimuthNodeCount = 16};

/// ∫ y_i Σ_j c_j y_j dω over one hemisphere.
std::vector<double> projectHemisphere(std::span<const double> coefficients, int bandCount,
                                      bool isUpper) {
    std::vector<double> sums(coefficients.size());
    std::vector<double> basis(coefficients.size());
    // A rule of the sphere squeezed into half of it.
    for (const SphereNode& node : sphereQuadrature(4 * bandCount)) {
        const double z = 0.5 * (node.direction.z + (isUpper ? 1.0 : -1.0));
        const double radius = std::hypot(node.direction.x, node.direction.y);
        const double stretch = std::sqrt(1.0 - z * z) / radius;
        evaluateSh(Vec3d(node.direction.x * stretch, node.direction.y * stretch, z), bandCount,
                   basis);
        double value = 0.0;
        for (std::size_t i = 0; i < basis.size(); ++i)
            value += coefficients[i] * basis[i];
        for (std::size_t i = 0; i < basis.size(); ++i)
            sums[i] += 0.5 * node.weight * value * basis[i];
    }
    return sums;
}

TEST(HorizonFit, NothingIsBetterAboveTheHorizonForItsPriceBelow) {
    RandomStream random(3, 0);
    for (const int bandCount : {1, 2, 5, 8})
        for (const double weight : {0.01, 0.3}) {
            std::vector<double> projected(static_cast<std::size_t>(shCoefficientCount(bandCount)));
            for (double& number : projected)
                number = 2.0 * random.nextUnitDouble() - 1.0;
            std::vector<double> fitted = projected;
            HorizonFit(bandCount, weight).apply(fitted);
            // The derivative of what is least is 0.
            const std::vector<double> above = projectHemisphere(fitted, bandCount, true);
            const std::vector<double> below = projectHemisphere(fitted, bandCount, false);
            for (std::size_t i = 0; i < fitted.size(); ++i)
                EXPECT_NEAR(above[i] - projected[i] + weight * below[i], 0.0, kRounding)
                    << bandCount << " bands, number " << i;
        }
}

TEST(HorizonFit, OfWeightOneLeavesAllAsItIs) {
    std::vector<double> coefficients(36);
    for (std::size_t i = 0; i < 36; ++i)
        coefficients[i] = std::sin(static_cast<double>(i));
    const std::vector<double> before = coefficients;
    HorizonFit(6, 1.0).apply(coefficients);
    for (std::size_t i = 0; i < 36; ++i)
        EXPECT_NEAR(coefficients[i], before[i], kRounding);
}

TEST(HorizonFit, FindsTheFunctionThatBandsHoldAboveTheHorizon) {
    // Above the horizon the clamped cosine is y_10 times this.
    const double cosine = std::sqrt(4.0 * std::numbers::pi / 3.0);
    std::vector<double> coefficients(25);
    const std::vector<double> zonal = clampedCosineZonal(5);
    for (int l = 0; l < 5; ++l)
        coefficients[static_cast<std::size_t>(shIndex(l, 0))] = zonal[static_cast<std::size_t>(l)];
    constexpr double kSmallWeight = 1e-11;
    HorizonFit(5, kSmallWeight).apply(coefficients);
    for (std::size_t i = 0; i < 25; ++i)
        EXPECT_NEAR(coefficients[i], i == 2 ? cosine : 0.0, 1e-5) << i;
}

/// The largest error of what a white sky sends to a view, relative.
double measureWhiteSky(const Brdf& brdf, int bandCount, double weight) {
    const BrdfViewTable table(
        brdf,
        {.bandCount = bandCount, .viewCount = 24, .horizonWeight = weight, .quadrature = kCoarse});
    std::vector<double> white(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    white[0] = std::sqrt(4.0 * std::numbers::pi);
    const std::vector<double> incident = projectHemisphere(white, bandCount, true);
    double largest = 0.0;
    for (double degrees = 0.0; degrees < 85.0; degrees += 3.0) {
        const Vec3d view = test::viewAt(degrees);
        std::vector<float> response(3 * white.size());
        table.addResponse(Vec3f(view), response);
        double seen = 0.0;
        for (std::size_t i = 0; i < white.size(); ++i)
            seen += static_cast<double>(response[i]) * incident[i];
        const double expected = projectBrdfView(brdf, view, 1, kCoarse)[0][0] * white[0];
        largest = std::max(largest, std::abs(seen / expected - 1.0));
    }
    return largest;
}

TEST(HorizonFit, KeepsTheEnergyOfLobes) {
    for (const int bandCount : {3, 5})
        for (const double roughness : {0.5, 0.7, 1.0}) {
            const Brdf lobe = test::makeGgx(roughness);
            const double plain = measureWhiteSky(lobe, bandCount, 1.0);
            const double fitted = measureWhiteSky(lobe, bandCount, kHorizonFitWeight);
            EXPECT_LT(fitted, 0.3 * plain) << roughness;
            EXPECT_LT(fitted, 0.025) << roughness;
        }
}

TEST(HorizonFit, OfBothTablesIsTheSame) {
    constexpr double kFloatRounding = 2e-6;
    const Vec3f baseColor(0.9f, 0.5f, 0.2f);
    const MetallicRoughness surface{.metallic = 0.25f, .roughness = 0.5f};
    for (const double weight : {1.0, 0.01}) {
        const BrdfViewTable table(makeGltfBrdf(baseColor, surface),
                                  {.viewCount = 3, .horizonWeight = weight, .quadrature = kCoarse});
        const GltfViewTable gltf(
            {.levelCount = 3, .viewCount = 3, .horizonWeight = weight, .quadrature = kCoarse});
        std::vector<float> response(75), expected(75);
        table.addResponse(Vec3f(0.48f, 0.6f, 0.64f), response);
        gltf.addResponse(baseColor, surface, Vec3f(0.48f, 0.6f, 0.64f), expected);
        for (std::size_t k = 0; k < 75; ++k)
            EXPECT_NEAR(response[k], expected[k], kFloatRounding) << k;
    }
}

}  // namespace
}  // namespace prt

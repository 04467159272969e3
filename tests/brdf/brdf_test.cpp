#include "prt/brdf/brdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/brdf/microfacets.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::drawUpward;
using test::makeAllKinds;
using test::makeGgx;
using test::viewAt;

constexpr double kPi = std::numbers::pi;

/// ∫ g dω over the upper hemisphere, Gauss-Legendre in θ.
template <class Function>
Vec3d integrateUpward(const Function& function, int nodeCount = 96) {
    static const std::vector<QuadratureNode> kRule = gaussLegendre(96);
    const std::vector<QuadratureNode> rule = nodeCount == 96 ? kRule : gaussLegendre(nodeCount);
    Vec3d sum(0.0);
    for (const QuadratureNode& polar : rule) {
        const double theta = 0.25 * kPi * (1.0 + polar.position);
        for (int k = 0; k < 2 * nodeCount; ++k) {
            const double phi = kPi * (k + 0.5) / nodeCount;
            const Vec3d direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
            sum += function(direction) * (polar.weight * std::sin(theta));
        }
    }
    return sum * (0.25 * kPi * kPi / nodeCount);
}

Vec3d directionalAlbedo(const Brdf& brdf, const Vec3d& view, int nodeCount = 96) {
    return integrateUpward(
        [&](const Vec3d& incident) { return evaluateBrdf(brdf, incident, view) * incident.z; },
        nodeCount);
}

/// From the textbook: tangents, and Λ of each direction [Heitz14].
double evaluateGgxSlowly(const Vec3d& incident, const Vec3d& view, double alpha) {
    const Vec3d half = (incident + view).normalized();
    const auto tanSquared = [](const Vec3d& d) { return (1.0 - d.z * d.z) / (d.z * d.z); };
    const auto lambda = [&](const Vec3d& d) {
        return 0.5 * (-1.0 + std::sqrt(1.0 + alpha * alpha * tanSquared(d)));
    };
    const double distribution = 1.0 / (kPi * alpha * alpha * std::pow(half.z, 4) *
                                       std::pow(1.0 + tanSquared(half) / (alpha * alpha), 2));
    return distribution / (1.0 + lambda(incident) + lambda(view)) / (4.0 * incident.z * view.z);
}

// A19
TEST(Brdf, ExchangingTheDirectionsChangesNothing) {
    constexpr double kRounding = 1e-12;
    RandomStream random(1, 0);
    int checkCount = 0;
    for (const auto& [name, brdf] : makeAllKinds()) {
        // Of measured ones, a direction within rounding of a cell's edge may fall to either side.
        for (int i = 0; i < 1000; ++i, ++checkCount) {
            const Vec3d a = drawUpward(random), b = drawUpward(random);
            const Vec3d there = evaluateBrdf(brdf, a, b), back = evaluateBrdf(brdf, b, a);
            ASSERT_NEAR((there - back).length(), 0.0, kRounding * (1.0 + there.length())) << name;
        }
    }
    EXPECT_EQ(checkCount, 8000);
}

TEST(Brdf, C12_BothDirectionsPointAwayFromTheSurfaceAndTheNormalIsUp) {
    const Vec3d view = Vec3d(0.3, -0.5, 0.8).normalized();
    const Vec3d mirrored(-view.x, -view.y, view.z);
    RandomStream random(2, 0);
    for (const Brdf& brdf :
         {makeGgx(0.2), Brdf{.lobes = {PhongLobe{.albedo = Vec3d(1.0), .exponent = 200.0}}}}) {
        const double peak = evaluateBrdf(brdf, mirrored, view).x;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d incident = drawUpward(random);
            if (incident.dot(mirrored) > 0.95) continue;
            EXPECT_LT(evaluateBrdf(brdf, incident, view).x, 0.1 * peak);
        }
    }
    for (const auto& [name, brdf] : makeAllKinds()) {
        EXPECT_EQ(evaluateBrdf(brdf, -mirrored, view), Vec3d(0.0)) << name;
        EXPECT_EQ(evaluateBrdf(brdf, mirrored, -view), Vec3d(0.0)) << name;
    }
}

TEST(Brdf, GgxIsThatOfTheTextbook) {
    constexpr double kRounding = 1e-10;
    RandomStream random(3, 0);
    for (const double roughness : {0.3, 0.5, 0.8, 1.0})
        for (int i = 0; i < 500; ++i) {
            const Vec3d incident = drawUpward(random), view = drawUpward(random);
            const double expected = evaluateGgxSlowly(incident, view, roughness * roughness);
            EXPECT_NEAR(evaluateBrdf(makeGgx(roughness), incident, view).x, expected,
                        kRounding * (1.0 + expected));
        }
}

// The specification's appendix B.3.5, dielectric and metal apart.
TEST(Brdf, GltfMaterialsAreDielectricAndMetalMixed) {
    constexpr double kFloatRounding = 1e-6;  // the material's factors are float
    RandomStream random(4, 0);
    for (int i = 0; i < 2000; ++i) {
        const Vec3f baseColor(random.nextUnitFloat(), random.nextUnitFloat(),
                              random.nextUnitFloat());
        const MetallicRoughness surface{.metallic = random.nextUnitFloat(),
                                        .roughness = 0.3f + 0.7f * random.nextUnitFloat()};
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        const auto roughness = static_cast<double>(surface.roughness);
        const auto metallic = static_cast<double>(surface.metallic);
        const double specular = evaluateGgxSlowly(incident, view, roughness * roughness);
        const double weight = std::pow(1.0 - view.dot((incident + view).normalized()), 5);
        const Vec3d actual = evaluateBrdf(makeGltfBrdf(baseColor, surface), incident, view);
        for (int channel = 0; channel < 3; ++channel) {
            const auto color = static_cast<double>(baseColor[channel]);
            const double dielectric = std::lerp(color / kPi, specular, 0.04 + 0.96 * weight);
            const double metal = specular * (color + (1.0 - color) * weight);
            const double expected = std::lerp(dielectric, metal, metallic);
            ASSERT_NEAR(actual[channel], expected, kFloatRounding * (1.0 + expected));
        }
    }
}

TEST(Brdf, LambertReflectsItsAlbedoToEveryView) {
    constexpr double kRounding = 1e-12;
    const Vec3d albedo(0.8, 0.5, 0.2);
    for (const double degrees : {0.0, 40.0, 85.0})
        EXPECT_NEAR((directionalAlbedo({.lobes = {LambertLobe{albedo}}}, viewAt(degrees)) - albedo)
                        .length(),
                    0.0, kRounding);
}

TEST(Brdf, PhongReflectsItsAlbedoAlongTheNormalAndLessElsewhere) {
    constexpr double kQuadrature = 1e-5;
    for (const double exponent : {0.0, 1.0, 7.5, 60.0}) {
        const Brdf brdf{.lobes = {PhongLobe{.albedo = Vec3d(1.0), .exponent = exponent}}};
        double last = directionalAlbedo(brdf, viewAt(0.0)).x;
        EXPECT_NEAR(last, 1.0, kQuadrature) << exponent;
        for (double degrees = 5.0; degrees < 90.0; degrees += 5.0) {
            const double albedo = directionalAlbedo(brdf, viewAt(degrees)).x;
            EXPECT_LT(albedo, last + kQuadrature) << exponent << " at " << degrees;
            last = albedo;
        }
    }
}

// Of α = 1 the distribution is even and G rational: ∫ c / (c + c_o) dc from 0 to 1.
TEST(Brdf, TheRoughestGgxHasItsAlbedoInClosedForm) {
    constexpr double kQuadrature = 1e-6;
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        const double cosView = viewAt(degrees).z;
        EXPECT_NEAR(directionalAlbedo(makeGgx(1.0), viewAt(degrees)).x,
                    1.0 - cosView * std::log((1.0 + cosView) / cosView), kQuadrature);
    }
}

// The furnace: without absorption nothing is gained, and only light that met a second facet is
// lost.
TEST(Brdf, GgxNeverReflectsMoreThanFallsIn) {
    constexpr double kQuadrature = 2e-4;
    for (const double roughness : {0.35, 0.5, 0.7, 1.0})
        for (double degrees = 0.0; degrees < 89.0; degrees += 8.0) {
            const double albedo = directionalAlbedo(makeGgx(roughness), viewAt(degrees), 192).x;
            EXPECT_LE(albedo, 1.0 + kQuadrature) << roughness << " at " << degrees;
            EXPECT_GT(albedo, 0.3);
        }
}

TEST(Brdf, AMirrorReflectsAll) {
    RandomStream random(5, 0);
    constexpr double kNearlyAll = 1e-3;
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        double sum = 0.0;
        for (int i = 0; i < 1000; ++i) {
            const double u = random.nextUnitDouble();
            sum += sampleBrdf(makeGgx(0.0), viewAt(degrees), u, random.nextUnitDouble()).weight.x;
        }
        EXPECT_NEAR(sum / 1000.0, 1.0, kNearlyAll);
    }
}

TEST(Microfacets, FacetsProjectToTheSurface) {
    constexpr double kQuadrature = 1e-9;
    for (const double alpha : {0.1, 0.3, 1.0})
        EXPECT_NEAR(integrateUpward([&](const Vec3d& normal) {
                        return Vec3d(ggxDistribution(normal, alpha) * normal.z);
                    }).x,
                    1.0, kQuadrature);
}

// Whole facets, of every side: every ray that is drawn goes somewhere [Heitz14, weak furnace].
TEST(Microfacets, TheDensityOfVisibleNormalsIntegratesToOneOverTheSphere) {
    constexpr double kQuadrature = 2e-4;  // of narrow lobes near the horizon
    for (const double alpha : {0.3, 0.6, 1.0})
        for (const double degrees : {0.0, 45.0, 75.0}) {
            // Facets end where the half vector is horizontal, at z = −cos θ_o.
            const Vec3d view = viewAt(degrees);
            double sum = 0.0;
            for (const QuadratureNode& polar : gaussLegendre(200))
                for (int k = 0; k < 400; ++k) {
                    const double z = std::lerp(-view.z, 1.0, 0.5 * (1.0 + polar.position));
                    const double radius = std::sqrt(1.0 - z * z), phi = kPi * (k + 0.5) / 200.0;
                    const Vec3d incident(radius * std::cos(phi), radius * std::sin(phi), z);
                    sum += kPi / 400.0 * (1.0 + view.z) * polar.weight *
                           visibleNormalDensity(incident, view, alpha);
                }
            EXPECT_NEAR(sum, 1.0, kQuadrature) << alpha << " at " << degrees;
        }
}

}  // namespace
}  // namespace prt

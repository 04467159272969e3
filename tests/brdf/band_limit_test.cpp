#include "prt/brdf/band_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::makeGgx;

constexpr double kPi = std::numbers::pi;

/// Enough for what is not compared with a closed form.
constexpr LobeQuadratureOptions kCoarse{
    .polarNodeCount = 32, .azimuthNodeCount = 24, .viewNodeCount = 16};

TEST(BandLimit, OfALambertMatrixIsThatOfTheClampedCosineAndTheHemisphere) {
    constexpr double kRounding = 1e-6;  // √ of a difference of nearly equal sums
    const Brdf lambert{.lobes = {LambertLobe{Vec3d(0.8, 0.5, 0.2)}}};
    for (const int bandCount : {1, 2, 3, 5, 8}) {
        double cosine = 0.0, hemisphere = 0.0;
        for (const double c : clampedCosineZonal(bandCount))
            cosine += c * c;
        for (const double c : capZonal(bandCount, 0.5 * kPi))
            hemisphere += c * c;
        const BandLimitError error = measureBandLimitError(
            lambert, {.incidentBandCount = bandCount, .viewBandCount = bandCount});
        const double heldOfCosine = cosine / (2.0 * kPi / 3.0);
        EXPECT_NEAR(error.matrix, std::sqrt(1.0 - heldOfCosine * hemisphere / (2.0 * kPi)),
                    kRounding);
    }
}

/// ‖g − reconstruction‖ / ‖g‖ over all pairs of directions.
double measureSlowly(const Brdf& brdf, int bandCount) {
    const std::vector<double> matrix = expandBrdfMatrix(
        projectBrdf(brdf, {.incidentBandCount = bandCount, .viewBandCount = bandCount})[0]);
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const std::vector<SphereNode> nodes = sphereQuadrature(39);
    std::vector<std::vector<double>> basis(nodes.size(), std::vector<double>(count));
    for (std::size_t k = 0; k < nodes.size(); ++k)
        evaluateSh(nodes[k].direction, bandCount, basis[k]);
    double rest = 0.0, whole = 0.0;
    std::vector<double> row(count);
    for (std::size_t view = 0; view < nodes.size(); ++view) {
        for (std::size_t i = 0; i < count; ++i) {
            row[i] = 0.0;
            for (std::size_t j = 0; j < count; ++j)
                row[i] += matrix[i * count + j] * basis[view][j];
        }
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double g = evaluateBrdf(brdf, nodes[k].direction, nodes[view].direction).x *
                             std::max(nodes[k].direction.z, 0.0);
            double held = 0.0;
            for (std::size_t i = 0; i < count; ++i)
                held += row[i] * basis[k][i];
            const double weight = nodes[k].weight * nodes[view].weight;
            rest += weight * (g - held) * (g - held);
            whole += weight * g * g;
        }
    }
    return std::sqrt(rest / whole);
}

TEST(BandLimit, IsTheNormOfWhatReconstructionMisses) {
    constexpr double kSlowQuadrature = 1e-2;  // of both directions near the horizon
    const Brdf paint{
        .lobes = {LambertLobe{Vec3d(0.4)}, PhongLobe{.albedo = Vec3d(0.5), .exponent = 6.0}}};
    for (const Brdf& brdf : {paint, makeGgx(0.8)})
        for (const int bandCount : {2, 4})
            EXPECT_NEAR(measureBandLimitError(
                            brdf, {.incidentBandCount = bandCount, .viewBandCount = bandCount})
                            .matrix,
                        measureSlowly(brdf, bandCount), kSlowQuadrature);
}

/// The same above the horizon, of fitted coefficients.
double measureFittedSlowly(const Brdf& brdf, int bandCount) {
    const HorizonFit fit(bandCount);
    double rest = 0.0, whole = 0.0;
    for (const ViewNode& node : viewNodes({})) {
        std::vector<double> fitted = projectBrdfView(brdf, node.view, bandCount)[0];
        fit.apply(fitted);
        for (const SphereNode& incident : sphereQuadrature(79)) {
            if (incident.direction.z <= 0.0) continue;
            const double g =
                evaluateBrdf(brdf, incident.direction, node.view).x * incident.direction.z;
            const double held = reconstructSh(fitted, bandCount, incident.direction);
            const double weight = incident.weight * node.solidAngle;
            rest += weight * (g - held) * (g - held);
            whole += weight * g * g;
        }
    }
    return std::sqrt(rest / whole);
}

TEST(BandLimit, OfIncidentRadianceIsTheNormOfWhatTheFitMissesAboveTheHorizon) {
    constexpr double kSlowQuadrature = 2e-3;
    const Brdf paint{
        .lobes = {LambertLobe{Vec3d(0.4)}, PhongLobe{.albedo = Vec3d(0.5), .exponent = 6.0}}};
    for (const Brdf& brdf : {paint, makeGgx(0.8)})
        for (const int bandCount : {2, 5})
            EXPECT_NEAR(measureBandLimitError(brdf, {.incidentBandCount = bandCount}).incident,
                        measureFittedSlowly(brdf, bandCount), kSlowQuadrature);
}

TEST(BandLimit, MoreBandsNeverLoseMoreAndSmootherLobesMore) {
    // More bands of a fit may give so much away above the horizon for less below: of the cosine,
    // which two bands hold, and no other.
    constexpr double kBelow = 0.014;
    for (const auto& [name, brdf] : test::makeAllKinds()) {
        if (name == "measured") continue;
        BandLimitError last{.incident = 1.0, .matrix = 1.0};
        for (int bandCount = 1; bandCount <= 8; bandCount += bandCount < 3 ? 1 : 2) {
            const BandLimitError error =
                measureBandLimitError(brdf, {.incidentBandCount = bandCount,
                                             .viewBandCount = bandCount,
                                             .quadrature = kCoarse});
            EXPECT_LE(error.incident, last.incident + kBelow) << name << " " << bandCount;
            EXPECT_LE(error.matrix, last.matrix) << name << " " << bandCount;
            EXPECT_LE(error.incident, error.matrix) << name << " " << bandCount;
            last = error;
        }
    }
    double last = 1.0;
    for (const double roughness : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}) {
        const double incident =
            measureBandLimitError(makeGgx(roughness), {.quadrature = kCoarse}).incident;
        EXPECT_LT(incident, last);
        last = incident;
    }
}

TEST(BandLimit, TheLeastRoughnessHeldIsWhereTheErrorIsWhatWasAskedFor) {
    constexpr double kResolution = 5e-3;
    double last = 1.0;
    for (const int bandCount : {4, 6, 10}) {
        const std::optional<double> roughness = findLeastRoughnessHeld(bandCount, 0.25, kCoarse);
        ASSERT_TRUE(roughness);
        const BrdfProjectionOptions options{
            .incidentBandCount = bandCount, .viewBandCount = 1, .quadrature = kCoarse};
        EXPECT_NEAR(measureBandLimitError(makeGgx(*roughness), options).incident, 0.25,
                    kResolution);
        EXPECT_LT(*roughness, last);
        last = *roughness;
    }
    EXPECT_FALSE(findLeastRoughnessHeld(2, 0.1, kCoarse));
}

TEST(BandLimit, WhatIsSplitOffIsWhatLosesMoreThanTheErrorThatAllGoBy) {
    constexpr double kResolution = 2e-3;
    for (const int bandCount : {1, 2, 5, 9})
        EXPECT_NEAR(leastRoughnessHeld(bandCount),
                    findLeastRoughnessHeld(bandCount, kMostLobeError).value(), kResolution);
}

}  // namespace
}  // namespace prt

#include "prt/brdf/brdf_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::makeGgx;

constexpr double kPi = std::numbers::pi;

/// The default quadrature, beside the largest element, some ½.
constexpr double kQuadrature = 2.5e-4;

/// Nodes over the upper hemisphere that know nothing of lobes.
std::vector<SphereNode> upperNodes(int nodeCount) {
    std::vector<SphereNode> nodes;
    for (const QuadratureNode& polar : gaussLegendre(nodeCount))
        for (int k = 0; k < 2 * nodeCount; ++k) {
            const double z = 0.5 * (1.0 + polar.position), radius = std::sqrt(1.0 - z * z);
            const double phi = kPi * (k + 0.25) / nodeCount;
            nodes.push_back({Vec3d(radius * std::cos(phi), radius * std::sin(phi), z),
                             0.5 * kPi / nodeCount * polar.weight});
        }
    return nodes;
}

/// f_i of one view, channel 0.
std::vector<double> projectViewSlowly(const Brdf& brdf, const Vec3d& view, int bandCount,
                                      const std::vector<SphereNode>& nodes) {
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)), 0.0);
    std::vector<double> basis(coefficients.size());
    for (const SphereNode& node : nodes) {
        evaluateSh(node.direction, bandCount, basis);
        const double value =
            evaluateBrdf(brdf, node.direction, view).x * node.direction.z * node.weight;
        for (std::size_t i = 0; i < basis.size(); ++i)
            coefficients[i] += value * basis[i];
    }
    return coefficients;
}

/// All n_in² × n_out² elements by sums over pairs of directions, without any symmetry.
std::vector<double> projectSlowly(const Brdf& brdf, int incidentBandCount, int viewBandCount,
                                  int nodeCount) {
    const auto rows = static_cast<std::size_t>(shCoefficientCount(incidentBandCount));
    const auto columns = static_cast<std::size_t>(shCoefficientCount(viewBandCount));
    const std::vector<SphereNode> nodes = upperNodes(nodeCount);
    std::vector<double> matrix(rows * columns, 0.0), basis(columns);
    for (const SphereNode& node : upperNodes(nodeCount / 2)) {
        const auto seen = projectViewSlowly(brdf, node.direction, incidentBandCount, nodes);
        evaluateSh(node.direction, viewBandCount, basis);
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t j = 0; j < columns; ++j)
                matrix[i * columns + j] += node.weight * seen[i] * basis[j];
    }
    return matrix;
}

double largestDifference(std::span<const double> a, std::span<const double> b) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

TEST(BrdfMatrix, FiveBandsHaveFiftyFiveDifferentElementsAndEightyFiveInAll) {
    const BrdfMatrix matrix = projectBrdf(makeGgx(0.7))[0];
    EXPECT_EQ(matrix.values.size(), 55u);
    const std::vector<double> expanded = expandBrdfMatrix(matrix);
    EXPECT_EQ(expanded.size(), 625u);
    EXPECT_EQ(std::count_if(expanded.begin(), expanded.end(), [](double x) { return x != 0.0; }),
              85);
}

// (1/π) A_l √((2l+1)/4π), times the bands of the upper hemisphere.
TEST(BrdfMatrix, LambertIsAClampedCosineTimesAHemisphereOfViews) {
    constexpr double kRounding = 1e-12;
    const Vec3d albedo(0.8, 0.5, 0.2);
    const auto matrices =
        projectBrdf({.lobes = {LambertLobe{albedo}}}, {.incidentBandCount = 6, .viewBandCount = 4});
    const std::vector<double> cosine = clampedCosineZonal(6), hemisphere = capZonal(4, 0.5 * kPi);
    for (int channel = 0; channel < 3; ++channel) {
        const std::vector<double> actual =
            expandBrdfMatrix(matrices[static_cast<std::size_t>(channel)]);
        std::vector<double> expected(36 * 16, 0.0);
        for (int l = 0; l < 6; ++l)
            for (int k = 0; k < 4; ++k)
                expected[static_cast<std::size_t>(shIndex(l, 0) * 16 + shIndex(k, 0))] =
                    albedo[channel] / kPi * cosine[static_cast<std::size_t>(l)] *
                    hemisphere[static_cast<std::size_t>(k)];
        EXPECT_LT(largestDifference(actual, expected), kRounding);
    }
}

// Both mirror the view: y_lm(−x, −y, z) = (−1)^m y_lm. Phong's lobe reflects cos θ_o then, GGX all.
TEST(BrdfMatrix, NarrowLobesAreMirrors) {
    constexpr int kBandCount = 5;
    constexpr double kLobeWidth = 1e-3;  // l² / s, and the horizon's share of views
    const std::vector<QuadratureNode> rule = gaussLegendre(64);
    const auto compare = [&](const Brdf& brdf, int cosinePower) {
        const BrdfMatrix matrix = projectBrdf(brdf)[0];
        std::vector<double> basis(25);
        int checkCount = 0;
        for (int m = 0; m < kBandCount; ++m)
            for (int l = m; l < kBandCount; ++l)
                for (int k = m; k < kBandCount; ++k, ++checkCount) {
                    double expected = 0.0;
                    for (const QuadratureNode& node : rule) {
                        const double z = 0.5 * (1.0 + node.position);
                        evaluateSh(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), kBandCount, basis);
                        // y_lm y_km over azimuths: √2 cos mφ twice, or none.
                        expected += (m == 0 ? 1.0 : 0.5) * kPi * node.weight *
                                    std::pow(z, cosinePower) *
                                    basis[static_cast<std::size_t>(shIndex(l, m))] *
                                    basis[static_cast<std::size_t>(shIndex(k, m))];
                    }
                    EXPECT_NEAR(matrix.values[brdfMatrixIndex(matrix, l, k, m)],
                                m % 2 == 0 ? expected : -expected, kLobeWidth)
                        << l << ", " << k << ", " << m;
                }
        EXPECT_EQ(checkCount, 55);
    };
    compare({.lobes = {PhongLobe{.albedo = Vec3d(1.0), .exponent = 1e5}}}, 1);
    compare(makeGgx(0.0), 0);
}

TEST(BrdfMatrix, IsTheDoubleIntegralWithoutAnySymmetry) {
    constexpr double kSlowQuadrature = 5e-4;
    const Brdf paint{
        .lobes = {LambertLobe{Vec3d(0.4)}, PhongLobe{.albedo = Vec3d(0.5), .exponent = 3.0}}};
    for (const Brdf& brdf :
         {paint, makeGgx(0.8), makeGltfBrdf(Vec3f(0.7f), {.metallic = 0.25f, .roughness = 0.9f})}) {
        const BrdfMatrix matrix =
            projectBrdf(brdf, {.incidentBandCount = 4, .viewBandCount = 3})[0];
        EXPECT_LT(largestDifference(expandBrdfMatrix(matrix), projectSlowly(brdf, 4, 3, 32)),
                  kSlowQuadrature);
    }
}

TEST(BrdfMatrix, QuadratureResolvesLobesOfAnyWidth) {
    constexpr LobeQuadratureOptions kFine{
        .polarNodeCount = 160, .azimuthNodeCount = 40, .viewNodeCount = 28};
    for (const double roughness : {0.0, 0.2, 0.4, 1.0}) {
        const auto usual =
            projectBrdf(makeGgx(roughness), {.incidentBandCount = 6, .viewBandCount = 6});
        const auto fine = projectBrdf(
            makeGgx(roughness), {.incidentBandCount = 6, .viewBandCount = 6, .quadrature = kFine});
        EXPECT_LT(largestDifference(usual[0].values, fine[0].values), kQuadrature) << roughness;
    }
}

TEST(BrdfMatrix, AViewIsTheIntegralOverIncidentDirections) {
    RandomStream random(3, 0);
    const std::vector<SphereNode> nodes = upperNodes(200);
    for (const auto& [name, brdf] : test::makeAllKinds()) {
        const Vec3d view = test::drawUpward(random);
        const double tolerance = name == "measured" ? 4e-3 : 5e-4;  // a table has steps
        EXPECT_LT(largestDifference(projectBrdfView(brdf, view, 5)[0],
                                    projectViewSlowly(brdf, view, 5, nodes)),
                  tolerance)
            << name << " " << view;
    }
}

TEST(BrdfMatrix, AViewAtAzimuthZeroNeedsHalfTheNodes) {
    struct Azimuths {
        int count;
        double tolerance;
    };
    // Of quarters that are not whole, the nodes lie elsewhere, and the horizon cuts between them.
    for (const auto& [count, tolerance] : {Azimuths{16, 1e-12}, Azimuths{18, 3e-3}})
        for (const double degrees : {0.0, 20.0, 60.0})
            for (const auto& [name, brdf] : test::makeAllKinds()) {
                const Vec3d view = test::viewAt(degrees);
                const LobeQuadratureOptions options{.polarNodeCount = 32,
                                                    .azimuthNodeCount = count};
                const auto all = projectBrdfView(brdf, view, 4, options);
                const auto upright = projectUprightView(brdf, view, 4, options);
                for (std::size_t channel = 0; channel < 3; ++channel)
                    for (int i = 0; i < shCoefficientCount(4); ++i) {
                        const auto k = static_cast<std::size_t>(i);
                        const bool isUpright = i >= shIndex(shDegree(i), 0);
                        EXPECT_NEAR(upright[channel][k], isUpright ? all[channel][k] : 0.0,
                                    tolerance)
                            << name << " at " << degrees << ", number " << i;
                    }
            }
    const BrdfLobe lobe = makeGgx(0.5).lobes[0];
    const Vec3d view = test::viewAt(60.0);
    EXPECT_EQ(2 * uprightLobeNodes(lobe, view, {}).size(), lobeNodes(lobe, view, {}).size());
}

TEST(BrdfMatrix, AMeasuredBrdfHasTheMatrixOfWhatWasMeasured) {
    constexpr double kCells = 4e-3;
    const auto measured = projectBrdf(test::measuredPlastic());
    const auto plastic = projectBrdf(makeGltfBrdf(Vec3f(0.6f, 0.3f, 0.1f), {.roughness = 0.5f}));
    for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_LT(largestDifference(measured[channel].values, plastic[channel].values), kCells);
}

TEST(BrdfMatrix, ApplyingItIsTheProductWithAllElements) {
    constexpr double kRounding = 1e-13;
    const BrdfMatrix matrix =
        projectBrdf(makeGgx(0.5), {.incidentBandCount = 4, .viewBandCount = 6})[0];
    const std::vector<double> expanded = expandBrdfMatrix(matrix);
    RandomStream random(4, 0);
    std::vector<double> incident(16), exit(36), expected(36, 0.0);
    for (double& coefficient : incident)
        coefficient = random.nextUnitDouble() - 0.5;
    applyBrdfMatrix(matrix, incident, exit);
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 36; ++j)
            expected[j] += incident[i] * expanded[i * 36 + j];
    EXPECT_LT(largestDifference(exit, expected), kRounding);
}

}  // namespace
}  // namespace prt

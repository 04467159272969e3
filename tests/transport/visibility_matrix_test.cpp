#include "prt/transport/visibility_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/basis/sh_rotation.h"
#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"
#include "prt/math/transform.h"
#include "tests/support/transfer_matrix_checks.h"

namespace prt {
namespace {

using test::BandCounts;
using test::intoLocalFrame;
using test::isPositiveDefinite;

// Sums of some dozen products of numbers of about 1, in float.
constexpr double kFloatTolerance = 5e-6;

const std::vector<BandCounts> kBandCounts = {{1, 1}, {5, 5}, {3, 5}, {5, 2}, {6, 5}, {1, 10}};
const std::vector<Vec3f> kNormals = {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(1, 0, 0),
                                     Vec3f(0.6f, -0.64f, 0.48f), Vec3f(-0.48f, 0.6f, -0.64f)};

std::vector<float> toFloats(const std::vector<double>& numbers) {
    return {numbers.begin(), numbers.end()};
}

std::vector<float> makeMatrix(const VisibilityMatrix& maker, const std::vector<double>& visibility,
                              const Vec3f& normal) {
    std::vector<float> scratch(maker.elementCount());
    std::vector<float> matrix(maker.elementCount());
    maker.make(toFloats(visibility), normal, scratch, matrix);
    return matrix;
}

/// v_k of a sum of weights over directions.
std::vector<double> projectVisibility(const std::vector<SphereNode>& visible, int bandCount) {
    std::vector<double> basis(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    std::vector<double> sums(basis.size());
    for (const SphereNode& node : visible) {
        evaluateSh(node.direction, bandCount, basis);
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += node.weight * basis[k];
    }
    return sums;
}

/// Σ w y_i(R ω) y_j(ω), as [i][j].
void expectSumOverDirections(const std::vector<float>& matrix, const BandCounts& bands,
                             const Vec3f& normal, const std::vector<SphereNode>& visible) {
    const std::vector<double> expected = test::sumMatrix(visible, bands, normal);
    ASSERT_EQ(matrix.size(), expected.size());
    for (std::size_t e = 0; e < expected.size(); ++e)
        EXPECT_NEAR(matrix[e], expected[e], kFloatTolerance)
            << "element " << e << " of " << bands.incident << " × " << bands.light << " bands";
}

Vec3d drawDirection(RandomStream& random) {
    const double z = 2.0 * random.nextUnitDouble() - 1.0;
    const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

TEST(VisibilityMatrix, OfAFreePointTurnsLightIntoTheLocalFrame) {  // T-25
    RandomStream random(1, 0);
    for (const BandCounts& bands : kBandCounts) {
        const VisibilityMatrix maker(bands.incident, bands.light);
        for (const Vec3f& normal : kNormals) {
            const int visibilityBands = maker.visibilityBandCount();
            std::vector<double> everywhere(
                static_cast<std::size_t>(shCoefficientCount(visibilityBands)));
            everywhere[0] = std::sqrt(4.0 * std::numbers::pi);
            const std::vector<float> matrix = makeMatrix(maker, everywhere, normal);
            // Light from one direction comes from that direction, as far as both have bands.
            const Vec3d direction = drawDirection(random);
            std::vector<double> light(bands.columnCount());
            std::vector<double> incident(bands.rowCount());
            evaluateSh(direction, bands.light, light);
            evaluateSh(intoLocalFrame(direction, normal), bands.incident, incident);
            for (std::size_t i = 0; i < incident.size(); ++i) {
                double sum = 0.0;
                for (std::size_t j = 0; j < light.size(); ++j)
                    sum += static_cast<double>(matrix[i * light.size() + j]) * light[j];
                EXPECT_NEAR(sum, i < light.size() ? incident[i] : 0.0, kFloatTolerance)
                    << "row " << i;
            }
        }
    }
}

TEST(VisibilityMatrix, OfAnOpenPlaneIntegratesOverTheHemisphere) {
    for (const BandCounts& bands : kBandCounts) {
        const VisibilityMatrix maker(bands.incident, bands.light);
        for (const Vec3f& normal : kNormals) {
            const int visibilityBands = maker.visibilityBandCount();
            std::vector<double> visibility(
                static_cast<std::size_t>(shCoefficientCount(visibilityBands)));
            rotateZonal(capZonal(visibilityBands, std::numbers::pi / 2.0),
                        Vec3d(normal).normalized(), visibility);
            expectSumOverDirections(makeMatrix(maker, visibility, normal), bands, normal,
                                    test::hemisphereQuadrature(normal, 20));
        }
    }
}

TEST(VisibilityMatrix, IsExactForAnySumOverDirections) {
    RandomStream random(2, 0);
    for (const BandCounts& bands : kBandCounts) {
        const VisibilityMatrix maker(bands.incident, bands.light);
        std::vector<SphereNode> visible;
        for (int i = 0; i < 37; ++i)
            visible.push_back({drawDirection(random), 0.1 * random.nextUnitDouble()});
        const Vec3f normal(drawDirection(random));
        const std::vector<double> visibility =
            projectVisibility(visible, maker.visibilityBandCount());
        expectSumOverDirections(makeMatrix(maker, visibility, normal), bands, normal, visible);
    }
}

TEST(VisibilityMatrix, IsSymmetricInTheWorldAndNeverAddsLight) {  // T-25
    RandomStream random(3, 0);
    const VisibilityMatrix maker(5, 5);
    for (int trial = 0; trial < 10; ++trial) {
        // Some nodes of a rule that knows the identity: the rest would be the rest of it.
        std::vector<SphereNode> visible;
        for (const SphereNode& node : sphereQuadrature(8))
            if (random.nextBits() % 3 != 0) visible.push_back(node);
        // The frame of +z is the world's.
        const std::vector<float> matrix =
            makeMatrix(maker, projectVisibility(visible, 9), Vec3f(0, 0, 1));
        for (std::size_t i = 0; i < 25; ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_NEAR(matrix[25 * i + j], matrix[25 * j + i], kFloatTolerance);
        EXPECT_TRUE(isPositiveDefinite(matrix, 1.0, 1e-4)) << "an eigenvalue below 0";
        EXPECT_TRUE(isPositiveDefinite(matrix, -1.0, 1.0 + 1e-4)) << "an eigenvalue above 1";
        EXPECT_FALSE(isPositiveDefinite(matrix, -1.0, 0.5)) << "none above a half";
    }
}

TEST(VisibilityMatrix, TurnsWithTheWorld) {
    RandomStream random(4, 0);
    constexpr BandCounts kBands = {5, 4};
    const VisibilityMatrix maker(5, 4);
    std::vector<double> visibility(64);
    std::vector<double> light(16);
    for (double& number : visibility)
        number = random.nextUnitDouble() - 0.5;
    for (double& number : light)
        number = random.nextUnitDouble() - 0.5;
    const Mat3d turn = rotationX(0.3) * rotationY(1.1) * rotationZ(-0.7);
    std::vector<double> turnedVisibility(64);
    std::vector<double> turnedLight(16);
    rotateSh(turn, 8, visibility, turnedVisibility);
    rotateSh(turn, 4, light, turnedLight);
    for (const Vec3f& normal : kNormals) {
        const std::vector<float> matrix = makeMatrix(maker, visibility, normal);
        const Vec3f turnedNormal = turn * normal;
        const std::vector<float> turned = makeMatrix(maker, turnedVisibility, turnedNormal);
        const Vec3d direction = drawDirection(random);
        EXPECT_NEAR(
            test::incidentRadiance(turned, kBands, turnedLight,
                                   intoLocalFrame(turn * direction, turnedNormal)),
            test::incidentRadiance(matrix, kBands, light, intoLocalFrame(direction, normal)),
            2.0 * kFloatTolerance);
    }
}

}  // namespace
}  // namespace prt

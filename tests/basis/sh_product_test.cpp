#include "prt/basis/sh_product.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh_rotation.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kTolerance = 1e-12;

std::vector<double> randomFunction(int bandCount, std::uint64_t stream) {
    RandomStream random(4, stream);
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    for (double& coefficient : coefficients)
        coefficient = 2.0 * random.nextUnitDouble() - 1.0;
    return coefficients;
}

std::vector<double> multiply(const ShTripling& tripling, const std::vector<double>& a,
                             const std::vector<double>& b) {
    std::vector<double> product(a.size());
    tripling.multiply(a, b, product);
    return product;
}

void expectNear(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], kTolerance) << "coefficient " << i;
}

/// How many orders a triple has.
std::size_t countOrders(const ShTriple& triple) {
    const std::size_t different = std::set<int>{triple.i, triple.j, triple.k}.size();
    return different == 3 ? 6 : different == 2 ? 3 : 1;
}

// Counts that were made with exact arithmetic; tables elsewhere list rounding errors as well.
TEST(ShTripling, HasAsManyTriplesAsThereAre) {
    constexpr std::array<std::size_t, 5> kUnordered = {4, 25, 77, 238, 549};
    constexpr std::array<std::size_t, 5> kOrdered = {10, 83, 353, 1158, 2907};
    for (std::size_t i = 0; i < 5; ++i) {
        const ShTripling tripling(static_cast<int>(i) + 2);
        EXPECT_EQ(tripling.triples().size(), kUnordered[i]);
        std::size_t ordered = 0;
        for (const ShTriple& triple : tripling.triples())
            ordered += countOrders(triple);
        EXPECT_EQ(ordered, kOrdered[i]);
    }
}

// Far from zero or zero: nothing lies between, at any band count.
TEST(ShTripling, NoIntegralIsDoubtful) {
    const ShTripling tripling(kMaxBandCount);
    for (const ShTriple& triple : tripling.triples())
        ASSERT_GT(std::abs(triple.integral), 1e-4)
            << triple.i << " " << triple.j << " " << triple.k;
}

TEST(ShTripling, IntegralsOfThreeBandsAreTheKnownOnes) {
    struct Known {
        int i, j, k;
        double integral;
    };
    constexpr std::array<Known, 16> kKnown = {{{1, 1, 6, -0.12615663},
                                               {1, 1, 8, -0.21850969},
                                               {1, 2, 5, 0.21850969},
                                               {1, 3, 4, 0.21850969},
                                               {2, 3, 7, 0.21850969},
                                               {2, 2, 6, 0.25231325},
                                               {3, 3, 6, -0.12615663},
                                               {3, 3, 8, 0.21850969},
                                               {4, 4, 6, -0.18022375},
                                               {4, 5, 7, 0.15607835},
                                               {5, 5, 6, 0.09011188},
                                               {5, 5, 8, -0.15607835},
                                               {6, 6, 6, 0.18022375},
                                               {6, 7, 7, 0.09011188},
                                               {6, 8, 8, -0.18022375},
                                               {7, 7, 8, 0.15607835}}};
    std::size_t found = 0;
    const ShTripling tripling(3);
    for (const ShTriple& triple : tripling.triples()) {
        if (triple.i == 0) {
            EXPECT_EQ(triple.j, triple.k);
            EXPECT_NEAR(triple.integral, 0.28209479, 5e-9);
            continue;
        }
        for (const Known& known : kKnown)
            if (triple.i == known.i && triple.j == known.j && triple.k == known.k) {
                EXPECT_NEAR(triple.integral, known.integral, 5e-9);
                ++found;
            }
    }
    EXPECT_EQ(found, kKnown.size());
}

// The product of both functions, direction by direction, projected.
TEST(ShTripling, ProductsAreThoseOfTheFunctions) {
    for (const int bandCount : {1, 2, 5, 7}) {
        const std::vector<double> a = randomFunction(bandCount, 1);
        const std::vector<double> b = randomFunction(bandCount, 2);
        std::vector<double> expected(a.size());
        std::vector<double> basis(a.size());
        for (const SphereNode& node : sphereQuadrature(3 * bandCount)) {
            evaluateSh(node.direction, bandCount, basis);
            const double value = reconstructSh(a, bandCount, node.direction) *
                                 reconstructSh(b, bandCount, node.direction);
            for (std::size_t i = 0; i < expected.size(); ++i)
                expected[i] += node.weight * value * basis[i];
        }
        expectNear(multiply(ShTripling(bandCount), a, b), expected);
    }
}

TEST(ShTripling, OneChangesNothingAndOrderDoesNotMatter) {
    const ShTripling tripling(kMaxBandCount);
    const std::vector<double> a = randomFunction(kMaxBandCount, 3);
    const std::vector<double> b = randomFunction(kMaxBandCount, 4);
    std::vector<double> one(a.size());
    one[0] = std::sqrt(4.0 * std::numbers::pi);
    expectNear(multiply(tripling, a, one), a);
    expectNear(multiply(tripling, a, b), multiply(tripling, b, a));
}

TEST(ShTripling, ProductsTurnWithTheirFactors) {
    const ShTripling tripling(6);
    const ShRotation rotation(rotationAbout(Vec3d(0.36, 0.48, 0.8), 2.1), 6);
    const auto turn = [&](const std::vector<double>& source) {
        std::vector<double> rotated(source.size());
        rotation.apply(source, rotated);
        return rotated;
    };
    const std::vector<double> a = randomFunction(6, 5);
    const std::vector<double> b = randomFunction(6, 6);
    expectNear(turn(multiply(tripling, a, b)), multiply(tripling, turn(a), turn(b)));
}

TEST(ShTripling, TheMatrixOfAFunctionMultipliesByIt) {
    const ShTripling tripling(5);
    const std::vector<double> a = randomFunction(5, 7);
    const std::vector<double> b = randomFunction(5, 8);
    const std::vector<double> matrix = tripling.makeProductMatrix(a);
    std::vector<double> product(b.size());
    for (std::size_t row = 0; row < b.size(); ++row)
        for (std::size_t column = 0; column < b.size(); ++column) {
            EXPECT_EQ(matrix[row * b.size() + column], matrix[column * b.size() + row]);
            product[row] += matrix[row * b.size() + column] * b[column];
        }
    expectNear(product, multiply(tripling, a, b));
}

}  // namespace
}  // namespace prt

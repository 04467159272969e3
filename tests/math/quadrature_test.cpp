#include "prt/math/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace prt {
namespace {

constexpr double kRounding = 1e-14;

TEST(GaussLegendre, IsExactForPolynomialsOfTwiceItsNodes) {
    for (int nodeCount = 1; nodeCount <= 40; ++nodeCount) {
        const auto nodes = gaussLegendre(nodeCount);
        ASSERT_EQ(nodes.size(), static_cast<std::size_t>(nodeCount));
        for (int power = 0; power <= 2 * nodeCount - 1; ++power) {
            double sum = 0.0;
            for (const QuadratureNode& node : nodes)
                sum += node.weight * std::pow(node.position, power);
            EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, kRounding)
                << nodeCount << " nodes, power " << power;
        }
    }
}

TEST(GaussLegendre, TheTwoPointRuleIsTheTextbookOne) {
    const auto nodes = gaussLegendre(2);
    EXPECT_NEAR(nodes[0].position, -1.0 / std::sqrt(3.0), kRounding);
    EXPECT_NEAR(nodes[1].position, 1.0 / std::sqrt(3.0), kRounding);
    EXPECT_NEAR(nodes[0].weight, 1.0, kRounding);
}

/// (k − 1)!! of an even power k, the moments' factor.
double doubleFactorial(int k) {
    return k <= 1 ? 1.0 : k * doubleFactorial(k - 2);
}

/// ∫ x^a y^b z^c over the sphere, in closed form [Folland01].
double sphereMoment(int a, int b, int c) {
    if (a % 2 != 0 || b % 2 != 0 || c % 2 != 0) return 0.0;
    return 4.0 * std::numbers::pi * doubleFactorial(a - 1) * doubleFactorial(b - 1) *
           doubleFactorial(c - 1) / doubleFactorial(a + b + c + 1);
}

TEST(SphereQuadrature, IsExactForMonomialsOfItsDegree) {
    for (int degree = 0; degree <= 9; ++degree) {
        const auto nodes = sphereQuadrature(degree);
        for (int a = 0; a <= degree; ++a) {
            for (int b = 0; a + b <= degree; ++b) {
                for (int c = 0; a + b + c <= degree; ++c) {
                    double sum = 0.0;
                    for (const auto& [direction, weight] : nodes) {
                        sum += weight * std::pow(direction.x, a) * std::pow(direction.y, b) *
                               std::pow(direction.z, c);
                    }
                    EXPECT_NEAR(sum, sphereMoment(a, b, c), 4.0 * kRounding)
                        << "degree " << degree << ": x^" << a << " y^" << b << " z^" << c;
                }
            }
        }
    }
}

}  // namespace
}  // namespace prt

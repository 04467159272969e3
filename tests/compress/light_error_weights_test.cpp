#include "prt/compress/light_error_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/basis/sh_rotation.h"
#include "prt/math/quadrature.h"
#include "prt/math/transform.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

std::vector<double> drawCoefficients(int bandCount, RandomStream& random) {
    std::vector<double> coefficients;
    for (int i = 0; i < shCoefficientCount(bandCount); ++i)
        coefficients.push_back(drawNormal(random));
    return coefficients;
}

/// The mean of (Σ_i e_i (R L)_i)² over all rotations, by a rule that is exact for such squares.
double averageOverRotations(const std::vector<double>& error, const std::vector<double>& light,
                            int bandCount) {
    const int turnCount = 4 * bandCount;
    double sum = 0.0, weights = 0.0;
    for (const QuadratureNode& node : gaussLegendre(2 * bandCount)) {
        for (int i = 0; i < turnCount * turnCount; ++i) {
            const double step = 2.0 * std::numbers::pi / turnCount;
            const Mat3d rotation = rotationZ(step * (i / turnCount)) *
                                   rotationY(std::acos(node.position)) *
                                   rotationZ(step * (i % turnCount));
            std::vector<double> turned(light.size());
            rotateSh(rotation, bandCount, std::span(light), std::span(turned));
            double radiance = 0.0;
            for (std::size_t k = 0; k < error.size(); ++k)
                radiance += error[k] * turned[k];
            sum += node.weight * radiance * radiance;
            weights += node.weight;
        }
    }
    return sum / weights;
}

TEST(LightErrorWeights, GiveTheMeanSquareOfTheRadianceUnderTheLightTurnedAtRandom) {
    constexpr double kTolerance = 1e-6;  // of the square: weights are floats
    for (const int bandCount : {1, 2, 4}) {
        RandomStream random(3, static_cast<std::uint64_t>(bandCount));
        const auto error = drawCoefficients(bandCount, random);
        std::vector<Vec3d> light;
        std::vector<std::vector<double>> channels;
        for (int channel = 0; channel < 3; ++channel)
            channels.push_back(drawCoefficients(bandCount, random));
        for (std::size_t i = 0; i < error.size(); ++i)
            light.emplace_back(channels[0][i], channels[1][i], channels[2][i]);

        const auto three = lightErrorWeights(light, bandCount, 3);
        const auto one = lightErrorWeights(light, bandCount, 1);
        ASSERT_EQ(three.size(), 3 * error.size());
        ASSERT_EQ(one.size(), error.size());
        double meanOfChannels = 0.0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double expected = averageOverRotations(error, channels[channel], bandCount);
            double sum = 0.0;
            for (std::size_t i = 0; i < error.size(); ++i)
                sum += std::pow(three[channel * error.size() + i] * error[i], 2.0);
            EXPECT_NEAR(sum, expected, kTolerance * expected);
            meanOfChannels += expected / 3.0;
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < error.size(); ++i)
            sum += std::pow(one[i] * error[i], 2.0);
        EXPECT_NEAR(sum, meanOfChannels, kTolerance * meanOfChannels);
    }
}

TEST(LightErrorWeights, BandsWithoutLightKeepAThousandthOfTheLargestWeight) {
    const std::vector<Vec3d> light = {Vec3d(2.0, 2.0, 2.0)};
    const auto weights = lightErrorWeights(light, 2, 1);
    EXPECT_FLOAT_EQ(weights[0], 2.0f);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_FLOAT_EQ(weights[i], 0.002f);
}

}  // namespace
}  // namespace prt

#include "prt/basis/haar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prt/base/random.h"

namespace prt {
namespace {

// Sums of up to 256² floats of size 1, in trees of 16 levels.
constexpr float kRounding = 2e-6f;

std::vector<float> randomValues(std::size_t count, std::uint64_t stream) {
    RandomStream random(7, stream);
    std::vector<float> values(count);
    for (float& value : values)
        value = 2.0f * random.nextUnitFloat() - 1.0f;
    return values;
}

/// ψ at a texel, from its definition.
double evaluate(const HaarFunction& function, int side, int x, int y) {
    const int square = side >> function.level;
    if (function.type == HaarType::scaling) return 1.0 / side;
    if (x / square != function.x || y / square != function.y) return 0.0;
    const bool right = x % square >= square / 2, bottom = y % square >= square / 2;
    const double size = static_cast<double>(1 << function.level) / side;
    switch (function.type) {
        case HaarType::horizontal:
            return right ? -size : size;
        case HaarType::vertical:
            return bottom ? -size : size;
        default:
            return right != bottom ? -size : size;
    }
}

std::size_t countOf(int side) {
    return static_cast<std::size_t>(side * side);
}

double energy(std::span<const float> values) {
    double sum = 0.0;
    for (const float value : values)
        sum += static_cast<double>(value) * value;
    return sum;
}

TEST(HaarIndex, CountsCoarseBeforeFineAndTypeByType) {
    EXPECT_EQ(haarIndex({}), 0);
    EXPECT_EQ(haarIndex({HaarType::horizontal, 0, 0, 0}), 1);
    EXPECT_EQ(haarIndex({HaarType::diagonal, 0, 0, 0}), 3);
    EXPECT_EQ(haarIndex({HaarType::horizontal, 1, 0, 0}), 4);
    EXPECT_EQ(haarIndex({HaarType::vertical, 1, 1, 0}), 9);
    EXPECT_EQ(haarIndex({HaarType::vertical, 3, 5, 2}), 2 * 64 + 2 * 8 + 5);

    int index = 1;
    for (int level = 0; level < 4; ++level)
        for (const HaarType type : {HaarType::horizontal, HaarType::vertical, HaarType::diagonal})
            for (int y = 0; y < 1 << level; ++y)
                for (int x = 0; x < 1 << level; ++x, ++index) {
                    EXPECT_EQ(haarIndex({type, level, x, y}), index);
                    const HaarFunction function = haarFunction(index);
                    EXPECT_EQ(function.type, type);
                    EXPECT_EQ(function.level, level);
                    EXPECT_EQ(function.x, x);
                    EXPECT_EQ(function.y, y);
                }
    EXPECT_EQ(index, 256);
    EXPECT_EQ(haarFunction(0).type, HaarType::scaling);
}

TEST(HaarIndex, KnowsSquaresWhoseSideIsAPowerOfTwo) {
    for (const std::size_t count : {1u, 4u, 16u, 65536u})
        EXPECT_TRUE(isHaarCount(count)) << count;
    for (const std::size_t count : {0u, 2u, 8u, 9u, 32u, 36u})
        EXPECT_FALSE(isHaarCount(count)) << count;
}

// The wavelets that reconstruction draws are those of the definition, and these are orthonormal.
TEST(Haar, FunctionsAreTheDefinedOnesAndOrthonormal) {
    for (const int side : {2, 4, 8}) {
        const std::size_t count = countOf(side);
        std::vector<std::vector<float>> functions(count, std::vector<float>(count));
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<float> unit(count, 0.0f);
            unit[i] = 1.0f;
            reconstructHaar(unit, functions[i]);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    ASSERT_EQ(functions[i][static_cast<std::size_t>(y * side + x)],
                              evaluate(haarFunction(static_cast<int>(i)), side, x, y))
                        << "function " << i << " of " << side << "² at " << x << ", " << y;
        }
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j) {
                double product = 0.0;
                for (std::size_t t = 0; t < count; ++t)
                    product += static_cast<double>(functions[i][t]) * functions[j][t];
                ASSERT_EQ(product, i == j ? 1.0 : 0.0) << i << ", " << j;  // powers of two: exact
            }
    }
}

TEST(Haar, CoefficientsAreSumsAgainstTheFunctions) {
    for (const int side : {2, 8, 16}) {
        const std::vector<float> texels = randomValues(countOf(side), 1);
        std::vector<float> coefficients(texels.size());
        projectHaar(texels, coefficients);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            double sum = 0.0;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    sum += static_cast<double>(texels[static_cast<std::size_t>(y * side + x)]) *
                           evaluate(haarFunction(static_cast<int>(i)), side, x, y);
            ASSERT_NEAR(coefficients[i], sum, kRounding) << "coefficient " << i << " of " << side;
        }
    }
}

TEST(Haar, EnergyIsKeptAndTheWayBackIsExact) {
    for (const int side : {1, 2, 4, 32, 256}) {
        const std::vector<float> texels = randomValues(countOf(side), 2);
        std::vector<float> coefficients(texels.size()), back(texels.size());
        projectHaar(texels, coefficients);
        EXPECT_NEAR(energy(coefficients) / energy(texels), 1.0, kRounding) << side;
        reconstructHaar(coefficients, back);
        for (std::size_t t = 0; t < texels.size(); ++t)
            ASSERT_NEAR(back[t], texels[t], kRounding) << side;
    }
}

// Integers of few bits are transformed without any rounding.
TEST(Haar, SmallIntegersComeBackBitForBit) {
    std::vector<float> texels = randomValues(countOf(64), 3);
    for (float& texel : texels)
        texel = std::round(100.0f * texel);
    std::vector<float> coefficients(texels.size()), back(texels.size());
    projectHaar(texels, coefficients);
    reconstructHaar(coefficients, back);
    EXPECT_EQ(back, texels);
}

TEST(Haar, AConstantIsItsScalingFunctionAlone) {
    const std::vector<float> texels(countOf(16), 3.0f);
    std::vector<float> coefficients(texels.size());
    projectHaar(texels, coefficients);
    EXPECT_EQ(coefficients[0], 3.0f * 16.0f);
    for (std::size_t i = 1; i < coefficients.size(); ++i)
        ASSERT_EQ(coefficients[i], 0.0f) << i;
}

TEST(Haar, OneTexelIsItsOwnCoefficient) {
    const std::vector<float> texel = {0.7f};
    std::vector<float> coefficient(1), back(1);
    projectHaar(texel, coefficient);
    EXPECT_EQ(coefficient, texel);
    reconstructHaar(coefficient, back);
    EXPECT_EQ(back, texel);
}

TEST(Haar, ChannelsAreTransformedAlike) {
    std::vector<std::vector<float>> channels;
    std::vector<Vec3f> texels(countOf(32)), coefficients(texels.size()), back(texels.size());
    for (int channel = 0; channel < 3; ++channel) {
        channels.push_back(randomValues(texels.size(), 10 + static_cast<std::uint64_t>(channel)));
        for (std::size_t t = 0; t < texels.size(); ++t)
            texels[t][channel] = channels.back()[t];
    }
    projectHaar(texels, coefficients);
    reconstructHaar(coefficients, back);
    std::vector<float> single(texels.size()), singleBack(texels.size());
    for (int channel = 0; channel < 3; ++channel) {
        projectHaar(channels[static_cast<std::size_t>(channel)], single);
        reconstructHaar(single, singleBack);
        for (std::size_t i = 0; i < single.size(); ++i) {
            ASSERT_EQ(coefficients[i][channel], single[i]) << i;
            ASSERT_EQ(back[i][channel], singleBack[i]) << i;
        }
    }
}

TEST(HaarDeathTest, OtherSquaresAreRefused) {
    for (const std::size_t count : {0u, 8u, 9u}) {
        const std::vector<float> texels(count);
        std::vector<float> coefficients(count);
        EXPECT_DEATH(projectHaar(texels, coefficients), "the side of the square is a power of two");
        EXPECT_DEATH(reconstructHaar(texels, coefficients),
                     "the side of the square is a power of two");
    }
    const std::vector<float> texels(16);
    std::vector<float> coefficients(4);
    EXPECT_DEATH(projectHaar(texels, coefficients), "as many coefficients as texels");
}

}  // namespace
}  // namespace prt

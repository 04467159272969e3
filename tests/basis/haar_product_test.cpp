#include "prt/basis/haar_product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prt/base/random.h"

namespace prt {
namespace {

// Values of size 1 at 256 texels, added up in trees of 8 levels of floats.
constexpr float kRounding = 2e-6f;

std::vector<float> randomCoefficients(int side, std::uint64_t stream) {
    RandomStream random(8, stream);
    std::vector<float> coefficients(static_cast<std::size_t>(side * side));
    for (float& coefficient : coefficients)
        coefficient = 2.0f * random.nextUnitFloat() - 1.0f;
    return coefficients;
}

std::vector<float> reconstruct(std::span<const float> coefficients) {
    std::vector<float> texels(coefficients.size());
    reconstructHaar(coefficients, texels);
    return texels;
}

/// Every function of the basis, drawn; powers of two, so that sums of their products are exact.
std::vector<std::vector<float>> drawBasis(int side) {
    std::vector<std::vector<float>> functions;
    for (int i = 0; i < side * side; ++i) {
        std::vector<float> unit(static_cast<std::size_t>(side * side), 0.0f);
        unit[static_cast<std::size_t>(i)] = 1.0f;
        functions.push_back(reconstruct(unit));
    }
    return functions;
}

struct Counts {
    int ordered = 0;
    int unordered = 0;
};

/// Compares every triple with its sum over texels, and counts those that are not 0.
Counts checkAllTriples(int side) {
    const auto functions = drawBasis(side);
    const auto count = functions.size();
    Counts counts;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
            for (std::size_t k = 0; k < count; ++k) {
                double sum = 0.0;
                for (std::size_t t = 0; t < count; ++t)
                    sum += static_cast<double>(functions[i][t]) * functions[j][t] * functions[k][t];
                const double coefficient = haarTriplingCoefficient(
                    static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
                EXPECT_EQ(coefficient, sum * side) << i << ", " << j << ", " << k;
                counts.ordered += coefficient != 0.0 ? 1 : 0;
                counts.unordered += coefficient != 0.0 && i <= j && j <= k ? 1 : 0;
            }
    return counts;
}

TEST(HaarTripling, IsTheSumOfProductsForEveryTriple) {
    struct Known {
        int side, ordered, unordered;
    };
    for (const auto& [side, ordered, unordered] :
         {Known{1, 1, 1}, Known{2, 16, 5}, Known{4, 184, 57}, Known{8, 1288, 409}}) {
        const Counts counts = checkAllTriples(side);
        EXPECT_EQ(counts.ordered, ordered) << side;
        EXPECT_EQ(counts.unordered, unordered) << side;
    }
}

TEST(HaarTripling, TakesTheValuesOfTheTheorem) {
    const auto index = [](HaarType type, int level, int x, int y) {
        return haarIndex({type, level, x, y});
    };
    const int fine = index(HaarType::vertical, 5, 17, 9);
    EXPECT_EQ(haarTriplingCoefficient(0, 0, 0), 1.0);
    EXPECT_EQ(haarTriplingCoefficient(fine, 0, fine), 1.0);
    EXPECT_EQ(haarTriplingCoefficient(fine, index(HaarType::diagonal, 5, 17, 9),
                                      index(HaarType::horizontal, 5, 17, 9)),
              32.0);
    // Square (17, 9) of level 5 lies in square (4, 2) of level 3, in the left upper quadrant, and
    // in the right lower quadrant of square (0, 0) of level 0.
    EXPECT_EQ(haarTriplingCoefficient(fine, fine, index(HaarType::horizontal, 3, 4, 2)), 8.0);
    EXPECT_EQ(haarTriplingCoefficient(fine, index(HaarType::horizontal, 0, 0, 0), fine), -1.0);
    EXPECT_EQ(haarTriplingCoefficient(fine, fine, index(HaarType::horizontal, 3, 5, 2)), 0.0);
    EXPECT_EQ(haarTriplingCoefficient(fine, fine, fine), 0.0);
}

TEST(HaarProduct, IsTheProductAtEachTexel) {
    for (const int side : {1, 2, 8, 16}) {
        const std::vector<float> a = randomCoefficients(side, 1), b = randomCoefficients(side, 2);
        std::vector<float> product(a.size());
        multiplyHaar(a, b, product);
        const std::vector<float> texelsA = reconstruct(a), texelsB = reconstruct(b);
        const std::vector<float> texels = reconstruct(product);
        for (std::size_t t = 0; t < texels.size(); ++t)
            ASSERT_NEAR(texels[t], texelsA[t] * texelsB[t], 4.0f * kRounding) << side;
    }
}

// The same by the tripling coefficients themselves, one after another.
TEST(HaarProduct, SumsTheTriplingCoefficients) {
    constexpr int kSide = 8;
    const std::vector<float> a = randomCoefficients(kSide, 3), b = randomCoefficients(kSide, 4);
    std::vector<float> product(a.size());
    multiplyHaar(a, b, product);
    for (std::size_t k = 0; k < product.size(); ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t j = 0; j < b.size(); ++j)
                sum += static_cast<double>(a[i]) * b[j] *
                       haarTriplingCoefficient(static_cast<int>(i), static_cast<int>(j),
                                               static_cast<int>(k));
        ASSERT_NEAR(product[k], sum / kSide, kRounding) << k;
    }
}

TEST(HaarProduct, OfAFunctionAndOneIsTheFunction) {
    const std::vector<float> a = randomCoefficients(32, 5);
    std::vector<float> one(a.size(), 0.0f), product(a.size());
    one[0] = 32.0f;
    multiplyHaar(a, one, product);
    EXPECT_EQ(product, a);
    multiplyHaar(one, a, product);
    EXPECT_EQ(product, a);
}

TEST(HaarTripleProduct, IsTheSumOverTexels) {
    for (const int side : {1, 2, 16}) {
        const std::vector<float> a = randomCoefficients(side, 6), b = randomCoefficients(side, 7),
                                 c = randomCoefficients(side, 8);
        const std::vector<float> texelsA = reconstruct(a), texelsB = reconstruct(b),
                                 texelsC = reconstruct(c);
        double sum = 0.0, size = 0.0;
        for (std::size_t t = 0; t < texelsA.size(); ++t) {
            const double value = static_cast<double>(texelsA[t]) * texelsB[t] * texelsC[t];
            sum += value;
            size += std::abs(value);
        }
        EXPECT_NEAR(integrateHaarTriple(a, b, c), sum, kRounding * size) << side;
        EXPECT_NEAR(integrateHaarTriple(c, a, b), sum, kRounding * size) << side;
    }
}

}  // namespace
}  // namespace prt

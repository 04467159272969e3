#include "prt/basis/haar_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/haar.h"

namespace prt {
namespace {

// Squares of floats added up in double, in two different orders.
constexpr double kRounding = 1e-12;

std::vector<Vec3f> randomCoefficients(std::size_t count, std::uint64_t stream) {
    RandomStream random(9, stream);
    std::vector<Vec3f> coefficients(count);
    for (Vec3f& coefficient : coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = std::pow(2.0f * random.nextUnitFloat() - 1.0f, 5.0f);
    return coefficients;
}

std::vector<float> randomWeights(std::size_t count) {
    RandomStream random(9, 100);
    std::vector<float> weights(count);
    for (float& weight : weights)
        weight = random.nextUnitFloat();
    return weights;
}

double energy(const Vec3f& value) {
    return Vec3d(value).length2();
}

/// The indices of the N largest by a whole sort, ascending.
std::vector<std::size_t> sortOut(const std::vector<Vec3f>& coefficients, std::size_t count,
                                 const std::vector<float>& weights) {
    std::vector<std::size_t> order(coefficients.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto importance = [&](std::size_t i) {
        const double weight = weights.empty() ? 1.0 : weights[i];
        return weight * weight * energy(coefficients[i]);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return importance(a) != importance(b) ? importance(a) > importance(b) : a < b;
    });
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
}

void expectSelection(const std::vector<SparseCoefficient>& selected,
                     const std::vector<std::size_t>& indices,
                     const std::vector<Vec3f>& coefficients) {
    ASSERT_EQ(selected.size(), indices.size());
    for (std::size_t n = 0; n < indices.size(); ++n) {
        EXPECT_EQ(selected[n].index, indices[n]);
        EXPECT_EQ(selected[n].value, coefficients[indices[n]]);
    }
}

TEST(SelectLargest, FindsWhatASortFinds) {
    const std::vector<Vec3f> coefficients = randomCoefficients(1536, 1);
    for (const auto& weights : {std::vector<float>(), haarAreas(16, 6), randomWeights(1536)})
        for (const std::size_t count : {0u, 1u, 7u, 100u, 1535u, 1536u})
            expectSelection(selectLargest(coefficients, count, weights),
                            sortOut(coefficients, count, weights), coefficients);
}

TEST(SelectLargest, TakesTheFirstOfEquals) {
    std::vector<Vec3f> coefficients(64, Vec3f(0.5f, 0.0f, 0.0f));
    coefficients[40] = Vec3f(0.0f, 0.0f, -2.0f);
    for (std::size_t i = 1; i < coefficients.size(); i += 2)
        coefficients[i].y = -0.5f;
    expectSelection(selectLargest(coefficients, 4), {1, 3, 5, 40}, coefficients);
}

TEST(SelectLargest, WeighsTheThreeChannelsTogether) {
    const std::vector<Vec3f> coefficients = {{1.0f, 1.0f, 1.0f}, {0.0f, 1.5f, 0.0f}, {2.0f, 0, 0}};
    expectSelection(selectLargest(coefficients, 2), {0, 2}, coefficients);
}

TEST(SelectLargest, LeavesOutWhatIsNothing) {
    std::vector<Vec3f> coefficients(16, Vec3f(0.0f));
    EXPECT_TRUE(selectLargest(coefficients, 16).empty());
    EXPECT_TRUE(selectLargest({}, 5).empty());
    coefficients[3] = Vec3f(0.0f, 1.0f, 0.0f);
    coefficients[9] = Vec3f(2.0f, 0.0f, 0.0f);
    expectSelection(selectLargest(coefficients, 5), {3, 9}, coefficients);
    expectSelection(selectLargest(coefficients, 1000), {3, 9}, coefficients);
    std::vector<float> weights(16, 1.0f);
    weights[9] = 0.0f;
    expectSelection(selectLargest(coefficients, 5, weights), {3}, coefficients);
}

TEST(SelectLargest, OrdersWhatOverflowsAFloatAndPassesOverNaN) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Vec3f> coefficients(100, Vec3f(nan));
    coefficients[10] = Vec3f(1e30f);
    coefficients[70] = Vec3f(3e30f);
    coefficients[80] = Vec3f(2e30f);
    expectSelection(selectLargest(coefficients, 2), {70, 80}, coefficients);
    EXPECT_EQ(selectLargest(coefficients, 50).size(), 3u);
}

TEST(HaarAreas, AreTheSquaresInWhichTheFunctionsLive) {
    for (const int side : {1, 2, 8}) {
        const auto count = static_cast<std::size_t>(side * side);
        const std::vector<float> areas = haarAreas(side, 2);
        ASSERT_EQ(areas.size(), 2 * count);
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<float> unit(count, 0.0f), texels(count);
            unit[i] = 1.0f;
            reconstructHaar(unit, texels);
            const auto filled =
                std::count_if(texels.begin(), texels.end(), [](float t) { return t != 0.0f; });
            EXPECT_EQ(areas[i], static_cast<float>(filled) / static_cast<float>(count)) << i;
            EXPECT_EQ(areas[count + i], areas[i]);
        }
    }
}

// A20
TEST(SelectionErrors, AreTheEnergyLeftOut) {
    const std::vector<Vec3f> coefficients = randomCoefficients(384, 2);
    double whole = 0.0;
    for (const Vec3f& coefficient : coefficients)
        whole += energy(coefficient);
    const std::vector<std::size_t> counts = {0, 1, 10, 100, 383, 384, 1000};
    for (const auto& weights : {std::vector<float>(), haarAreas(8, 6), randomWeights(384)}) {
        const std::vector<double> errors = selectionErrors(coefficients, counts, weights);
        ASSERT_EQ(errors.size(), counts.size());
        for (std::size_t n = 0; n < counts.size(); ++n) {
            double out = whole;
            for (const SparseCoefficient& entry : selectLargest(coefficients, counts[n], weights))
                out -= energy(entry.value);
            EXPECT_NEAR(errors[n] * errors[n], out / whole, kRounding) << counts[n];
        }
        EXPECT_EQ(errors[0], 1.0);
        EXPECT_EQ(errors[5], 0.0);
        EXPECT_EQ(errors[6], 0.0);
    }
}

TEST(SelectionErrors, FallWithEveryCoefficientAndAreLeastWithoutWeights) {
    const std::vector<Vec3f> coefficients = randomCoefficients(96, 3);
    std::vector<std::size_t> counts(97);
    std::iota(counts.begin(), counts.end(), std::size_t(0));
    const std::vector<double> best = selectionErrors(coefficients, counts);
    const std::vector<double> weighted = selectionErrors(coefficients, counts, haarAreas(4, 6));
    for (std::size_t n = 1; n < counts.size(); ++n) {
        EXPECT_LT(best[n], best[n - 1]);
        EXPECT_LT(weighted[n], weighted[n - 1]);
        EXPECT_LE(best[n], weighted[n] + kRounding);
    }
}

TEST(SelectionErrors, AreNothingForNothing) {
    const std::vector<Vec3f> coefficients(16, Vec3f(0.0f));
    EXPECT_EQ(selectionErrors(coefficients, std::vector<std::size_t>{0, 5, 16}),
              (std::vector<double>{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace prt

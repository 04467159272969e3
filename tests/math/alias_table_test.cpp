#include "prt/math/alias_table.h"

#include <gtest/gtest.h>

#include <numeric>

#include "prt/base/random.h"

namespace prt {
namespace {

// Even steps through [0, 1) count how much of it belongs to each index.
std::vector<double> measureShares(const AliasTable& table, std::size_t indexCount) {
    constexpr int kStepCount = 1 << 20;
    std::vector<double> shares(indexCount);
    for (int i = 0; i < kStepCount; ++i)
        shares[table.sample((i + 0.5) / kStepCount)] += 1.0 / kStepCount;
    return shares;
}

void expectSharesFollow(const std::vector<double>& weights) {
    const AliasTable table(weights);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const std::vector<double> shares = measureShares(table, weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(table.probability(i), weights[i] / sum, 1e-15);
        // Each column of the table is cut once, so a share is off by a step a column at most.
        EXPECT_NEAR(shares[i], weights[i] / sum, 1e-6 * static_cast<double>(weights.size()));
        if (weights[i] == 0.0) {
            EXPECT_EQ(shares[i], 0.0);
        }
    }
}

TEST(AliasTable, DrawsEachIndexAsOftenAsItsWeightSays) {
    expectSharesFollow({1.0});
    expectSharesFollow({1.0, 3.0});
    expectSharesFollow({0.0, 1e-9, 5.0, 0.0, 1e9});
    std::vector<double> weights;
    RandomStream random(1, 0);
    for (int i = 0; i < 100; ++i)
        weights.push_back(i % 7 == 0 ? 0.0 : random.nextUnitDouble());
    expectSharesFollow(weights);
}

TEST(AliasTable, WithoutAnyWeightAllAreDrawnAlike) {
    const AliasTable table(std::vector<double>(4, 0.0));
    for (const double share : measureShares(table, 4))
        EXPECT_NEAR(share, 0.25, 1e-5);
    EXPECT_EQ(table.probability(3), 0.25);
}

TEST(AliasTable, TheLargestFractionIsStillInTheTable) {
    const AliasTable table(std::vector<double>{1.0, 1.0, 1.0});
    EXPECT_EQ(table.sample(0x1.fffffffffffffp-1), 2u);
}

}  // namespace
}  // namespace prt

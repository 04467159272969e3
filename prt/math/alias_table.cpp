// Bibliography
//   [Vose91]  A linear algorithm for generating random numbers with a given distribution
#include "prt/math/alias_table.h"

#include <algorithm>
#include <numeric>

#include "prt/base/assert.h"

namespace prt {

AliasTable::AliasTable(std::span<const double> weights)
    : probabilities_(weights.begin(), weights.end()), columns_(weights.size()) {
    PRT_ASSERT(!weights.empty(), "there is something to draw");
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto count = static_cast<double>(weights.size());
    for (double& probability : probabilities_)
        probability = sum > 0.0 ? probability / sum : 1.0 / count;

    // Sort the indices into those with less and those with more than an even share.
    std::vector<double> share(weights.size());
    std::vector<std::uint32_t> poor, rich;
    for (std::uint32_t i = 0; i < share.size(); ++i) {
        share[i] = probabilities_[i] * count;
        (share[i] < 1.0 ? poor : rich).push_back(i);
    }
    // Fill up each poor column from a rich index, which may become poor by it.
    while (!poor.empty() && !rich.empty()) {
        const std::uint32_t taker = poor.back();
        const std::uint32_t giver = rich.back();
        poor.pop_back();
        columns_[taker] = {share[taker], giver};
        share[giver] -= 1.0 - share[taker];
        if (share[giver] >= 1.0) continue;
        rich.pop_back();
        poor.push_back(giver);
    }
    // What is left has an even share but for rounding, and its column for itself.
}

std::size_t AliasTable::sample(double u) const {
    const double scaled = u * static_cast<double>(columns_.size());
    const std::size_t index = std::min(static_cast<std::size_t>(scaled), columns_.size() - 1);
    const Column& column = columns_[index];
    return scaled - static_cast<double>(index) < column.ownShare ? index : column.other;
}

}  // namespace prt

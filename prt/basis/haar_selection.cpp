// Bibliography
//   [Ng03]  All-frequency shadows using non-linear wavelet lighting approximation
#include "prt/basis/haar_selection.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/basis/haar.h"

namespace prt {
namespace {

/// In double, in which no square of a float overflows.
double energyOf(const Vec3f& coefficient) {
    return Vec3d(coefficient).length2();
}

/// How much each coefficient matters. What is not a number matters nothing, so that all can be
/// ordered.
std::vector<double> measureImportance(std::span<const Vec3f> coefficients,
                                      std::span<const float> weights) {
    PRT_ASSERT(weights.empty() || weights.size() == coefficients.size(),
               "one weight a coefficient");
    PRT_ASSERT(coefficients.size() <= std::numeric_limits<std::uint32_t>::max(), "indices fit");
    std::vector<double> importance(coefficients.size());
    for (std::size_t i = 0; i < importance.size(); ++i) {
        const double weight = weights.empty() ? 1.0 : weights[i];
        importance[i] = std::max(0.0, weight * weight * energyOf(coefficients[i]));
    }
    return importance;
}

}  // namespace

std::vector<SparseCoefficient> selectLargest(std::span<const Vec3f> coefficients, std::size_t count,
                                             std::span<const float> weights) {
    const std::vector<double> importance = measureImportance(coefficients, weights);
    count = std::min(count, importance.size());
    if (count == 0) return {};

    // Find the least importance that gets in, and how many of that importance do.
    std::vector<double> ordered = importance;
    const auto last = ordered.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::nth_element(ordered.begin(), last, ordered.end(), std::greater<>());
    const double least = *last;
    auto placesForLeast = static_cast<std::size_t>(std::count(ordered.begin(), last + 1, least));

    std::vector<SparseCoefficient> selected;
    selected.reserve(count);
    for (std::size_t i = 0; i < importance.size(); ++i) {
        const bool isLeast = importance[i] == least;
        if (importance[i] == 0.0 || importance[i] < least || (isLeast && placesForLeast == 0))
            continue;
        placesForLeast -= isLeast ? 1 : 0;
        selected.push_back({static_cast<std::uint32_t>(i), coefficients[i]});
    }
    return selected;
}

std::vector<float> haarAreas(int side, int squareCount) {
    PRT_ASSERT(side > 0 && std::has_single_bit(static_cast<unsigned>(side)),
               "the side of the square is a power of two");
    PRT_ASSERT(squareCount >= 0, "squares are counted");
    std::vector<float> areas;
    for (int square = 0; square < squareCount; ++square)
        for (int i = 0; i < side * side; ++i)
            areas.push_back(1.0f / static_cast<float>(1 << 2 * haarLevel(i)));
    return areas;
}

std::vector<double> selectionErrors(std::span<const Vec3f> coefficients,
                                    std::span<const std::size_t> counts,
                                    std::span<const float> weights) {
    const std::vector<double> importance = measureImportance(coefficients, weights);
    std::vector<std::size_t> order(coefficients.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return importance[a] > importance[b]; });

    // left[n]: the squares of all but the first n, added up from the small ones.
    std::vector<double> left(order.size() + 1, 0.0);
    for (std::size_t n = order.size(); n-- > 0;)
        left[n] = left[n + 1] + energyOf(coefficients[order[n]]);

    std::vector<double> errors;
    for (const std::size_t count : counts)
        errors.push_back(left[0] > 0.0 ? std::sqrt(left[std::min(count, order.size())] / left[0])
                                       : 0.0);
    return errors;
}

}  // namespace prt

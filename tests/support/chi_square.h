#pragma once

#include <cmath>
#include <utility>

namespace prt::test {

/// Bounds of a χ² variable for a false alarm once in ten thousand on either side
/// (Wilson and Hilferty's cube root, 3.72 standard deviations).
inline std::pair<double, double> chiSquareBand(double freedom) {
    const double spread = 3.72 * std::sqrt(2.0 / (9.0 * freedom));
    const double center = 1.0 - 2.0 / (9.0 * freedom);
    return {freedom * std::pow(center - spread, 3.0), freedom * std::pow(center + spread, 3.0)};
}

}  // namespace prt::test

// Bibliography
//   [Jarosz09]  Importance sampling spherical harmonics
#include "prt/basis/sh_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

std::size_t coefficientIndex(int l, int m) {
    return static_cast<std::size_t>(shIndex(l, m));
}

/// a_l of the recurrence p_l = a_l (z p_{l−1} − p_{l−2} / a_{l−1}) of order m.
double recurrenceFactor(int l, int m) {
    return std::sqrt((4.0 * l * l - 1.0) /
                     (static_cast<double>(l) * l - static_cast<double>(m) * m));
}

/// An antiderivative in z of y_lm at azimuth 0; n² numbers, of which those with m ≥ 0 count.
///
/// With p_l that function, d/dz ((1 − z²) p_{l−1}) and the recurrence of p_l leave
///
///   (l + 1) ∫p_l = (l − 2) a_l/a_{l−1} ∫p_{l−2} − a_l (1 − z²) p_{l−1}
std::vector<double> integratePolarFunctions(double z, int bandCount) {
    std::vector<double> atEquator(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    std::vector<double> values(atEquator.size()), integrals(atEquator.size());
    const double squaredSine = std::max(1.0 - z * z, 0.0), sine = std::sqrt(squaredSine);
    evaluateSh(Vec3d(1.0, 0.0, 0.0), bandCount, atEquator);
    evaluateSh(Vec3d(sine, 0.0, z), bandCount, values);
    // ∫sin^m, of this order and of the one before last: from m = −2 and −1.
    double beforeLast = 0.0, last = std::asin(z), sineToTheM = 1.0;
    for (int m = 0; m < bandCount; ++m) {
        const double sectoral = (z * sineToTheM + m * beforeLast) / (m + 1);
        integrals[coefficientIndex(m, m)] = atEquator[coefficientIndex(m, m)] * sectoral;
        for (int l = m + 1; l < bandCount; ++l) {
            const double factor = recurrenceFactor(l, m);
            double sum = -factor * squaredSine * values[coefficientIndex(l - 1, m)];
            if (l > m + 1)
                sum += (l - 2) * factor / recurrenceFactor(l - 1, m) *
                       integrals[coefficientIndex(l - 2, m)];
            integrals[coefficientIndex(l, m)] = sum / (l + 1);
        }
        beforeLast = last;
        last = sectoral;
        sineToTheM *= sine;
    }
    return integrals;
}

/// Integrals over azimuth of 1, cos φ, cos 2φ, … and of sin φ, sin 2φ, …, for order m at n − 1 + m.
std::vector<double> integrateAzimuthFunctions(double phi0, double phi1, int bandCount) {
    std::vector<double> integrals(static_cast<std::size_t>(2 * bandCount - 1));
    const auto middle = static_cast<std::ptrdiff_t>(bandCount - 1);
    const auto ofOrder = integrals.begin() + middle;
    ofOrder[0] = phi1 - phi0;
    for (int m = 1; m < bandCount; ++m) {
        ofOrder[m] = (std::sin(m * phi1) - std::sin(m * phi0)) / m;
        ofOrder[-m] = (std::cos(m * phi0) - std::cos(m * phi1)) / m;
    }
    return integrals;
}

/// The integrals of a function over all cells of a row, which share those in z.
void integrateRow(std::span<const double> coefficients, int bandCount,
                  std::span<const double> polarFrom, std::span<const double> polarTo,
                  const std::vector<std::vector<double>>& azimuthFunctions,
                  std::span<double> integrals) {
    std::vector<double> factors(static_cast<std::size_t>(2 * bandCount - 1), 0.0);
    for (int l = 0; l < bandCount; ++l)
        for (int m = -l; m <= l; ++m) {
            const std::size_t polar = coefficientIndex(l, std::abs(m));
            factors[static_cast<std::size_t>(bandCount - 1 + m)] +=
                coefficients[coefficientIndex(l, m)] * (polarTo[polar] - polarFrom[polar]);
        }
    for (std::size_t column = 0; column < integrals.size(); ++column)
        integrals[column] = std::inner_product(factors.begin(), factors.end(),
                                               azimuthFunctions[column].begin(), 0.0);
}

/// The integrals of a function over the cells of a grid, row-major from z = −1 and φ = 0.
std::vector<double> integrateCells(std::span<const double> coefficients, int bandCount,
                                   int rowCount, int columnCount) {
    std::vector<std::vector<double>> azimuthFunctions;
    for (int column = 0; column < columnCount; ++column)
        azimuthFunctions.push_back(integrateAzimuthFunctions(
            2.0 * kPi * column / columnCount, 2.0 * kPi * (column + 1) / columnCount, bandCount));
    const auto width = static_cast<std::size_t>(columnCount);
    std::vector<double> integrals(static_cast<std::size_t>(rowCount) * width);
    std::vector<double> polarFrom = integratePolarFunctions(-1.0, bandCount);
    for (int row = 0; row < rowCount; ++row) {
        std::vector<double> polarTo =
            integratePolarFunctions(2.0 * (row + 1) / rowCount - 1.0, bandCount);
        integrateRow(coefficients, bandCount, polarFrom, polarTo, azimuthFunctions,
                     std::span(integrals).subspan(static_cast<std::size_t>(row) * width, width));
        polarFrom = std::move(polarTo);
    }
    return integrals;
}

/// Chooses one of two halves by their weights, and stretches the part of [0, 1) that fell to it
/// back over all.
std::size_t chooseHalf(double first, double second, double& u) {
    constexpr double kBelowOne = 1.0 - 0x1p-53;
    const double share = first / (first + second);
    if (u < share) {
        u = std::min(u / share, kBelowOne);
        return 0;
    }
    u = std::min((u - share) / (1.0 - share), kBelowOne);
    return 1;
}

}  // namespace

ShSampler::ShSampler(std::span<const double> coefficients, int bandCount,
                     const ShSamplerOptions& options)
    : depth_(options.depth), levels_(static_cast<std::size_t>(options.depth) + 1) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(coefficients.size() == static_cast<std::size_t>(shCoefficientCount(bandCount)),
               "there is a coefficient for each function");
    PRT_ASSERT(options.depth >= 0 && options.depth <= 12, "the cells can be counted");
    PRT_ASSERT(options.uniformShare >= 0.0 && options.uniformShare <= 1.0, "a share is a share");
    std::vector<double>& cells = levels_.back();
    cells = integrateCells(coefficients, bandCount, 1 << depth_, 2 << depth_);
    for (double& cell : cells)
        cell = std::max(cell, 0.0);
    const double sum = std::accumulate(cells.begin(), cells.end(), 0.0);
    const double even = 1.0 / static_cast<double>(cells.size());
    for (double& cell : cells)
        cell = sum > 0.0 ? (1.0 - options.uniformShare) * cell / sum + options.uniformShare * even
                         : even;

    // Sum four cells at a time into those of the next coarser level.
    for (std::size_t level = levels_.size() - 1; level-- > 0;) {
        const std::vector<double>& fine = levels_[level + 1];
        const std::size_t width = std::size_t{2} << level;
        for (std::size_t i = 0; i < width * width / 2; ++i) {
            const std::size_t corner = 4 * width * (i / width) + 2 * (i % width);
            levels_[level].push_back((fine[corner] + fine[corner + 1]) +
                                     (fine[corner + 2 * width] + fine[corner + 2 * width + 1]));
        }
    }
}

ShSample ShSampler::sample(double u, double v) const {
    std::size_t row = 0, column = chooseHalf(levels_[0][0], levels_[0][1], u);
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const std::size_t width = std::size_t{2} << level;
        const double* upper = &levels_[level][2 * row * width + 2 * column];
        const double* lower = upper + width;
        const std::size_t down = chooseHalf(upper[0] + upper[1], lower[0] + lower[1], v);
        const double* chosen = down == 0 ? upper : lower;
        row = 2 * row + down;
        column = 2 * column + chooseHalf(chosen[0], chosen[1], u);
    }
    const double rowCount = std::ldexp(1.0, depth_);
    const double z = 2.0 * (static_cast<double>(row) + v) / rowCount - 1.0;
    const double phi = kPi * (static_cast<double>(column) + u) / rowCount;
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    const Vec3d direction(radius * std::cos(phi), radius * std::sin(phi), z);
    return {direction, density(direction)};
}

double ShSampler::density(const Vec3d& direction) const {
    const int rowCount = 1 << depth_, columnCount = 2 * rowCount;
    const double azimuth = std::atan2(direction.y, direction.x) / (2.0 * kPi);
    const double turns = azimuth < 0.0 ? azimuth + 1.0 : azimuth;
    const int row =
        std::clamp(static_cast<int>(0.5 * (direction.z + 1.0) * rowCount), 0, rowCount - 1);
    const int column = std::clamp(static_cast<int>(turns * columnCount), 0, columnCount - 1);
    const double cellSolidAngle = 4.0 * kPi / rowCount / columnCount;
    return levels_.back()[static_cast<std::size_t>(row) * static_cast<std::size_t>(columnCount) +
                          static_cast<std::size_t>(column)] /
           cellSolidAngle;
}

ShSampler makeShProductSampler(const ShTripling& tripling, std::span<const double> a,
                               std::span<const double> b, const ShSamplerOptions& options) {
    std::vector<double> product(a.size());
    tripling.multiply(a, b, product);
    return ShSampler(product, tripling.bandCount(), options);
}

}  // namespace prt

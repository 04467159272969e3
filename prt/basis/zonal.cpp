// Bibliography
//   [Amos74]         Computation of modified Bessel functions and their ratios
//   [Fisher53]       Dispersion on a sphere: the Gaussian lobe
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
//   [Sloan05]        Local, deformable precomputed radiance transfer
//   [Sloan08]        Stupid spherical harmonics tricks
#include "prt/basis/zonal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

/// y_l0(+z) = √((2l+1)/4π).
double zonalPeak(int l) {
    return std::sqrt((2 * l + 1) * 0.25 * std::numbers::inv_pi);
}

/// Multiplies each band of n² coefficients by a factor of its own.
template <class Real, class FactorOf>
void scaleBands(std::span<Real> coefficients, FactorOf factorOf) {
    for (int l = 0; shCoefficientCount(l) < static_cast<int>(coefficients.size()); ++l) {
        const auto factor = static_cast<Real>(factorOf(l));
        for (int i = shCoefficientCount(l); i < shCoefficientCount(l + 1); ++i)
            coefficients[static_cast<std::size_t>(i)] *= factor;
    }
}

}  // namespace

double clampedCosineFactor(int l) {
    PRT_ASSERT(l >= 0, "degrees count from 0");
    if (l == 1) return 2.0 / 3.0 * std::numbers::pi;
    if (l % 2 != 0) return 0.0;
    double centralBinomial = 1.0;  // l! / (2^l (l/2)!²)
    for (int k = 2; k <= l; k += 2)
        centralBinomial *= (k - 1.0) / k;
    const double sign = l % 4 == 0 ? -1.0 : 1.0;
    return 2.0 * std::numbers::pi * sign / ((l + 2.0) * (l - 1.0)) * centralBinomial;
}

std::vector<double> clampedCosineZonal(int bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    std::vector<double> zonal;
    for (int l = 0; l < bandCount; ++l)
        zonal.push_back(clampedCosineFactor(l) * zonalPeak(l));
    return zonal;
}

std::vector<double> capZonal(int bandCount, double halfAngleRadians) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(halfAngleRadians >= 0.0 && halfAngleRadians <= std::numbers::pi,
               "the half angle lies in [0, π]");
    const double x = std::cos(halfAngleRadians);
    const double sine = std::sin(halfAngleRadians);
    const double halfSine = std::sin(0.5 * halfAngleRadians);

    // Integrate P_l over [x, 1], which is (1 − x²) P_l'(x) / (l (l+1)): unlike the usual difference
    // of two polynomials, this keeps every digit for a disc as small as the sun.
    std::vector<double> zonal = {4.0 * std::numbers::pi * zonalPeak(0) * halfSine * halfSine};
    double lastLegendre = 1.0, legendre = x;        // P_{l−1}, P_l
    double lastDerivative = 0.0, derivative = 1.0;  // P'_{l−1}, P'_l
    for (int l = 1; l < bandCount; ++l) {
        const double integral = sine * sine * derivative / (l * (l + 1.0));
        zonal.push_back(2.0 * std::numbers::pi * zonalPeak(l) * integral);
        const double nextLegendre = ((2 * l + 1) * x * legendre - l * lastLegendre) / (l + 1);
        const double nextDerivative = lastDerivative + (2 * l + 1) * legendre;
        lastLegendre = legendre;
        legendre = nextLegendre;
        lastDerivative = derivative;
        derivative = nextDerivative;
    }
    return zonal;
}

std::vector<double> phongZonal(int bandCount, double exponent) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(exponent >= 0.0, "a lobe is not less than nothing");
    // ∫ z^s P_l dz over [0, 1], each from the one two degrees below.
    std::vector<double> integrals = {1.0 / (exponent + 1.0), 1.0 / (exponent + 2.0)};
    for (int l = 2; l < bandCount; ++l)
        integrals.push_back(integrals[static_cast<std::size_t>(l) - 2] * (exponent - l + 2.0) /
                            (exponent + l + 1.0));
    std::vector<double> zonal;
    for (int l = 0; l < bandCount; ++l)
        zonal.push_back((exponent + 1.0) * zonalPeak(l) * integrals[static_cast<std::size_t>(l)]);
    return zonal;
}

std::vector<double> gaussianZonal(int bandCount, double sharpness) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(sharpness >= 0.0 && std::isfinite(sharpness), "a lobe is not sharper than a point");

    // r_l = i_l / i_(l−1) by its recurrence from above, which forgets its start: a guess between
    // the bounds of [Amos74], made far enough up to lose its last digit.
    const int start = bandCount + 64 + static_cast<int>(4.0 * std::sqrt(std::min(sharpness, 1e6)));
    double ratio = sharpness / (start + std::hypot(start + 0.5, sharpness));
    std::vector<double> ratios(static_cast<std::size_t>(bandCount), 1.0);
    for (int l = start - 1; l >= 1; --l) {
        ratio = sharpness / (2 * l + 1 + sharpness * ratio);
        if (l < bandCount) ratios[static_cast<std::size_t>(l)] = ratio;
    }

    std::vector<double> zonal;
    double product = 1.0;
    for (int l = 0; l < bandCount; ++l) {
        product *= ratios[static_cast<std::size_t>(l)];
        zonal.push_back(zonalPeak(l) * product);
    }
    return zonal;
}

std::vector<double> projectZonal(const std::function<double(double)>& function, int bandCount,
                                 int nodeCount) {
    PRT_ASSERT(bandCount >= 1 && nodeCount >= bandCount, "enough nodes for the bands");
    std::vector<double> zonal(static_cast<std::size_t>(bandCount));
    std::vector<double> basis(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    for (const auto& [z, weight] : gaussLegendre(nodeCount)) {
        evaluateSh(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), bandCount, basis);
        const double value = 2.0 * std::numbers::pi * weight * function(z);
        for (int l = 0; l < bandCount; ++l)
            zonal[static_cast<std::size_t>(l)] +=
                value * basis[static_cast<std::size_t>(shIndex(l, 0))];
    }
    return zonal;
}

void convolveZonal(std::span<const double> kernel, std::span<const double> coefficients,
                   std::span<double> convolved) {
    PRT_ASSERT(coefficients.size() == kernel.size() * kernel.size() &&
                   convolved.size() == coefficients.size(),
               "n coefficients of the kernel, n² of the function");
    std::copy(coefficients.begin(), coefficients.end(), convolved.begin());
    scaleBands(convolved,
               [&](int l) { return kernel[static_cast<std::size_t>(l)] / zonalPeak(l); });
}

void rotateZonal(std::span<const double> zonal, const Vec3d& axis, std::span<double> coefficients) {
    evaluateSh(axis, static_cast<int>(zonal.size()), coefficients);
    scaleBands(coefficients,
               [&](int l) { return zonal[static_cast<std::size_t>(l)] / zonalPeak(l); });
}

Vec3d optimalLinearDirection(std::span<const double, 3> firstDegree) {
    const Vec3d direction(-firstDegree[2], -firstDegree[0], firstDegree[1]);
    const double length = direction.length();
    return length > 0.0 ? direction / length : Vec3d(0.0, 0.0, 1.0);
}

void unshadowedTransfer(const Vec3f& normal, int bandCount, std::span<float> transfer) {
    evaluateSh(normal, bandCount, transfer);
    scaleBands(transfer, [](int l) { return std::numbers::inv_pi * clampedCosineFactor(l); });
}

}  // namespace prt

#include "prt/basis/sh_window.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr double kSmallestLambda = 1e-300;
constexpr double kLargestLambda = 1e300;  // leaves nothing of a double but the mean

/// The square of l(l+1), what the Laplacian multiplies degree l by.
double squaredEigenvalue(std::size_t l) {
    const double degree = static_cast<double>(l);
    return degree * degree * (degree + 1.0) * (degree + 1.0);
}

double windowFactor(ShWindow window, double x) {
    switch (window) {
        case ShWindow::none:
            return 1.0;
        case ShWindow::hann:
            return 0.5 * (1.0 + std::cos(x));
        case ShWindow::lanczos:
            return x == 0.0 ? 1.0 : std::sin(x) / x;
    }
    PRT_ASSERT(false, "the window is one of those listed");
    return 0.0;
}

}  // namespace

std::vector<double> windowFactors(ShWindow window, int bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    std::vector<double> factors;
    for (int l = 0; l < bandCount; ++l) {
        factors.push_back(windowFactor(window, std::numbers::pi * l / bandCount));
    }
    return factors;
}

std::vector<double> laplacianFactors(double lambda, int bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    std::vector<double> factors;
    for (int l = 0; l < bandCount; ++l)
        factors.push_back(1.0 / (1.0 + lambda * squaredEigenvalue(static_cast<std::size_t>(l))));
    return factors;
}

double smoothAtPoint(std::span<const double> bands, double lambda) {
    double sum = 0.0;
    for (std::size_t l = 0; l < bands.size(); ++l)
        sum += bands[l] / (1.0 + lambda * squaredEigenvalue(l));
    return sum;
}

double findLeastLambda(std::span<const double> bands, double from) {
    const double start = smoothAtPoint(bands, from);
    if (start >= 0.0) return from;

    // No λ closer than this can be enough, for the sum is nowhere steeper above; and where the mean
    // is positive, this always is.
    double steepest = 0.0, lobes = 0.0;
    for (std::size_t l = 1; l < bands.size(); ++l) {
        const double eigenvalue = squaredEigenvalue(l);
        const double divisor = 1.0 + from * eigenvalue;
        steepest += std::abs(bands[l]) * eigenvalue / (divisor * divisor);
        lobes += std::max(-bands[l], 0.0) / eigenvalue;
    }
    const double enough = bands[0] > 0.0 ? std::clamp(lobes / bands[0], from, kLargestLambda)
                                         : std::max(from, kLargestLambda);

    double low = from, high = std::min(from - start / steepest, enough);
    while (high < enough && smoothAtPoint(bands, high) < 0.0) {
        low = high;
        high = std::min(std::max(1.125 * high, kSmallestLambda), enough);
    }
    constexpr int kStepCount = 60;
    for (int step = 0; step < kStepCount; ++step) {
        const double middle = 0.5 * (low + high);
        (smoothAtPoint(bands, middle) >= 0.0 ? high : low) = middle;
    }
    return high;
}

}  // namespace prt

#include "prt/basis/sh_window.h"

#include <cmath>
#include <numbers>

#include "prt/base/assert.h"

namespace prt {
namespace {

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
    for (int l = 0; l < bandCount; ++l) {
        const double eigenvalue = l * (l + 1.0);
        factors.push_back(1.0 / (1.0 + lambda * eigenvalue * eigenvalue));
    }
    return factors;
}

}  // namespace prt

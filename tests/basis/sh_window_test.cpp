#include "prt/basis/sh_window.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

void expectFactors(const std::vector<double>& factors, const std::vector<double>& published) {
    constexpr double kPrintedPrecision = 1e-6;
    ASSERT_EQ(factors.size(), published.size());
    for (std::size_t l = 0; l < factors.size(); ++l)
        EXPECT_NEAR(factors[l], published[l], kPrintedPrecision);
}

TEST(ShWindow, FactorsAreThePublishedOnes) {
    expectFactors(windowFactors(ShWindow::none, 3), {1, 1, 1});
    expectFactors(windowFactors(ShWindow::hann, 3), {1, .75, .25});
    expectFactors(windowFactors(ShWindow::hann, 5), {1, .904508, .654508, .345492, .095492});
    expectFactors(windowFactors(ShWindow::lanczos, 3), {1, .826993, .413497});
}

TEST(ShWindow, LaplacianFactorsDivideByOnePlusLambdaTimesTheSquaredEigenvalue) {
    expectFactors(laplacianFactors(0.0, 4), {1, 1, 1, 1});
    expectFactors(laplacianFactors(0.25, 3), {1, 0.5, 0.1});
}

}  // namespace
}  // namespace prt

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

// 1 − 8/(1 + 4 λ) vanishes at 7/4.
TEST(ShWindow, TheLeastLambdaIsTheFirstAtWhichTheSumIsNotNegative) {
    constexpr double kRounding = 1e-12;
    const std::vector<double> slope = {1.0, -8.0};
    EXPECT_NEAR(findLeastLambda(slope, 0.0), 1.75, kRounding);
    EXPECT_EQ(findLeastLambda(slope, 2.0), 2.0);
    // Not negative from 0.0011 to 0.044, and then again from 1.6 on.
    const std::vector<double> wave = {0.3, -3.0, 6.0, 2.0, -7.0};
    const double lambda = findLeastLambda(wave, 0.0);
    EXPECT_NEAR(smoothAtPoint(wave, lambda), 0.0, kRounding);
    EXPECT_GE(smoothAtPoint(wave, lambda), 0.0);
    EXPECT_LT(lambda, 0.0012);
    EXPECT_GT(findLeastLambda(wave, 0.05), 1.6);
}

TEST(ShWindow, TheLeastLambdaIsFoundForBandsOfAnySize) {
    constexpr double kDenormal = 5e-324;
    EXPECT_LT(findLeastLambda(std::vector{1e10, -1e10, -kDenormal}, 0.0), 1e-15);
    EXPECT_EQ(findLeastLambda(std::vector{0.0, -1.0}, 0.0), 1e300);
    EXPECT_EQ(findLeastLambda(std::vector{-1.0, 0.5}, 0.0), 1e300);
    EXPECT_EQ(findLeastLambda(std::vector{kDenormal, -1.0}, 0.0), 1e300);
    EXPECT_EQ(findLeastLambda(std::vector{kDenormal, -1.0}, 1e300), 1e300);
    EXPECT_EQ(findLeastLambda(std::vector{-1.0}, 0.0), 1e300);
}

}  // namespace
}  // namespace prt

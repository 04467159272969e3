#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "prt/render/path_tracer.h"

namespace prt::test {

/// The mean of z over all origins and channels, which sampling noise alone keeps within some
/// 4/√n of 0, and the mean of z², near 1.
inline void expectSameMeans(const RadianceEstimate& a, const RadianceEstimate& b) {
    constexpr double kSigmas = 4.0;
    double sum = 0.0, squareSum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < a.mean.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double variance = a.variance[i][channel] + b.variance[i][channel];
            if (variance == 0.0) continue;
            const double z = (a.mean[i][channel] - b.mean[i][channel]) / std::sqrt(variance);
            sum += z;
            squareSum += z * z;
            count += 1.0;
        }
    }
    ASSERT_GT(count, 300.0);
    // The three channels of an origin go together.
    const double independent = count / 3.0;
    EXPECT_LT(std::abs(sum / count), kSigmas / std::sqrt(independent));
    EXPECT_NEAR(squareSum / count, 1.0, kSigmas * std::sqrt(2.0 / independent) + 0.05);
}

}  // namespace prt::test

#include "prt/relight/receiver_deringing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/basis/zonal.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/deringing.h"

namespace prt {
namespace {

constexpr Transport kTransport = Transport::shadowed;
constexpr double kY00 = 0.28209479177387814;

/// λ from the factor 1 / (1 + 4 λ) of degree 1.
double lambdaOf(const std::vector<double>& factors) {
    return (1.0 / factors[1] - 1.0) / 4.0;
}

/// @param rows  [receiver][channel][coefficient]
Relighter makeRelighter(int bandCount, int channelCount, const std::vector<float>& rows) {
    CompressedTransfer transfer;
    transfer.bandCount = bandCount;
    CompressedLayer layer;
    layer.transport = kTransport;
    layer.channelCount = channelCount;
    layer.table.numbers = makeTable(coefficientsPerReceiver(bandCount, channelCount), rows);
    transfer.receiverCount = layer.table.numbers.rowCount();
    transfer.layers.push_back(layer);
    return Relighter(transfer, kTransport);
}

/// An unshadowed sphere: normals along a Fibonacci spiral, more of them than one part holds.
Relighter makeSphere(int bandCount) {
    constexpr int kReceiverCount = 10000;
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<float> rows(kReceiverCount * coefficientCount);
    for (int i = 0; i < kReceiverCount; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kReceiverCount;
        const double radius = std::sqrt(1.0 - z * z);
        const double phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        unshadowedTransfer(Vec3f(Vec3d(radius * std::cos(phi), radius * std::sin(phi), z)),
                           bandCount,
                           std::span(rows).subspan(static_cast<std::size_t>(i) * coefficientCount,
                                                   coefficientCount));
    }
    return makeRelighter(bandCount, 1, rows);
}

/// The least channel of all receivers.
double findLowest(const Relighter& relighter, const Lighting& lighting) {
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(lighting, radiance);
    float lowest = 1e30f;
    for (const Vec3f& value : radiance)
        lowest = std::min({lowest, value.x, value.y, value.z});
    return static_cast<double>(lowest);
}

Lighting makeBlueAndYellowSuns(int bandCount) {
    Lighting blue = sunLighting(Vec3d(2, -1, -2) / 3.0, 0.0, bandCount);
    Lighting yellow = sunLighting(Vec3d(0, 1, 0), 0.2, bandCount);
    for (std::size_t i = 0; i < blue.coefficients.size(); ++i) {
        blue.coefficients[i] *= Vec3d(0.1, 0.2, 1.0);
        yellow.coefficients[i] *= Vec3d(2.0, 1.5, 0.0);
    }
    return add(blue, yellow);
}

TEST(ReceiverDeringing, OfAnUnshadowedSphereIsThatOfIrradiance) {
    constexpr double kSpiral = 2e-3;  // its receivers lie near the lowest normal, not on it
    for (const int bandCount : {2, 3, 5, 6, 10}) {
        const Relighter sphere = makeSphere(bandCount);
        for (const Lighting& lighting : {sunLighting(Vec3d(2, -1, -2) / 3.0, 0.0, bandCount),
                                         makeBlueAndYellowSuns(bandCount)}) {
            const double irradiance =
                lambdaOf(deringingFactors(lighting, {NonNegative::irradiance}));
            const auto factors = deringingFactors(sphere, lighting, {.tolerance = 1e-6});
            EXPECT_NEAR(lambdaOf(factors), irradiance, kSpiral) << bandCount << " bands";
            EXPECT_LE(lambdaOf(factors), irradiance);
        }
    }
}

TEST(ReceiverDeringing, LeavesNoReceiverNegativeAndIsTheLeastThatDoes) {
    constexpr double kFloatRounding = 1e-6;
    const Relighter sphere = makeSphere(5);
    const Lighting lighting = makeBlueAndYellowSuns(5);
    double last = 1e300;
    for (const double tolerance : {0.0, 1e-3, 1e-2, 3e-2}) {
        const auto factors = deringingFactors(sphere, lighting, {tolerance});
        const Vec3d mean = lighting.coefficients[0] * kY00;
        const double allowed = tolerance * std::max({mean.x, mean.y, mean.z});
        EXPECT_EQ(factors[0], 1.0);
        EXPECT_GE(findLowest(sphere, applyWindow(lighting, factors)), -allowed - kFloatRounding);

        const double lambda = lambdaOf(factors);
        const Lighting weaker = applyWindow(lighting, laplacianFactors(0.9 * lambda, 5));
        EXPECT_LT(findLowest(sphere, weaker), -tolerance * std::min({mean.x, mean.y, mean.z}));
        EXPECT_LT(lambda, last) << "a larger tolerance needs less";
        last = lambda;
    }
}

// T = (1, 0, 2, 0) under L = (1, 0, −1, 0) is 1 − 2/(1 + 4 λ).
TEST(ReceiverDeringing, OfOneReceiverHasAClosedForm) {
    constexpr double kRounding = 1e-6;
    Lighting lighting(2);
    lighting.coefficients[0] = Vec3d(1.0);
    lighting.coefficients[2] = Vec3d(-1.0);
    const Relighter grey = makeRelighter(2, 1, {1, 0, 2, 0});
    EXPECT_NEAR(lambdaOf(deringingFactors(grey, lighting, {0.0})), 0.25, kRounding);
    // 1 + 0.5 · y_00 of the mean is allowed.
    const double allowed = 0.5 * kY00;
    EXPECT_NEAR(lambdaOf(deringingFactors(grey, lighting, {0.5})),
                (2.0 / (1.0 + allowed) - 1.0) / 4.0, kRounding);

    // Each channel counts with a transfer of its own, and every receiver counts.
    const Relighter colored = makeRelighter(2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0,  //
                                                   1, 0, 0, 0, 1, 0, 4, 0, 1, 0, 2, 0});
    EXPECT_NEAR(lambdaOf(deringingFactors(colored, lighting, {0.0})), 0.75, kRounding);
    lighting.coefficients[2].y = 0.0;
    EXPECT_NEAR(lambdaOf(deringingFactors(colored, lighting, {0.0})), 0.25, kRounding);
}

// The first receiver is negative below 0.0011 and again from 0.044 to 1.6, the second below 0.1.
TEST(ReceiverDeringing, JudgesAllReceiversAgainAfterTheLastHasBeenHelped) {
    const std::vector<double> wave = {0.3, -3.0, 6.0, 2.0, -7.0};
    Lighting lighting(5);
    std::vector<float> rows(2 * 25, 0.0f);
    for (int l = 0; l < 5; ++l) {
        const auto i = static_cast<std::size_t>(shIndex(l, 0));
        lighting.coefficients[i] = Vec3d(1.0);
        rows[i] = static_cast<float>(wave[static_cast<std::size_t>(l)]);
    }
    rows[25] = 1.0f;
    rows[25 + 2] = -1.4f;
    const auto factors = deringingFactors(makeRelighter(5, 1, rows), lighting, {0.0});
    EXPECT_NEAR(lambdaOf(factors), findLeastLambda(wave, 0.1), 1e-5);
}

TEST(ReceiverDeringing, LeavesOutWhatCannotBeHelped) {
    const std::vector<double> identity(2, 1.0);
    Lighting lighting(2);
    lighting.coefficients[0] = Vec3d(1.0, 0.0, -1.0);
    lighting.coefficients[2] = Vec3d(0.0, -1.0, -1.0);
    // Green and blue have no light; the second receiver sees nothing, the third less than nothing.
    const Relighter relighter = makeRelighter(2, 1, {1, 0, 2, 0, 0, 0, 0, 0, -1, 0, 2, 0});
    EXPECT_EQ(deringingFactors(relighter, lighting), identity);
    EXPECT_EQ(deringingFactors(relighter, Lighting(2)), identity);
}

TEST(ReceiverDeringing, TakesLightsOfFewerBandsThanTheAsset) {
    const Lighting sun = sunLighting(Vec3d(0, 1, 0), 0.0, 3);
    const auto factors = deringingFactors(makeSphere(5), sun, {1e-6});
    ASSERT_EQ(factors.size(), 3u);
    EXPECT_NEAR(lambdaOf(factors), .17773, 1e-3);
}

}  // namespace
}  // namespace prt

#include "prt/image/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace prt {
namespace {

constexpr float kFloatRounding = 1e-6f;

Rgba8 encode(const Vec3f& radiance, const DisplayOptions& options) {
    return encodeForDisplay(Image(1, 1, radiance), options).at(0, 0);
}

TEST(Srgb, CurveIsThePiecewiseOneOfTheStandard) {
    EXPECT_EQ(decodeSrgb(0.0f), 0.0f);
    EXPECT_NEAR(decodeSrgb(1.0f), 1.0f, kFloatRounding);
    EXPECT_NEAR(decodeSrgb(0.5f), 0.21404114f, kFloatRounding);
    EXPECT_NEAR(decodeSrgb(0.04f), 0.04f / 12.92f, kFloatRounding);
    EXPECT_NEAR(encodeSrgb(0.18f), 0.46135613f, kFloatRounding);
    EXPECT_NEAR(encodeSrgb(0.002f), 0.02584f, kFloatRounding);
}

TEST(Srgb, EveryCodeValueSurvivesTheRoundTrip) {
    for (int code = 0; code < 256; ++code) {
        const float linear = decodeSrgb8(static_cast<std::uint8_t>(code));
        EXPECT_EQ(linear, decodeSrgb(static_cast<float>(code) / 255.0f));
        EXPECT_NEAR(encodeSrgb(linear) * 255.0f, static_cast<float>(code), 1e-3f);
        EXPECT_EQ(encode(Vec3f(linear), {.toneCurve = ToneCurve::none}).green, code);
    }
}

TEST(Conventions, C5_RadianceIsClampedOnlyByTheFinalPicture) {
    const DisplayOptions plain{.toneCurve = ToneCurve::none};
    const Rgba8 bright = encode(Vec3f(4.0f, 0.5f, -1.0f), plain);
    EXPECT_EQ(bright.red, 255);
    EXPECT_EQ(bright.green, 188);  // 255 · encodeSrgb(½) = 187.5…
    EXPECT_EQ(bright.blue, 0);
    EXPECT_EQ(bright.alpha, 255);
    // Two stops down bring the 4 back to 1 and a 2 to ½: the values above 1 were still there.
    const Rgba8 darker =
        encode(Vec3f(4.0f, 2.0f, 1.0f), {.exposureStops = -2.0f, .toneCurve = ToneCurve::none});
    EXPECT_EQ(darker.red, 255);
    EXPECT_EQ(darker.green, 188);
    EXPECT_EQ(darker.blue, 137);  // 255 · encodeSrgb(¼) = 136.96
}

TEST(ToneCurve, AcesIsNarkowiczFit) {
    const auto expected = [](double x) {
        const double mapped = std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
        const double code =
            mapped <= 0.0031308 ? 12.92 * mapped : 1.055 * std::pow(mapped, 1 / 2.4) - 0.055;
        return static_cast<int>(255.0 * code + 0.5);
    };
    for (const double x : {0.0, 0.01, 0.18, 0.5, 1.0, 3.0, 7.0, 50.0, 1e6}) {
        EXPECT_EQ(encode(Vec3f(static_cast<float>(x)), {}).red, expected(x)) << x;
    }
    EXPECT_EQ(expected(1.0), 232);  // 0.8038, which sRGB encodes as 0.9082
}

TEST(ToneCurve, ValuesThatAreNoNumbersGiveAPicture) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces}) {
        const Rgba8 pixel = encode(Vec3f(std::nanf(""), infinity, -infinity), {.toneCurve = curve});
        EXPECT_EQ(pixel.red, 0);
        EXPECT_EQ(pixel.green, 255);
        EXPECT_EQ(pixel.blue, 0);
    }
}

}  // namespace
}  // namespace prt

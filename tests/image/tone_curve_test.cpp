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

/// What the display shows, linear. Half a code value is less than 0.0045.
Vec3d showNeutral(const Vec3f& radiance) {
    const Rgba8 pixel = encode(radiance, {.toneCurve = ToneCurve::neutral});
    return {decodeSrgb8(pixel.red), decodeSrgb8(pixel.green), decodeSrgb8(pixel.blue)};
}
constexpr double kHalfCodeValue = 0.0045;

TEST(ToneCurve, NeutralShiftsColoursOfSurfacesAndNothingElse) {
    constexpr float kFresnel = 0.04f;
    for (const Vec3f& color : {Vec3f(0.08f, 0.8f, 0.3f), Vec3f(0.5f, 0.09f, 0.79f), Vec3f(0.4f)}) {
        const Rgba8 shown = encode(color, {.toneCurve = ToneCurve::neutral});
        const Rgba8 shifted = encode(color - Vec3f(kFresnel), {.toneCurve = ToneCurve::none});
        EXPECT_EQ(shown.red, shifted.red) << color;
        EXPECT_EQ(shown.green, shifted.green) << color;
        EXPECT_EQ(shown.blue, shifted.blue) << color;
    }
    // A channel that is 0 leaves the others as they are.
    EXPECT_EQ(encode({0.0f, 0.5f, 0.7f}, {.toneCurve = ToneCurve::neutral}).blue,
              encode({0.0f, 0.5f, 0.7f}, {.toneCurve = ToneCurve::none}).blue);
}

TEST(ToneCurve, NeutralGoesThroughTheValuesOfItsSpecification) {
    // f and p_n of it by hand: 0.04 − 0.04²/0.16, ¾, 1 − 0.24²/(0.96 + 0.24 − 0.76), and ∞.
    for (const auto& [given, expected] : {std::pair(0.04f, 0.01), std::pair(0.79f, 0.75),
                                          std::pair(1.0f, 0.8690909), std::pair(1e30f, 1.0)})
        EXPECT_NEAR(showNeutral(Vec3f(given)).y, expected, kHalfCodeValue) << given;
    // p_n = 1 − 0.0576/2.48 and g = 1/(0.15 (3 − p_n) + 1).
    const Vec3d bright = showNeutral({3.0f, 1.0f, 0.0f});
    EXPECT_NEAR(bright.x, 0.976774, kHalfCodeValue);
    EXPECT_NEAR(bright.y, 0.477203, kHalfCodeValue);
    EXPECT_NEAR(bright.z, 0.227416, kHalfCodeValue);
}

TEST(ToneCurve, NeutralIsMonotoneAndReachesOneOnlyAtInfinity) {
    for (const Vec3f& hue : {Vec3f(1.0f), Vec3f(1.0f, 0.3f, 0.05f), Vec3f(0.0f, 1.0f, 0.0f)}) {
        Vec3d last(-1.0);
        for (float scale = 1e-3f; scale < 100.0f; scale *= 1.1f) {
            const Vec3d shown = showNeutral(hue * scale);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_GE(shown[channel], last[channel]) << scale;
            last = shown;
        }
        EXPECT_GT(std::max({last.x, last.y, last.z}), 0.99);
    }
    EXPECT_LT(encode(Vec3f(8.0f), {.toneCurve = ToneCurve::neutral}).red, 255);
}

TEST(ToneCurve, NeutralKeepsHue) {
    // The middle channel stays where it is between the least and the largest.
    for (const Vec3f& color :
         {Vec3f(0.9f, 0.5f, 0.1f), Vec3f(3.0f, 1.0f, 0.0f), Vec3f(9.0f, 5.0f, 2.0f)}) {
        for (const float scale : {0.5f, 1.0f, 2.0f, 5.0f}) {
            const Vec3d shown = showNeutral(color * scale);
            const double share = static_cast<double>((color.y - color.z) / (color.x - color.z));
            EXPECT_NEAR(shown.y - shown.z, share * (shown.x - shown.z), 2.0 * kHalfCodeValue)
                << color << scale;
        }
    }
}

TEST(ToneCurve, NamesAreReadAsTheyAreWritten) {
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral})
        EXPECT_EQ(parseToneCurve(toneCurveName(curve)), curve);
    EXPECT_EQ(toneCurveName(ToneCurve::neutral), "neutral");
    EXPECT_EQ(parseToneCurve("filmic"), std::nullopt);
}

TEST(ToneCurve, ValuesThatAreNoNumbersGiveAPicture) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral}) {
        const Rgba8 pixel = encode(Vec3f(std::nanf(""), infinity, -infinity), {.toneCurve = curve});
        const int others = curve == ToneCurve::neutral ? 255 : 0;  // it whitens what is too bright
        EXPECT_EQ(pixel.red, others);
        EXPECT_EQ(pixel.green, 255);
        EXPECT_EQ(pixel.blue, others);
        EXPECT_EQ(encode(Vec3f(std::nanf(""), -infinity, 0.0f), {.toneCurve = curve}).red, 0);
    }
}

}  // namespace
}  // namespace prt

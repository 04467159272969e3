#include "prt/image/false_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "prt/image/tone_curve.h"

namespace prt {
namespace {

void expectSameColor(const Rgba8& a, const Rgba8& b) {
    EXPECT_EQ(a.red, b.red);
    EXPECT_EQ(a.green, b.green);
    EXPECT_EQ(a.blue, b.blue);
    EXPECT_EQ(a.alpha, 255);
}

TEST(FalseColor, EndsMiddleAndBeyond) {
    ImageOf<float> values(7, 1);
    values.pixels = {-2.0f, 2.0f, 0.0f, -9.0f, 9.0f, 1.0f, std::numeric_limits<float>::quiet_NaN()};
    const auto colors = signedColors();
    const Rgba8Image image = drawFalseColors(values, -2.0f, 2.0f, colors);
    expectSameColor(image.pixels[0], colors.front());
    expectSameColor(image.pixels[1], colors.back());
    expectSameColor(image.pixels[2], colors[2]);
    expectSameColor(image.pixels[3], colors.front());
    expectSameColor(image.pixels[4], colors.back());
    expectSameColor(image.pixels[5], colors[3]);
    expectSameColor(image.pixels[6], colors.front());
}

TEST(FalseColor, UnitColorsGetBrighter) {
    ImageOf<float> ramp(64, 1);
    for (int x = 0; x < 64; ++x)
        ramp.at(x, 0) = static_cast<float>(x) / 63.0f;
    const Rgba8Image image = drawFalseColors(ramp, 0.0f, 1.0f, unitColors());
    int last = -1;
    for (const Rgba8& color : image.pixels) {
        const int brightness = 2 * color.red + 7 * color.green + color.blue;
        EXPECT_GE(brightness, last);
        last = brightness;
    }
}

/// CIE L* of a colour that is shown, 100 for white.
double lightness(const Vec3f& radiance) {
    const double y = luminance(Vec3d(radiance));
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

TEST(FalseColor, OnBlackLightnessIsTheMagnitudeAndHueTheSign) {
    constexpr double kLightest = 92.0;
    constexpr double kTolerance = 3.0;  // of colours between those of the table, and of 8 bits
    EXPECT_EQ(findFalseRadiance(0.0f, -1.0f, 1.0f, signedColorsOnBlack()), Vec3f(0.0f));
    double last = 0.0;
    for (int i = 1; i <= 64; ++i) {
        const float value = static_cast<float>(i) / 64.0f;
        const Vec3f positive = findFalseRadiance(value, -1.0f, 1.0f, signedColorsOnBlack());
        const Vec3f negative = findFalseRadiance(-value, -1.0f, 1.0f, signedColorsOnBlack());
        EXPECT_NEAR(lightness(positive), kLightest * static_cast<double>(value), kTolerance) << i;
        EXPECT_NEAR(lightness(negative), kLightest * static_cast<double>(value), kTolerance) << i;
        EXPECT_GT(lightness(positive), last);
        EXPECT_GT(positive.x, positive.z);
        EXPECT_GT(negative.z, negative.x);
        last = lightness(positive);
    }
}

TEST(FalseColor, RadianceShowsAsTheColor) {
    ImageOf<float> values(51, 1);
    Image radiance(51, 1);
    for (int x = 0; x < 51; ++x) {
        values.at(x, 0) = 0.1f * static_cast<float>(x) - 2.5f;
        radiance.at(x, 0) = findFalseRadiance(values.at(x, 0), -2.0f, 2.0f, signedColors());
    }
    const Rgba8Image expected = drawFalseColors(values, -2.0f, 2.0f, signedColors());
    const Rgba8Image shown = encodeForDisplay(radiance, {0.0f, ToneCurve::none});
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        expectSameColor(shown.pixels[i], expected.pixels[i]);
}

}  // namespace
}  // namespace prt

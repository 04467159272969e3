#include "prt/image/false_color.h"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace prt

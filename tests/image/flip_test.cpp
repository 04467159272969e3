#include "prt/image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace prt {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

Rgba8 makePixel(int red, int green, int blue) {
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
            static_cast<std::uint8_t>(blue)};
}

/// Gradients, rings and squares.
Rgba8Image drawReference() {
    Rgba8Image image(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            image.at(x, y) = makePixel((x * 7 + y * 3) % 256, (x * x + 2 * y) % 251,
                                       40 + (x / 8 + y / 8) % 2 * 160);
    return image;
}

/// The same with a red rectangle, a black line and point, and a tenth less green.
Rgba8Image drawTest() {
    Rgba8Image image = drawReference();
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            Rgba8& pixel = image.at(x, y);
            if (x >= 20 && x < 30 && y >= 10 && y < 25) pixel = makePixel(250, 20, 20);
            if ((x == 45 && y == 30) || x == 55) pixel = makePixel(0, 0, 0);
            pixel.green = static_cast<std::uint8_t>(pixel.green * 9 / 10);
        }
    }
    return image;
}

/// What the program of the paper's authors (version 1.6) gives for this pair.
struct Published {
    double pixelsPerDegree;
    double mean;
    std::array<float, 6> places;
};

TEST(Flip, AgreesWithTheAuthorsProgram) {
    constexpr Published kPublished[] = {
        {67.02064, 0.3445545, {0.012865f, 0.891554f, 0.700139f, 0.378656f, 0.375986f, 0.300683f}},
        {30.0, 0.3498544, {0.005603f, 0.971375f, 0.919332f, 0.652239f, 0.396637f, 0.251961f}},
    };
    constexpr int kPlaces[6][2] = {{0, 0}, {25, 17}, {20, 10}, {45, 30}, {57, 40}, {40, 5}};
    constexpr double kFloatRounding = 2e-5;
    for (const Published& published : kPublished) {
        const ImageOf<float> map = measureFlip(drawTest(), drawReference(),
                                               {.pixelsPerDegree = published.pixelsPerDegree});
        EXPECT_NEAR(meanValue(map), published.mean, kFloatRounding);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(map.at(kPlaces[i][0], kPlaces[i][1]), published.places[i], 1e-4)
                << "place " << i;
    }
}

TEST(Flip, EqualPicturesDoNotDiffer) {
    const ImageOf<float> map = measureFlip(drawTest(), drawTest());
    EXPECT_EQ(map.width, kWidth);
    EXPECT_EQ(map.height, kHeight);
    EXPECT_EQ(*std::max_element(map.pixels.begin(), map.pixels.end()), 0.0f);
    EXPECT_EQ(meanValue(map), 0.0);
}

/// Lightness differs by 100 and nothing else does. The largest distance, of green (L* 87.7, a*
/// −75.6, b* 73.0, both faded by 0.01 L*) and blue (32.3, 25.6, −34.8), is 203.3. Of their powers
/// 0.7, 25.12 and 41.28, the first is beyond the knee at 0.4 · 41.28 = 16.51, so it becomes 0.95 +
/// 0.05 · (25.12 − 16.51) / (41.28 − 16.51).
TEST(Flip, BlackAgainstWhiteIsNearlyTheLargestDifference) {
    const Rgba8Image black(40, 30, makePixel(0, 0, 0)), white(40, 30, makePixel(255, 255, 255));
    const ImageOf<float> map = measureFlip(black, white);
    const auto [least, most] = std::minmax_element(map.pixels.begin(), map.pixels.end());
    EXPECT_NEAR(*least, 0.9674f, 2e-4f);
    EXPECT_NEAR(*most, 0.9674f, 2e-4f);
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
    const Rgba8Image green(40, 30, makePixel(0, 255, 0)), blue(40, 30, makePixel(0, 0, 255));
    EXPECT_NEAR(meanValue(measureFlip(green, blue)), 1.0, 1e-4);
}

TEST(Flip, IsSymmetric) {
    EXPECT_EQ(measureFlip(drawTest(), drawReference()).pixels,
              measureFlip(drawReference(), drawTest()).pixels);
}

TEST(Flip, FineNoiseIsSeenLessFromFurtherAway) {
    Rgba8Image checker(48, 48), grey(48, 48, makePixel(188, 188, 188));  // 188 is half of white
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x)
            checker.at(x, y) = (x + y) % 2 ? makePixel(255, 255, 255) : makePixel(0, 0, 0);
    const auto differ = [&](double pixelsPerDegree) {
        return meanValue(measureFlip(checker, grey, {.pixelsPerDegree = pixelsPerDegree}));
    };
    EXPECT_GT(differ(10.0), differ(30.0));
    EXPECT_GT(differ(30.0), differ(120.0));
    EXPECT_LT(differ(120.0), 0.1);
}

}  // namespace
}  // namespace prt

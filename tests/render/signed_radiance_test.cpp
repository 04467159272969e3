#include "prt/render/signed_radiance.h"

#include <gtest/gtest.h>

#include <vector>

#include "prt/image/false_color.h"

namespace prt {
namespace {

Vec3f colorOf(float fraction) {
    return findFalseRadiance(fraction, -1.0f, 1.0f, signedColorsOnBlack());
}

TEST(SignedRadiance, ColorIsTheLuminanceOverTheLargestWhateverTheBaseColor) {
    constexpr float kLargest = 64.0f;
    const std::vector<ExitRadiance> radiance = {
        {.perBaseColor = Vec3f(16.0f)},
        {.constant = Vec3f(-32.0f)},
        {.perBaseColor = Vec3f(-16.0f), .constant = Vec3f(-48.0f)},
        {},
        {.perBaseColor = {0.0f, 0.0f, 40.0f}}};
    const std::vector<ExitRadiance> shown = showSignedRadiance(radiance);
    ASSERT_EQ(shown.size(), radiance.size());
    const std::vector<float> fractions = {0.25f, -0.5f, -1.0f, 0.0f, 0.0722f * 40.0f / kLargest};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        EXPECT_EQ(shown[i].constant, colorOf(fractions[i])) << i;
        EXPECT_EQ(shown[i].perBaseColor, Vec3f(0.0f)) << i;
        EXPECT_EQ(shown[i].mirrorVisibility, 0.0f) << i;
    }
}

TEST(SignedRadiance, DarknessIsBlack) {
    for (const ExitRadiance& shown : showSignedRadiance(std::vector<ExitRadiance>(3)))
        EXPECT_EQ(shown.constant, Vec3f(0.0f));
    EXPECT_TRUE(showSignedRadiance({}).empty());
}

}  // namespace
}  // namespace prt

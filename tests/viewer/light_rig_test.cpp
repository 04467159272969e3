#include "apps/viewer/light_rig.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/resampling.h"
#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Sums of a few hundred products of doubles.
constexpr double kRounding = 1e-12;

Image makeNoise(int width, int height) {
    Image image(width, height);
    RandomStream random(7, 0);
    for (Vec3f& radiance : image.pixels)
        radiance = {random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat()};
    return image;
}

double largestDifference(const Lighting& a, const Lighting& b) {
    EXPECT_EQ(a.bandCount, b.bandCount);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
        const double length = (a.coefficients[i] - b.coefficients[i]).length();
        EXPECT_FALSE(std::isnan(length)) << i;
        largest = std::max(largest, length);
    }
    return largest;
}

Lighting projected(const LightRig& rig) {
    return projectLighting(rig.environment(), kMaxBandCount);
}

TEST(LightRig, ScalesTurnsAndAddsLights) {
    LightRig rig{ImageLimits{}};
    const std::vector<LightChoice> lights = {
        {.source = "uniform:0.2,0.4,0.6", .stops = 1.0},
        {.source = "sun:30,20,8", .stops = -2.0, .azimuthDegrees = 50.0}};
    rig.finish(lights);
    // About +y, azimuths fall, as they run from +x towards +z.
    const Vec3d direction(std::cos(20 * kDegree) * std::cos(-20 * kDegree), std::sin(20 * kDegree),
                          std::cos(20 * kDegree) * std::sin(-20 * kDegree));
    const Lighting expected = add(uniformLighting({0.4, 0.8, 1.2}, kMaxBandCount),
                                  scale(sunLighting(direction, 4 * kDegree, kMaxBandCount), 0.25));
    EXPECT_LT(largestDifference(rig.sum(), expected), kRounding);
}

TEST(LightRig, EnvironmentIsTheSameLightAsTheSum) {
    // The sun's disc covers hundreds of texels; the noise is turned by a part of one of its own.
    constexpr double kPicture = 5e-3;
    const test::TemporaryFolder folder;
    writeExr(folder.path() / "noise.exr", makeNoise(64, 32));
    LightRig rig{ImageLimits{}};
    const std::vector<LightChoice> lights = {
        {.source = "uniform:0.2,0.4,0.6", .stops = 1.0},
        {.source = "sun:30,20,8", .azimuthDegrees = 50.0},
        {.source = folder.path() / "noise.exr", .stops = 0.5, .azimuthDegrees = -77.0}};
    rig.finish(lights);
    EXPECT_LT(largestDifference(projected(rig), rig.sum()),
              kPicture * rig.sum().coefficients[0].length());
    EXPECT_EQ(rig.environment().map, SphereMap::latLong);
}

TEST(LightRig, ImagesOfAnySizeKeepTheirLightInTheSum) {
    // Texels are averaged in floats.
    constexpr double kFloats = 1e-5;
    const test::TemporaryFolder folder;
    for (const int height : {9, 32, 50}) {
        writeExr(folder.path() / "noise.exr", makeNoise(2 * height, height));
        writeExr(folder.path() / "black.exr", Image(64, 32));
        LightRig rig{ImageLimits{}};
        const std::vector<LightChoice> lights = {{.source = folder.path() / "noise.exr"},
                                                 {.source = folder.path() / "black.exr"}};
        rig.finish(lights);
        EXPECT_EQ(rig.environment().radiance.height, std::max(height, 32));
        EXPECT_LT((projected(rig).coefficients[0] - rig.sum().coefficients[0]).length(), kFloats);
    }
}

TEST(LightRig, ASingleImageIsShownAsItIs) {
    const test::TemporaryFolder folder;
    const Image noise = makeNoise(64, 32);
    writeExr(folder.path() / "noise.exr", noise);
    LightRig rig{ImageLimits{}};
    LightChoice light{.source = folder.path() / "noise.exr"};
    rig.finish({&light, 1});
    EXPECT_EQ(rig.environment().radiance.pixels, noise.pixels);
    const std::shared_ptr<const Environment> kept = rig.sharedEnvironment();
    EXPECT_EQ(kept.get(), &rig.environment());

    // Turned by whole texels it is the same ones.
    constexpr int kColumns = 5;
    light.azimuthDegrees = 360.0 / 64 * kColumns;
    rig.update({&light, 1});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            EXPECT_LT(
                (rig.environment().radiance.at(x, y) - noise.at((x + kColumns) % 64, y)).length(),
                1e-6f);
    EXPECT_LT(largestDifference(projected(rig), rig.sum()), 1e-6);
    EXPECT_EQ(kept->radiance.pixels, noise.pixels);
}

TEST(LightRig, OtherMapsBecomeLatLong) {
    constexpr double kResampled = 0.01;
    const test::TemporaryFolder folder;
    const Environment cross = resample({SphereMap::latLong, makeNoise(16, 8)},
                                       SphereMap::horizontalCross, 4 * 32, 3 * 32);
    writeExr(folder.path() / "cross.exr", cross.radiance);
    LightRig rig{ImageLimits{}};
    const LightChoice light{.source = folder.path() / "cross.exr"};
    rig.finish({&light, 1});
    EXPECT_EQ(rig.environment().map, SphereMap::latLong);
    EXPECT_EQ(rig.environment().radiance.height, 64);
    EXPECT_LT(largestDifference(projected(rig), rig.sum()),
              kResampled * rig.sum().coefficients[0].length());
}

TEST(LightRig, AWrongLightIsToldAndDisturbsNoOther) {
    const test::TemporaryFolder folder;
    test::writeText(folder.path() / "text.exr", "no image");
    Image bad = makeNoise(8, 4);
    bad.at(1, 1).x = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder.path() / "nan.exr", bad);
    LightRig rig{ImageLimits{}};
    const std::vector<LightChoice> lights = {{.source = folder.path() / "text.exr"},
                                             {.source = "uniform:1"},
                                             {.source = "sun:up"},
                                             {.source = folder.path() / "nan.exr", .isOn = false},
                                             {.source = folder.path() / "missing.hdr"}};
    rig.finish(lights);
    using Stage = LoadingStatus::Stage;
    const auto statuses = rig.statuses();
    ASSERT_EQ(statuses.size(), lights.size());
    for (const std::size_t wrong : {0, 2, 4}) {
        EXPECT_EQ(statuses[wrong].stage, Stage::failed);
        EXPECT_NE(statuses[wrong].message.find(lights[wrong].source), std::string::npos);
    }
    EXPECT_EQ(statuses[1].stage, Stage::ready);
    EXPECT_EQ(statuses[1].message, "");
    EXPECT_EQ(statuses[3].stage, Stage::ready);
    EXPECT_NE(statuses[3].message.find("mended"), std::string::npos);
    EXPECT_LT(largestDifference(rig.sum(), uniformLighting(Vec3d(1.0), kMaxBandCount)), kRounding);
}

TEST(LightRig, RevisionChangesWithTheSumAndOnlyThen) {
    LightRig rig{ImageLimits{}};
    std::vector<LightChoice> lights = {{.source = "uniform:1"}, {.source = "uniform:2"}};
    rig.finish(lights);
    const std::size_t first = rig.revision();
    rig.update(lights);
    EXPECT_EQ(rig.revision(), first);
    lights[1].isOn = false;
    rig.update(lights);
    EXPECT_NE(rig.revision(), first);
    EXPECT_LT(largestDifference(rig.sum(), uniformLighting(Vec3d(1.0), kMaxBandCount)), kRounding);
    rig.update({});
    EXPECT_EQ(largestDifference(rig.sum(), Lighting(kMaxBandCount)), 0.0);
    EXPECT_EQ(largestDifference(projected(rig), Lighting(kMaxBandCount)), 0.0);
    EXPECT_TRUE(rig.statuses().empty());
}

TEST(LightRig, ReadsInTheBackground) {
    LightRig rig{ImageLimits{}};
    const LightChoice light{.source = "sky:10,40"};
    rig.update({&light, 1});
    // However long that takes: what is not read adds nothing.
    while (rig.statuses()[0].stage == LoadingStatus::Stage::waiting) {
        EXPECT_EQ(rig.sum().coefficients[0].x, 0.0);
        rig.update({&light, 1});
    }
    EXPECT_GT(rig.sum().coefficients[0].x, 0.0);
}

TEST(LightRig, ALightThatIsReplacedShinesUntilTheOtherHasBeenRead) {
    LightRig rig{ImageLimits{}};
    LightChoice light{.source = "uniform:1"};
    rig.finish({&light, 1});
    const std::size_t before = rig.revision();
    light.source = "sky:10,40";
    rig.update({&light, 1});
    while (rig.statuses()[0].stage == LoadingStatus::Stage::waiting) {
        EXPECT_EQ(rig.revision(), before);
        EXPECT_LT(largestDifference(rig.sum(), uniformLighting(Vec3d(1.0), kMaxBandCount)),
                  kRounding);
        rig.update({&light, 1});
    }
    EXPECT_NE(rig.revision(), before);
    light.source = "no such light";
    rig.finish({&light, 1});
    EXPECT_EQ(rig.sum().coefficients[0].x, 0.0);
}

}  // namespace
}  // namespace prt::viewer

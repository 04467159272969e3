#include "apps/viewer/lat_long_size.h"

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/light/environment.h"

namespace prt::viewer {
namespace {

Image makeNoise(int height) {
    Image image(2 * height, height);
    RandomStream random(5, 0);
    for (Vec3f& radiance : image.pixels)
        radiance = {random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat()};
    return image;
}

Lighting project(const Image& image, int bandCount) {
    return projectLighting({SphereMap::latLong, image}, bandCount);
}

/// Means are taken in floats.
constexpr double kFloats = 1e-5;

TEST(LatLongSize, KeepsFluxAtEverySize) {
    for (const int from : {1, 9, 32, 50})
        for (const int to : {1, 2, 9, 32, 37, 100}) {
            const Image image = makeNoise(from);
            const Image resized = resizeLatLong(image, to);
            EXPECT_EQ(resized.width, 2 * to);
            const Vec3d flux = project(image, 1).coefficients[0];
            EXPECT_LT((project(resized, 1).coefficients[0] - flux).length(), kFloats)
                << from << " to " << to;
        }
}

TEST(LatLongSize, WhatIsCutIntoWholePartsIsTheSameLight) {
    const Image image = makeNoise(10);
    const Image cut = resizeLatLong(image, 30);
    const Lighting a = project(image, 6), b = project(cut, 6);
    for (std::size_t i = 0; i < a.coefficients.size(); ++i)
        EXPECT_LT((a.coefficients[i] - b.coefficients[i]).length(), kFloats) << i;
    const Image back = resizeLatLong(cut, 10);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        EXPECT_TRUE(back.pixels[i].equalWithAbsError(image.pixels[i], 1e-6f));
}

TEST(LatLongSize, AConstantStaysConstant) {
    for (const Vec3f& radiance : resizeLatLong(Image(34, 17, Vec3f(3.0f)), 11).pixels)
        EXPECT_TRUE(radiance.equalWithAbsError(Vec3f(3.0f), 1e-5f));
}

}  // namespace
}  // namespace prt::viewer

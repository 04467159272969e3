#include "prt/image/image.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

TEST(Image, IsRowMajorAndBlackUnlessToldOtherwise) {
    Image image(3, 2);
    for (const Vec3f& pixel : image.pixels)
        EXPECT_EQ(pixel, Vec3f(0.0f));
    image.at(2, 1) = Vec3f(1.0f, 2.0f, 3.0f);
    EXPECT_EQ(image.pixels[5], Vec3f(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(Image(2, 2, Vec3f(7.0f)).at(1, 0), Vec3f(7.0f));
}

TEST(Image, AnEncodedImageIsOpaqueWhiteUnlessToldOtherwise) {
    const Rgba8Image image(1, 1);
    EXPECT_EQ(image.at(0, 0).red, 255);
    EXPECT_EQ(image.at(0, 0).alpha, 255);
}

}  // namespace
}  // namespace prt

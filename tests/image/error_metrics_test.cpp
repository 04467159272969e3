#include "prt/image/error_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace prt {
namespace {

TEST(ErrorMetrics, AConstantDifferenceIsTheError) {
    const Image reference(5, 3, Vec3f(1.0f, 2.0f, 2.0f));  // root mean square √3
    const Image image(5, 3, Vec3f(1.5f, 1.5f, 2.5f));
    const ImageError error = measureError(image, reference);
    EXPECT_NEAR(error.rmse, 0.5, 1e-12);
    EXPECT_NEAR(error.relativeRmse, 0.5 / std::sqrt(3.0), 1e-12);
}

TEST(ErrorMetrics, OnePixelOfManyCountsByItsSquare) {
    const Image reference(4, 4, Vec3f(0.0f, 1.0f, 0.0f));
    Image image = reference;
    image.at(1, 2).x = 4.0f;
    const ImageError error = measureError(image, reference);
    EXPECT_NEAR(error.rmse, std::sqrt(16.0 / 48.0), 1e-12);
    EXPECT_NEAR(error.relativeRmse, 1.0, 1e-12);
}

TEST(ErrorMetrics, EqualPicturesHaveNoErrorBlackOnesToo) {
    const Image black(2, 2);
    EXPECT_EQ(measureError(black, black).rmse, 0.0);
    EXPECT_EQ(measureError(black, black).relativeRmse, 0.0);
    EXPECT_EQ(measurePsnr(Rgba8Image(2, 2), Rgba8Image(2, 2)),
              std::numeric_limits<double>::infinity());
}

TEST(ErrorMetrics, PsnrIsDecibelsBelowThePeak) {
    const Rgba8Image reference(6, 2, {100, 100, 100, 255});
    // Off by 5 everywhere: 20 log10(51).
    EXPECT_NEAR(measurePsnr(Rgba8Image(6, 2, {105, 95, 105, 0}), reference), 34.1514, 1e-4);
    EXPECT_NEAR(measurePsnr(Rgba8Image(6, 2, {0, 0, 0, 0}), Rgba8Image(6, 2)), 0.0, 1e-12);
}

}  // namespace
}  // namespace prt

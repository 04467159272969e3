#include "prt/basis/sh_convention.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

const ShConvention kAll[] = {ShConvention::cs, ShConvention::rh, ShConvention::d3dx,
                             ShConvention::three};

TEST(ShConvention, NamesLeadBackToTheConventions) {
    for (const ShConvention convention : kAll) {
        EXPECT_EQ(parseShConvention(shConventionName(convention)), convention);
    }
    EXPECT_EQ(parseShConvention("rh"), ShConvention::rh);
    EXPECT_EQ(parseShConvention("unity"), std::nullopt);
}

// The first nine functions as published without phase, in axes of the publication
// [Ramamoorthi01, eq. 3; three.js shGetIrradianceAt].
std::vector<double> evaluateWithoutPhase(const Vec3d& d) {
    return {0.282095,
            0.488603 * d.y,
            0.488603 * d.z,
            0.488603 * d.x,
            1.092548 * d.x * d.y,
            1.092548 * d.y * d.z,
            0.315392 * (3.0 * d.z * d.z - 1.0),
            1.092548 * d.x * d.z,
            0.546274 * (d.x * d.x - d.y * d.y)};
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

TEST(Conventions, C2_OtherConventionsGiveTheSameRadianceInTheirOwnBasisAndAxes) {
    constexpr double kPrintedPrecision = 1e-5;
    const std::vector<double> ours = {0.8, -0.3, 0.5, 0.1, -0.7, 0.2, 0.4, -0.6, 0.9};
    for (const auto& [direction, weight] : sphereQuadrature(6)) {
        const double radiance = reconstructSh(ours, 3, direction);
        const Vec3d leftHanded(direction.x, direction.y, -direction.z);

        std::vector<double> three = ours;
        convertSh(ShConvention::three, three);
        EXPECT_NEAR(dot(three, evaluateWithoutPhase(direction)), radiance, kPrintedPrecision);

        std::vector<double> rh = ours;
        convertSh(ShConvention::rh, rh);
        EXPECT_NEAR(dot(rh, evaluateWithoutPhase(leftHanded)), radiance, kPrintedPrecision);

        std::vector<double> d3dx = ours;
        convertSh(ShConvention::d3dx, d3dx);
        EXPECT_NEAR(reconstructSh(d3dx, 3, leftHanded), radiance, kPrintedPrecision);
    }
}

TEST(ShConvention, TheSameSignsLeadBack) {
    std::vector<double> source(100);
    for (std::size_t i = 0; i < source.size(); ++i)
        source[i] = std::cos(static_cast<double>(i));
    for (const ShConvention convention : kAll) {
        std::vector<double> converted = source;
        convertSh(convention, converted);
        EXPECT_EQ(converted == source, convention == ShConvention::cs);
        convertSh(convention, converted);
        EXPECT_EQ(converted, source);
    }
}

// Two publications of the Grace Cathedral probe, from the same axes, differ
// by the phase and one exposure.
TEST(ShConvention, LeadsFromOnePublishedGraceCathedralToTheOther) {
    constexpr double kPublishedRelativeError = 0.01;
    const std::vector<double> rh = {.78908,  .39499,  -.33974, -.29213, -.11141,
                                    -.26240, -.15570, .56014,  .21205};
    const std::vector<double> d3dx = {10.153550, -5.060791, -4.349408, 3.761966, -1.427276,
                                      3.347004,  -2.050089, -7.148068, 2.724446};
    std::vector<double> converted = rh;
    convertSh(ShConvention::rh, converted);
    convertSh(ShConvention::d3dx, converted);
    const double exposure = dot(converted, d3dx) / dot(converted, converted);
    for (std::size_t i = 0; i < rh.size(); ++i) {
        EXPECT_NEAR(exposure * converted[i], d3dx[i], kPublishedRelativeError * d3dx[0]);
    }
}

}  // namespace
}  // namespace prt

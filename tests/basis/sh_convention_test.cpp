#include "prt/basis/sh_convention.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"
#include "tests/support/published_probes.h"

namespace prt {
namespace {

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

/// What an albedo of 1 reflects, irradiance over π, by the convolution theorem [Ramamoorthi01].
double reflect(const std::vector<double>& radiance, const Vec3d& normal) {
    const double factors[] = {1.0, 2.0 / 3.0, 0.25};
    std::vector<double> convolved = radiance;
    for (std::size_t i = 0; i < convolved.size(); ++i)
        convolved[i] *= factors[shDegree(static_cast<int>(i))];
    return reconstructSh(convolved, 3, normal);
}

/// How a program that uses a convention computes what it shows, as its own sources do, and
/// whether that is radiance in a direction or what an albedo of 1 reflects.
struct Program {
    ShConvention convention;
    bool showsReflection;
    std::function<double(const std::vector<double>& coefficients, const Vec3d& ours)> show;
};

double evaluatePolynomial(const std::vector<double>& c, const Vec3d& n) {
    return c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * n.y * n.x + c[5] * n.y * n.z +
           c[6] * (3.0 * n.z * n.z - 1.0) + c[7] * n.z * n.x + c[8] * (n.x * n.x - n.y * n.y);
}

/// Unity's SphericalHarmonicsL2 as its engine packs it into constants, and ShadeSH9 reads them.
double evaluateUnity(const std::vector<double>& c, const Vec3d& ours) {
    const Vec3d n(-ours.x, ours.y, ours.z);
    const double linear = c[3] * n.x + c[1] * n.y + c[2] * n.z + (c[0] - c[6]);
    const double quadratic =
        c[4] * n.x * n.y + c[5] * n.y * n.z + 3.0 * c[6] * n.z * n.z + c[7] * n.z * n.x;
    return linear + quadratic + c[8] * (n.x * n.x - n.y * n.y);
}

/// Godot's capture of a lightmap: the nine-coefficient form of [Ramamoorthi01] is ambient light.
double evaluateGodot(const std::vector<double>& c, const Vec3d& n) {
    constexpr double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
    return c1 * c[8] * (n.x * n.x - n.y * n.y) + c3 * c[6] * n.z * n.z + c4 * c[0] - c5 * c[6] +
           2.0 * c1 * (c[4] * n.x * n.y + c[7] * n.x * n.z + c[5] * n.y * n.z) +
           2.0 * c2 * (c[3] * n.x + c[1] * n.y + c[2] * n.z);
}

/// The colour of a Gaussian [Kerbl23], the same constants with their signs, and a half.
double evaluateGaussian(const std::vector<double>& c, const Vec3d& d) {
    return 0.5 + 0.282095 * c[0] - 0.488603 * d.y * c[1] + 0.488603 * d.z * c[2] -
           0.488603 * d.x * c[3] + 1.092548 * d.x * d.y * c[4] - 1.092548 * d.y * d.z * c[5] +
           0.315392 * (2.0 * d.z * d.z - d.x * d.x - d.y * d.y) * c[6] -
           1.092548 * d.x * d.z * c[7] + 0.546274 * (d.x * d.x - d.y * d.y) * c[8];
}

std::vector<Program> programs() {
    const auto turnZ = [](const Vec3d& d) { return Vec3d(d.x, d.y, -d.z); };
    return {
        {ShConvention::cs, false,
         [](const auto& c, const Vec3d& d) { return reconstructSh(c, 3, d); }},
        {ShConvention::rh, false,
         [=](const auto& c, const Vec3d& d) { return dot(c, evaluateWithoutPhase(turnZ(d))); }},
        {ShConvention::d3dx, false,
         [=](const auto& c, const Vec3d& d) { return reconstructSh(c, 3, turnZ(d)); }},
        {ShConvention::three, false,
         [](const auto& c, const Vec3d& d) { return dot(c, evaluateWithoutPhase(d)); }},
        {ShConvention::filament, true, evaluatePolynomial},
        {ShConvention::unity, true, evaluateUnity},
        {ShConvention::godot, true, evaluateGodot},
        {ShConvention::gaussians, false, evaluateGaussian},
    };
}

TEST(ShConvention, NamesLeadBackToTheConventions) {
    for (const ShConvention convention : allShConventions())
        EXPECT_EQ(parseShConvention(shConventionName(convention)), convention);
    EXPECT_EQ(parseShConvention("rh"), ShConvention::rh);
    EXPECT_EQ(parseShConvention("3dgs"), ShConvention::gaussians);
    EXPECT_EQ(parseShConvention("unreal"), std::nullopt);
    EXPECT_EQ(programs().size(), allShConventions().size()) << "each has its program below";
}

TEST(Conventions, C2_EveryProgramShowsTheSameLight) {
    constexpr double kPrintedPrecision = 1e-5;
    const std::vector<double> ours = {0.8, -0.3, 0.5, 0.1, -0.7, 0.2, 0.4, -0.6, 0.9};
    for (const Program& program : programs()) {
        std::vector<double> theirs = ours;
        convertShTo(program.convention, theirs);
        for (const auto& [direction, weight] : sphereQuadrature(6)) {
            const double truth = program.showsReflection ? reflect(ours, direction)
                                                         : reconstructSh(ours, 3, direction);
            EXPECT_NEAR(program.show(theirs, direction), truth, kPrintedPrecision)
                << shConventionName(program.convention);
        }
    }
}

TEST(ShConvention, LightFromAnAxisBrightensThatSide) {
    for (const Program& program : programs()) {
        for (const Vec3d& axis : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}) {
            std::vector<double> light(9);
            evaluateSh(axis, 3, light);
            convertShTo(program.convention, light);
            EXPECT_GT(program.show(light, axis), program.show(light, -axis) + 0.1)
                << shConventionName(program.convention);
        }
    }
}

TEST(ShConvention, AConversionLeadsBack) {
    constexpr double kRounding = 1e-15;
    for (const ShConvention convention : allShConventions()) {
        const int bandCount = std::min(maxBandCount(convention), 10);
        std::vector<double> source(static_cast<std::size_t>(shCoefficientCount(bandCount)));
        for (std::size_t i = 0; i < source.size(); ++i)
            source[i] = std::cos(static_cast<double>(i));
        std::vector<double> converted = source;
        convertShTo(convention, converted);
        EXPECT_EQ(converted == source, convention == ShConvention::cs);
        convertShFrom(convention, converted);
        for (std::size_t i = 0; i < source.size(); ++i)
            EXPECT_NEAR(converted[i], source[i], kRounding);
    }
}

// Two publications of the same five probes, from the same axes, differ by the phase and one
// exposure each.
TEST(ShConvention, LeadsFromOnePublicationOfFiveProbesToTheOther) {
    constexpr double kPublishedRelativeRms = 0.005;
    for (const PublishedProbe& probe : kPublishedProbes) {
        double squaredError = 0.0, squaredSum = 0.0;
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<double> converted;
            for (const Vec3d& coefficient : probe.rh)
                converted.push_back(coefficient[channel]);
            convertShFrom(ShConvention::rh, converted);
            convertShTo(ShConvention::d3dx, converted);
            for (std::size_t i = 0; i < converted.size(); ++i) {
                const double truth = probe.d3dx[i][channel];
                squaredError += std::pow(probe.exposure * converted[i] - truth, 2.0);
                squaredSum += truth * truth;
            }
        }
        EXPECT_LT(std::sqrt(squaredError / squaredSum), kPublishedRelativeRms) << probe.name;
    }
}

}  // namespace
}  // namespace prt

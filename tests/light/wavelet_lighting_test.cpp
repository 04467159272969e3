#include "prt/light/wavelet_lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/haar.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

// Floats of size 1, added up in trees of a dozen levels.
constexpr double kRounding = 2e-6;

template <class Function>
Environment drawCube(int faceSize, Function radiance) {
    Environment cube{SphereMap::verticalStrip, Image(faceSize, 6 * faceSize)};
    for (int y = 0; y < cube.radiance.height; ++y)
        for (int x = 0; x < faceSize; ++x)
            cube.radiance.at(x, y) = Vec3f(
                radiance(sphereTexel(cube.map, faceSize, cube.radiance.height, x, y).direction));
    return cube;
}

Environment randomCube(int faceSize, std::uint64_t stream) {
    RandomStream random(10, stream);
    return drawCube(faceSize, [&](const Vec3d&) {
        return Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat());
    });
}

/// A small bright disc, some 10 texels wide on faces of 64, in a dim room.
Environment lampInADimRoom() {
    const Vec3d lamp = Vec3d(3.0, 1.0, -1.5).normalized();
    return drawCube(64, [&](const Vec3d& direction) {
        const Vec3f dim(0.1f + 0.05f * static_cast<float>(direction.y));
        return direction.dot(lamp) > std::cos(0.12) ? Vec3f(50.0f, 40.0f, 20.0f) : dim;
    });
}

/// ‖a − b‖ / ‖b‖ over texels, or over the sphere.
double relativeError(const Environment& a, const Environment& b, bool overSphere) {
    double difference = 0.0, size = 0.0;
    for (int y = 0; y < b.radiance.height; ++y)
        for (int x = 0; x < b.radiance.width; ++x) {
            const double weight =
                overSphere
                    ? sphereTexel(b.map, b.radiance.width, b.radiance.height, x, y).solidAngle
                    : 1.0;
            const Vec3d truth(b.radiance.at(x, y));
            difference += weight * (Vec3d(a.radiance.at(x, y)) - truth).length2();
            size += weight * truth.length2();
        }
    return std::sqrt(difference / size);
}

Environment keepLargest(const WaveletLighting& lighting, std::size_t count) {
    return reconstructCube(expand(selectLargest(lighting, count)));
}

TEST(WaveletLighting, EachFaceHasItsOwnCoefficients) {
    const Environment cube = randomCube(8, 1);
    const WaveletLighting lighting = projectWavelets(cube);
    EXPECT_EQ(lighting.faceSize, 8);
    ASSERT_EQ(lighting.coefficients.size(), 6u * 64u);
    for (std::size_t face = 0; face < 6; ++face) {
        std::vector<Vec3f> texels, coefficients(64);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                texels.push_back(cube.radiance.at(x, static_cast<int>(face) * 8 + y));
        projectHaar(texels, coefficients);
        for (std::size_t i = 0; i < 64; ++i)
            ASSERT_EQ(lighting.coefficients[face * 64 + i], coefficients[i]) << face << ", " << i;
    }
}

TEST(WaveletLighting, AConstantIsSixCoefficients) {
    const Vec3f radiance(1.0f, 2.0f, 0.5f);
    const WaveletLighting lighting =
        projectWavelets(drawCube(16, [&](const Vec3d&) { return radiance; }));
    const SparseWaveletLighting sparse = selectLargest(lighting, 100);
    ASSERT_EQ(sparse.coefficients.size(), 6u);
    for (std::size_t face = 0; face < 6; ++face) {
        EXPECT_EQ(sparse.coefficients[face].index, face * 256);
        EXPECT_EQ(sparse.coefficients[face].value, radiance * 16.0f);
    }
}

// A20
TEST(WaveletLighting, AllCoefficientsAreTheCube) {
    for (const int faceSize : {1, 2, 64}) {
        const Environment cube = randomCube(faceSize, 2);
        const Environment back =
            keepLargest(projectWavelets(cube), 6 * cube.radiance.pixels.size());
        EXPECT_EQ(back.map, SphereMap::verticalStrip);
        EXPECT_EQ(back.radiance.width, cube.radiance.width);
        ASSERT_EQ(back.radiance.height, cube.radiance.height);
        for (std::size_t t = 0; t < cube.radiance.pixels.size(); ++t)
            ASSERT_LT((back.radiance.pixels[t] - cube.radiance.pixels[t]).length(), kRounding);
    }
}

// A20
TEST(WaveletLighting, TheErrorOfNCoefficientsIsTheEnergyOfTheOthers) {
    const Environment cube = lampInADimRoom();
    const WaveletLighting lighting = projectWavelets(cube);
    const std::vector<std::size_t> counts = {1, 10, 100, 400, 1000};
    const std::vector<double> errors = selectionErrors(lighting.coefficients, counts);
    for (std::size_t n = 0; n < counts.size(); ++n)
        EXPECT_NEAR(relativeError(keepLargest(lighting, counts[n]), cube, false), errors[n], 1e-5)
            << counts[n];
}

TEST(WaveletLighting, ExpansionPutsWhatWasKeptInItsPlace) {
    const SparseWaveletLighting sparse{
        2, {{1, Vec3f(1.0f, 2.0f, 3.0f)}, {23, Vec3f(4.0f, 5.0f, 6.0f)}}};
    const WaveletLighting lighting = expand(sparse);
    ASSERT_EQ(lighting.coefficients.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i)
        EXPECT_EQ(lighting.coefficients[i], i == 1    ? sparse.coefficients[0].value
                                            : i == 23 ? sparse.coefficients[1].value
                                                      : Vec3f(0.0f));
}

// [24]: a hundred wavelets, chosen for the light, hold a lamp that neither the hundred coarsest
// ones nor ten bands hold.
TEST(WaveletLighting, LargestCoefficientsHoldASmallLampThatLinearOnesBlur) {
    const Environment cube = lampInADimRoom();
    WaveletLighting lighting = projectWavelets(cube);
    const double largest = relativeError(keepLargest(lighting, 96), cube, true);

    const Lighting bands = projectLighting(cube, 10);
    const Environment sh =
        drawCube(64, [&](const Vec3d& direction) { return Vec3f(reconstruct(bands, direction)); });

    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
        if (i % 4096 >= 16) lighting.coefficients[i] = Vec3f(0.0f);
    const double first = relativeError(reconstructCube(lighting), cube, true);

    EXPECT_LT(largest, 0.25);
    EXPECT_GT(first, 0.7);
    EXPECT_GT(relativeError(sh, cube, true), 0.7);
}

/// ∫ L T dω by all coefficients, for functions of direction.
template <class Radiance, class Transfer>
Vec3d integrate(int faceSize, Radiance radiance, Transfer transfer) {
    std::vector<float> values;
    for (const Vec3f& value : drawCube(faceSize, [&](const Vec3d& direction) {
                                  return Vec3d(transfer(direction));
                              }).radiance.pixels)
        values.push_back(value.x);
    const WaveletLighting lighting = projectWavelets(drawCube(faceSize, radiance));
    return integrateProduct(selectLargest(lighting, lighting.coefficients.size()),
                            projectWaveletTransfer(faceSize, values));
}

TEST(WaveletProduct, OfConstantsIsTheSphere) {
    for (const int faceSize : {1, 2, 64}) {
        const Vec3d product = integrate(
            faceSize, [](const Vec3d&) { return Vec3d(1.0, 2.0, 0.5); },
            [](const Vec3d&) { return 3.0; });
        EXPECT_LT((product / (12.0 * kPi) - Vec3d(1.0, 2.0, 0.5)).length(), kRounding);
    }
}

TEST(WaveletProduct, UnderAConstantSkyIrradianceOverPiIsTheRadiance) {
    const Vec3d normal = Vec3d(1.0, 2.0, 3.0).normalized();
    const Vec3d product = integrate(
        64, [](const Vec3d&) { return Vec3d(1.0, 2.0, 0.5); },
        [&](const Vec3d& direction) { return std::max(normal.dot(direction), 0.0) / kPi; });
    // A texel counts at its centre: some part in 64².
    EXPECT_LT((product - Vec3d(1.0, 2.0, 0.5)).length(), 1e-3);
}

// ∫ (a·ω)² (b·ω)² dω = 4π/15 (1 + 2 (a·b)²) for unit a and b.
TEST(WaveletProduct, OfSmoothFunctionsConvergesWithTheSquareOfTheTexel) {
    const Vec3d a = Vec3d(1.0, 2.0, 3.0).normalized(), b = Vec3d(-2.0, 1.0, 0.5).normalized();
    const double truth = 4.0 * kPi / 15.0 * (1.0 + 2.0 * a.dot(b) * a.dot(b));
    const auto squareOf = [](const Vec3d& axis) {
        return [axis](const Vec3d& direction) { return axis.dot(direction) * axis.dot(direction); };
    };
    const auto errorAt = [&](int faceSize) {
        const auto radiance = [&](const Vec3d& w) { return Vec3d(squareOf(a)(w)); };
        return std::abs(integrate(faceSize, radiance, squareOf(b)).x / truth - 1.0);
    };
    EXPECT_LT(errorAt(32), 2e-3);
    EXPECT_NEAR(errorAt(8) / errorAt(16), 4.0, 0.3);
    EXPECT_NEAR(errorAt(16) / errorAt(32), 4.0, 0.3);
}

// However rough the light: exact where radiance is constant in each texel.
TEST(WaveletProduct, IsTheSumOverTexels) {
    const Environment light = randomCube(16, 4);
    const Environment transport = randomCube(16, 5);
    std::vector<float> transfer;
    Vec3d truth(0.0);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 16; ++x) {
            transfer.push_back(transport.radiance.at(x, y).x);
            truth += Vec3d(light.radiance.at(x, y)) *
                     (transfer.back() * sphereTexel(light.map, 16, 96, x, y).solidAngle);
        }
    const Vec3d product = integrateProduct(selectLargest(projectWavelets(light), 1536),
                                           projectWaveletTransfer(16, transfer));
    EXPECT_LT((product - truth).length(), 4.0 * kPi * kRounding);
}

TEST(WaveletLightingDeathTest, OtherEnvironmentsAreRefused) {
    EXPECT_DEATH(projectWavelets({SphereMap::verticalStrip, Image(3, 18)}), "side of a face");
    EXPECT_DEATH(projectWavelets({SphereMap::verticalStrip, Image()}), "side of a face");
    EXPECT_DEATH(projectWavelets({SphereMap::verticalStrip, Image(4, 20)}), "a vertical strip");
    EXPECT_DEATH(projectWavelets({SphereMap::latLong, Image(4, 24)}), "a vertical strip");
}

}  // namespace
}  // namespace prt

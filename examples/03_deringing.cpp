// Why a light is de-ringed: a yellow sun and a dim white sky, on a white sphere that turns its
// shadow side to us. In three bands the sun is negative in places; there it takes red and green
// away from the sky, and what is left is blue.
//
// From the left: the truth, three bands, the same with a Hann window, and with the window of
// deringingFactors. Above the sphere, below the light itself, all round.
//
//   03_deringing OUT.png

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/deringing.h"
#include "prt/light/environment.h"
#include "prt/light/irradiance.h"

namespace {

constexpr int kSize = 320;

constexpr double kSunHalfAngle = 0.1;
const prt::Vec3d kTowardsSun = prt::Vec3d(-0.8, 0.45, -0.4).normalized();
const prt::Vec3d kSunIrradiance(4.0, 4.0, 0.0);
const prt::Vec3d kSkyRadiance(0.03);

prt::Lighting makeYellowSunAndWhiteSky(int bandCount) {
    prt::Lighting sun = prt::sunLighting(kTowardsSun, kSunHalfAngle, bandCount);
    for (prt::Vec3d& coefficient : sun.coefficients)
        coefficient *= kSunIrradiance;
    return prt::add(sun, prt::uniformLighting(kSkyRadiance, bandCount));
}

/// The same as it is, without any basis.
prt::Image drawYellowSunAndWhiteSky() {
    const double projectedSolidAngle = std::numbers::pi * std::pow(std::sin(kSunHalfAngle), 2.0);
    prt::Image image(kSize, kSize / 2);
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const auto texel =
                prt::sphereTexel(prt::SphereMap::latLong, kSize, kSize / 2, column, row);
            const bool isSun = texel.direction.dot(kTowardsSun) > std::cos(kSunHalfAngle);
            image.at(column, row) = prt::Vec3f(
                isSun ? kSkyRadiance + kSunIrradiance / projectedSolidAngle : kSkyRadiance);
        }
    }
    return image;
}

/// A white sphere seen from +z, a pixel its radiance; around it black.
prt::Image drawSphere(const prt::Lighting& lighting) {
    const prt::Lighting irradiance = prt::convolveWithCosine(lighting);
    prt::Image image(kSize, kSize);
    for (int row = 0; row < kSize; ++row) {
        for (int column = 0; column < kSize; ++column) {
            const double x = 2.1 * ((column + 0.5) / kSize - 0.5);
            const double y = 2.1 * (0.5 - (row + 0.5) / kSize);
            const double squaredZ = 1.0 - x * x - y * y;
            if (squaredZ < 0.0) continue;
            const prt::Vec3d normal(x, y, std::sqrt(squaredZ));
            image.at(column, row) =
                prt::Vec3f(prt::reconstruct(irradiance, normal) / std::numbers::pi);
        }
    }
    return image;
}

void copyTo(prt::Image& picture, const prt::Image& part, int left, int top) {
    for (int row = 0; row < part.height; ++row) {
        for (int column = 0; column < part.width; ++column)
            picture.at(left + column, top + row) = part.at(column, row);
    }
}

void printLowest(const char* name, const prt::Image& image) {
    prt::Vec3f lowest = image.pixels.front();
    for (const prt::Vec3f& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            lowest[channel] = std::min(lowest[channel], pixel[channel]);
    }
    std::printf("%-12s lowest radiance: red %7.4f  green %7.4f  blue %7.4f\n", name,
                static_cast<double>(lowest.x), static_cast<double>(lowest.y),
                static_cast<double>(lowest.z));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    try {
        constexpr int kBandCount = 3;
        constexpr int kManyBands = 40;  // irradiance from so many is the truth to 0.1 %
        const prt::Lighting plain = makeYellowSunAndWhiteSky(kBandCount);
        const prt::Lighting hann =
            prt::applyWindow(plain, prt::windowFactors(prt::ShWindow::hann, kBandCount));
        const prt::Lighting deringed = prt::applyWindow(plain, prt::deringingFactors(plain));

        const struct {
            const char* name;
            prt::Image sphere;
            prt::Image light;
        } columns[] = {
            {"truth", drawSphere(makeYellowSunAndWhiteSky(kManyBands)), drawYellowSunAndWhiteSky()},
            {"three bands", drawSphere(plain), prt::reconstructLatLong(plain, kSize)},
            {"Hann", drawSphere(hann), prt::reconstructLatLong(hann, kSize)},
            {"de-ringed", drawSphere(deringed), prt::reconstructLatLong(deringed, kSize)},
        };
        prt::Image picture(4 * kSize, kSize + kSize / 2);
        int left = 0;
        for (const auto& [name, sphere, light] : columns) {
            printLowest(name, light);
            copyTo(picture, sphere, left, 0);
            copyTo(picture, light, left, kSize);
            left += kSize;
        }
        prt::writePng(argv[1], prt::encodeForDisplay(picture, {.exposureStops = 2.6f,
                                                               .toneCurve = prt::ToneCurve::none}));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}

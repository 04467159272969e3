// What a hundred numbers hold of an environment: a dark nave with small bright windows (or any
// image) on a cube of 64 × 64 × 6 texels, and from left to right, top to bottom
//
//   as it is                          as 10 bands of spherical harmonics, 100 coefficients
//   as the 100 largest wavelets       as the 4096 largest wavelets
//
// and the relative error of each over the sphere, √(∫|L − L_N|² dω / ∫|L|² dω), for several N.
//
//   04_bands_and_wavelets OUT.png [ENVIRONMENT]

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"
#include "prt/io/environment_io.h"
#include "prt/light/resampling.h"
#include "prt/light/wavelet_lighting.h"

namespace {

constexpr int kFaceSize = 64;
constexpr prt::SphereMap kCube = prt::SphereMap::verticalStrip;

/// Radiance in a dark nave, 2 wide and 6 long, from a place between its walls.
prt::Vec3d nave(const prt::Vec3d& direction) {
    const prt::Vec3d walls(1.0, direction.y > 0.0 ? 1.8 : 0.5, 3.0);
    const prt::Vec3d reach(walls.x / std::abs(direction.x), walls.y / std::abs(direction.y),
                           walls.z / std::abs(direction.z));
    const double distance = std::min({reach.x, reach.y, reach.z});
    const prt::Vec3d place = direction * distance;
    constexpr prt::Vec3d kStone(0.06, 0.05, 0.04);

    // Two narrow windows with pointed arches on each side, each of one glass.
    if (distance == reach.x) {
        constexpr prt::Vec3d kGlasses[] = {
            {0.03, 0.2, 2.0}, {2.0, 0.1, 0.03}, {2.0, 0.9, 0.05}, {0.1, 1.2, 0.2}};
        const double across = std::abs(place.z) - 0.8;
        const bool isGlass =
            std::abs(across) < 0.16 && place.y > 0.4 && place.y < 1.4 - 10.0 * across * across;
        return isGlass ? kGlasses[(place.x > 0.0 ? 2 : 0) + (place.z > 0.0 ? 1 : 0)] : kStone;
    }
    // A round window over the altar.
    if (distance == reach.z) {
        const bool isGlass = direction.z < 0.0 && std::hypot(place.x, place.y - 0.9) < 0.5;
        return isGlass ? prt::Vec3d(0.5, 0.8, 2.0) : kStone;
    }
    // Tiles on the floor, and ribs under the vault.
    if (direction.y < 0.0) {
        const double tile = std::floor(3.0 * place.x) + std::floor(3.0 * place.z);
        return kStone * (0.5 + std::abs(std::fmod(tile, 2.0)));
    }
    return kStone * (std::abs(std::cos(1.96 * place.z)) > 0.95 ? 2.0 : 0.5);
}

/// A texel is the mean of 4 × 4 places in it.
prt::Environment drawNave() {
    prt::Environment cube{kCube, prt::Image(kFaceSize, 6 * kFaceSize)};
    constexpr int kSamples = 4;
    for (int y = 0; y < kSamples * cube.radiance.height; ++y)
        for (int x = 0; x < kSamples * kFaceSize; ++x) {
            const prt::SpherePlace place = prt::spherePlace(
                kCube, kFaceSize, 6 * kFaceSize, (x + 0.5) / kSamples, (y + 0.5) / kSamples);
            cube.radiance.at(x / kSamples, y / kSamples) +=
                prt::Vec3f(nave(place.direction) / (kSamples * kSamples));
        }
    return cube;
}

prt::Environment loadCube(const char* path) {
    return prt::resample(prt::loadEnvironment(path).environment, kCube, kFaceSize, 6 * kFaceSize);
}

/// The cube as n bands hold it.
prt::Environment reconstructBands(const prt::Environment& cube, int bandCount) {
    const prt::Lighting lighting = prt::projectLighting(cube, bandCount);
    prt::Environment bands = cube;
    for (int y = 0; y < 6 * kFaceSize; ++y)
        for (int x = 0; x < kFaceSize; ++x)
            bands.radiance.at(x, y) = prt::Vec3f(prt::reconstruct(
                lighting, prt::sphereTexel(kCube, kFaceSize, 6 * kFaceSize, x, y).direction));
    return bands;
}

prt::Environment keepLargest(const prt::WaveletLighting& lighting, std::size_t count) {
    return prt::reconstructCube(prt::expand(prt::selectLargest(lighting, count)));
}

double relativeError(const prt::Environment& cube, const prt::Environment& truth) {
    double difference = 0.0, whole = 0.0;
    for (int y = 0; y < 6 * kFaceSize; ++y)
        for (int x = 0; x < kFaceSize; ++x) {
            const double weight =
                prt::sphereTexel(kCube, kFaceSize, 6 * kFaceSize, x, y).solidAngle;
            difference += weight * (cube.radiance.at(x, y) - truth.radiance.at(x, y)).length2();
            whole += weight * truth.radiance.at(x, y).length2();
        }
    return std::sqrt(difference / whole);
}

/// Draws the texels of a cube as a lat-long image into a part of the picture.
void drawPanorama(const prt::Environment& cube, prt::Image& picture, int left, int top) {
    const int width = picture.width / 2, height = picture.height / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const prt::Vec3f direction(
                prt::sphereTexel(prt::SphereMap::latLong, width, height, x, y).direction);
            const prt::Vec2f pixel =
                prt::pixelFromDirection(kCube, kFaceSize, 6 * kFaceSize, direction);
            picture.at(left * width + x, top * height + y) =
                cube.radiance.at(std::min(static_cast<int>(pixel.x), kFaceSize - 1),
                                 std::min(static_cast<int>(pixel.y), 6 * kFaceSize - 1));
        }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3)
        return std::fprintf(stderr, "usage: %s OUT.png [ENVIRONMENT]\n", argv[0]), 2;
    try {
        const prt::Environment cube = argc == 2 ? drawNave() : loadCube(argv[2]);
        const prt::WaveletLighting lighting = prt::projectWavelets(cube);

        std::printf("     N  bands  wavelets\n");
        for (const int bandCount : {5, 10, 20, 32, 64}) {
            const int count = bandCount * bandCount;
            std::printf(
                "%6d %6.3f %9.3f\n", count, relativeError(reconstructBands(cube, bandCount), cube),
                relativeError(keepLargest(lighting, static_cast<std::size_t>(count)), cube));
        }
        std::printf("   all      - %9.3f\n",
                    relativeError(keepLargest(lighting, lighting.coefficients.size()), cube));

        prt::Image picture(1024, 512);
        drawPanorama(cube, picture, 0, 0);
        drawPanorama(reconstructBands(cube, 10), picture, 1, 0);
        drawPanorama(keepLargest(lighting, 100), picture, 0, 1);
        drawPanorama(keepLargest(lighting, 4096), picture, 1, 1);
        prt::writePng(argv[1], prt::encodeForDisplay(picture));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}

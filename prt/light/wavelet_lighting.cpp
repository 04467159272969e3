// Bibliography
//   [Ng03]  All-frequency shadows using non-linear wavelet lighting approximation
#include "prt/light/wavelet_lighting.h"

#include <bit>

#include "prt/base/assert.h"
#include "prt/basis/haar.h"

namespace prt {
namespace {

constexpr std::size_t kFaceCount = 6;

std::size_t texelsPerFace(int faceSize) {
    PRT_ASSERT(faceSize > 0 && std::has_single_bit(static_cast<unsigned>(faceSize)),
               "the side of a face is a power of two");
    return static_cast<std::size_t>(faceSize) * static_cast<std::size_t>(faceSize);
}

}  // namespace

WaveletLighting projectWavelets(const Environment& environment) {
    const Image& image = environment.radiance;
    const std::size_t count = texelsPerFace(image.width);
    PRT_ASSERT(
        environment.map == SphereMap::verticalStrip && image.pixels.size() == kFaceCount * count,
        "the environment is a vertical strip");
    WaveletLighting lighting{image.width, std::vector<Vec3f>(image.pixels.size())};
    for (std::size_t face = 0; face < kFaceCount; ++face)
        projectHaar(std::span(image.pixels).subspan(face * count, count),
                    std::span(lighting.coefficients).subspan(face * count, count));
    return lighting;
}

Environment reconstructCube(const WaveletLighting& lighting) {
    const std::size_t count = texelsPerFace(lighting.faceSize);
    PRT_ASSERT(lighting.coefficients.size() == kFaceCount * count, "6 S² coefficients");
    Environment cube{SphereMap::verticalStrip, Image(lighting.faceSize, 6 * lighting.faceSize)};
    for (std::size_t face = 0; face < kFaceCount; ++face)
        reconstructHaar(std::span(lighting.coefficients).subspan(face * count, count),
                        std::span(cube.radiance.pixels).subspan(face * count, count));
    return cube;
}

SparseWaveletLighting selectLargest(const WaveletLighting& lighting, std::size_t count,
                                    std::span<const float> weights) {
    return {lighting.faceSize, selectLargest(lighting.coefficients, count, weights)};
}

WaveletLighting expand(const SparseWaveletLighting& lighting) {
    const std::size_t count = kFaceCount * texelsPerFace(lighting.faceSize);
    WaveletLighting whole{lighting.faceSize, std::vector<Vec3f>(count, Vec3f(0.0f))};
    for (const auto& [index, value] : lighting.coefficients) {
        PRT_ASSERT(index < count, "6 S² coefficients");
        whole.coefficients[index] = value;
    }
    return whole;
}

std::vector<float> projectWaveletTransfer(int faceSize, std::span<const float> transfer) {
    const std::size_t count = texelsPerFace(faceSize);
    PRT_ASSERT(transfer.size() == kFaceCount * count, "6 S² values");
    std::vector<float> integrals(transfer.begin(), transfer.end());
    float* integral = integrals.data();
    for (int y = 0; y < 6 * faceSize; ++y)
        for (int x = 0; x < faceSize; ++x)
            *integral++ *= static_cast<float>(
                sphereTexel(SphereMap::verticalStrip, faceSize, 6 * faceSize, x, y).solidAngle);

    std::vector<float> coefficients(integrals.size());
    for (std::size_t face = 0; face < kFaceCount; ++face)
        projectHaar(std::span<const float>(integrals).subspan(face * count, count),
                    std::span(coefficients).subspan(face * count, count));
    return coefficients;
}

Vec3d integrateProduct(const SparseWaveletLighting& lighting, std::span<const float> transfer) {
    PRT_ASSERT(transfer.size() == kFaceCount * texelsPerFace(lighting.faceSize),
               "6 S² coefficients");
    Vec3d sum(0.0);
    for (const auto& [index, value] : lighting.coefficients) {
        PRT_ASSERT(index < transfer.size(), "6 S² coefficients");
        sum += Vec3d(value) * static_cast<double>(transfer[index]);
    }
    return sum;
}

}  // namespace prt

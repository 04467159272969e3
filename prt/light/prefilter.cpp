// Bibliography
//   [Walter07]    Microfacet models for refraction through rough surfaces
//   [Krivanek08]  Real-time shading with filtered importance sampling
//   [Karis13]     Real shading in Unreal Engine 4
//   [Vogel79]     A better way to construct the sunflower head
#include "prt/light/prefilter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/image/octahedral_map.h"
#include "prt/light/resampling.h"
#include "prt/math/frame.h"

namespace prt {
namespace {

/// An environment as octahedral maps, which have no seams, each half as wide as the one before.
class Pyramid {
  public:
    /// @param size  of the finest map, a power of two
    Pyramid(const Environment& environment, int size) {
        Image image = resample(environment, SphereMap::octahedral, size, size).radiance;
        levels_.push_back(addBorder(image));
        while (image.width > 1) {
            image = halve(image);
            levels_.push_back(addBorder(image));
        }
    }

    /// The level whose texels have this solid angle on average, which may lie between two.
    float levelOf(double solidAngle) const {
        const double texelCount = 4.0 * std::numbers::pi / solidAngle;
        const double level = std::log2(levels_.front().width - 2) - 0.5 * std::log2(texelCount);
        return static_cast<float>(std::clamp(level, 0.0, static_cast<double>(levels_.size() - 1)));
    }

    /// Radiance between two levels.
    Vec3f lookUp(float level, const Vec3f& direction) const {
        const int finer = static_cast<int>(level);
        const float share = level - static_cast<float>(finer);
        const Vec3f radiance = lookUp(finer, direction);
        return share > 0.0f ? radiance * (1.0f - share) + lookUp(finer + 1, direction) * share
                            : radiance;
    }

  private:
    /// As lookUpRadiance, but in float (see octahedralPixel) and without the wrapping, which the
    /// border has done already: nearly all of the time goes by here.
    Vec3f lookUp(int level, const Vec3f& direction) const {
        const Image& image = levels_[static_cast<std::size_t>(level)];
        const float scale =
            1.0f / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
        const float u = scale * direction.x, v = -scale * direction.z;
        const bool isBelow = direction.y < 0.0f;
        const float shownU = isBelow ? std::copysign(1.0f - std::abs(v), u) : u;
        const float shownV = isBelow ? std::copysign(1.0f - std::abs(u), v) : v;
        const float halfSize = 0.5f * static_cast<float>(image.width - 2);
        const Vec2f pixel(halfSize * (1.0f + shownU) + 0.5f, halfSize * (1.0f + shownV) + 0.5f);
        const int left = std::min(static_cast<int>(pixel.x), image.width - 2);
        const int top = std::min(static_cast<int>(pixel.y), image.width - 2);
        const float x = pixel.x - static_cast<float>(left), y = pixel.y - static_cast<float>(top);
        const Vec3f* upper = &image.pixels[static_cast<std::size_t>(top * image.width + left)];
        const Vec3f* lower = upper + image.width;
        return (upper[0] * (1.0f - x) + upper[1] * x) * (1.0f - y) +
               (lower[0] * (1.0f - x) + lower[1] * x) * y;
    }

    static Image addBorder(const Image& image) {
        const int size = image.width;
        Image bordered(size + 2, size + 2);
        for (int y = -1; y <= size; ++y)
            for (int x = -1; x <= size; ++x) {
                const TexelIndex texel = wrapOctahedral(size, x, y);
                bordered.at(x + 1, y + 1) = image.at(texel.x, texel.y);
            }
        return bordered;
    }

    /// Spreads each texel over the four nearest of the next level as bilinear look-ups will gather
    /// them, so that a small light stays where it is.
    static Image halve(const Image& fine) {
        const int size = fine.width / 2;
        std::vector<Vec3d> flux(static_cast<std::size_t>(size * size), Vec3d(0.0));
        std::vector<double> solidAngles(flux.size(), 0.0);
        for (int y = 0; y < fine.height; ++y)
            for (int x = 0; x < fine.width; ++x) {
                const double solidAngle = octahedralTexel(fine.width, x, y).solidAngle;
                for (int i = 0; i < 4; ++i) {
                    const int aside = i % 2, above = i / 2;
                    const TexelIndex texel =
                        wrapOctahedral(size, x / 2 + aside * (x % 2 == 0 ? -1 : 1),
                                       y / 2 + above * (y % 2 == 0 ? -1 : 1));
                    const double weight =
                        solidAngle * (aside == 0 ? 0.75 : 0.25) * (above == 0 ? 0.75 : 0.25);
                    const auto index = static_cast<std::size_t>(texel.y * size + texel.x);
                    flux[index] += Vec3d(fine.at(x, y)) * weight;
                    solidAngles[index] += weight;
                }
            }
        Image coarse(size, size);
        for (std::size_t i = 0; i < flux.size(); ++i)
            coarse.pixels[i] = Vec3f(flux[i] / solidAngles[i]);
        return coarse;
    }

    std::vector<Image> levels_;  // with a border of one texel
};

/// A direction of a lobe about +z.
struct LobeSample {
    Vec3f direction;
    float weight;  // lobe over density
    float level;   // of the pyramid
};

/// Where a lobe is drawn, by the cosine of the angle to the mirrored direction.
struct PolarSample {
    double cosine = 1.0;
    double weight = 1.0;
    double density = 0.0;  // per steradian
};

/// Draws half vectors h about n = v with density D(h) ⟨n, h⟩ [Walter07, eq. 35], and mirrors v in
/// them, by which densities shrink to a 4⟨v, h⟩-th [Walter07, eq. 14]. What is left of the lobe is
/// ⟨n, l⟩⁺.
PolarSample sampleGgx(double alpha, double u) {
    const double squaredCosine = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
    const double cosine = 2.0 * squaredCosine - 1.0;
    const double falloff = 1.0 + (alpha * alpha - 1.0) * squaredCosine;
    return {cosine, std::max(cosine, 0.0),
            alpha * alpha / (4.0 * std::numbers::pi * falloff * falloff)};
}

PolarSample samplePhong(double alpha, double u) {
    const double exponent = 1.0 / (alpha * alpha);
    const double cosine = std::pow(1.0 - u, 1.0 / (exponent + 1.0));
    return {cosine, 1.0, 0.5 * (exponent + 1.0) / std::numbers::pi * std::pow(cosine, exponent)};
}

std::vector<LobeSample> drawLobe(ReflectionLobe lobe, double roughness, int sampleCount,
                                 const Pyramid& pyramid) {
    // So many share a texel that no small light falls between them.
    constexpr double kSamplesPerTexel = 6.0;
    constexpr double kLeastAlpha = 1e-6;  // below, numbers get lost
    const double alpha = std::max(roughness * roughness, kLeastAlpha);
    std::vector<LobeSample> samples;
    for (int i = 0; i < sampleCount; ++i) {
        const double u = (i + 0.5) / sampleCount;
        const PolarSample polar =
            lobe == ReflectionLobe::ggx ? sampleGgx(alpha, u) : samplePhong(alpha, u);
        if (polar.weight <= 0.0) continue;
        // Turns by the golden angle leave no direction crowded [Vogel79].
        constexpr double kGoldenAngle = 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
        const double phi = kGoldenAngle * i;
        const double radius = std::sqrt(std::max(1.0 - polar.cosine * polar.cosine, 0.0));
        const double solidAngle = kSamplesPerTexel / (sampleCount * polar.density);
        samples.push_back(
            {Vec3f(Vec3d(radius * std::cos(phi), radius * std::sin(phi), polar.cosine)),
             static_cast<float>(polar.weight), pyramid.levelOf(solidAngle)});
    }
    return samples;
}

Vec3f average(const Vec3d& axis, const std::vector<LobeSample>& samples, const Pyramid& pyramid) {
    const Frame<float> frame = frameFromNormal(Vec3f(axis));
    Vec3d sum(0.0);
    double weightSum = 0.0;
    for (const LobeSample& sample : samples) {
        const Vec3f radiance = pyramid.lookUp(sample.level, frame.worldFromLocal(sample.direction));
        sum += Vec3d(radiance) * static_cast<double>(sample.weight);
        weightSum += static_cast<double>(sample.weight);
    }
    return Vec3f(sum / weightSum);
}

/// Fills an image of the sphere, all of whose texels show something.
template <class Radiance>
Environment fill(SphereMap map, int width, int height, const Radiance& radianceAt) {
    Environment environment{map, Image(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.at(x, y) =
                radianceAt(spherePlace(map, width, height, x + 0.5, y + 0.5).direction);
    return environment;
}

Environment filterCube(const Pyramid& pyramid, ReflectionLobe shape, double roughness,
                       const PrefilterOptions& options) {
    // The result is as smooth as the lobe, whose radius is about α: where a few texels a radius are
    // fewer than those of the cube, they are enough, and may have more samples each.
    constexpr double kTexelsPerSphere = 24.0;  // along the side of an octahedral map, times α
    constexpr double kMostSamples = 3.0;
    const int size = options.faceSize;
    const double smoothSize = std::ceil(kTexelsPerSphere / (roughness * roughness));
    const double saving = 6.0 * size * size / (smoothSize * smoothSize);
    const int sampleCount =
        static_cast<int>(options.sampleCount * std::clamp(saving, 1.0, kMostSamples));
    const std::vector<LobeSample> lobe = drawLobe(shape, roughness, sampleCount, pyramid);
    const auto filter = [&](const Vec3d& axis) { return average(axis, lobe, pyramid); };
    if (saving <= 1.0) return fill(SphereMap::verticalStrip, size, 6 * size, filter);
    const Environment smooth = fill(SphereMap::octahedral, static_cast<int>(smoothSize),
                                    static_cast<int>(smoothSize), filter);
    return fill(SphereMap::verticalStrip, size, 6 * size,
                [&](const Vec3d& axis) { return lookUpRadiance(smooth, Vec3f(axis)); });
}

}  // namespace

PrefilteredEnvironment prefilterEnvironment(const Environment& environment,
                                            const PrefilterOptions& options) {
    PRT_ASSERT(options.faceSize >= 1 && options.faceSize <= 2048, "a face has texels");
    PRT_ASSERT(options.sampleCount >= 1, "a lobe has samples");
    // Texels half as large as those of the result, which bilinear look-ups then do not blur.
    const int finestSize =
        4 * static_cast<int>(std::bit_ceil(static_cast<unsigned>(options.faceSize)));
    const Pyramid pyramid(environment, finestSize);
    PrefilteredEnvironment prefiltered;
    for (const double roughness : options.roughnesses) {
        PRT_ASSERT(roughness >= 0.0 && roughness <= 1.0, "roughness lies in [0, 1]");
        prefiltered.mirrors.push_back(roughness == 0.0
                                          ? resample(environment, SphereMap::verticalStrip,
                                                     options.faceSize, 6 * options.faceSize)
                                          : filterCube(pyramid, options.lobe, roughness, options));
    }
    prefiltered.diffuse = filterCube(pyramid, ReflectionLobe::phong, 1.0, options);
    return prefiltered;
}

}  // namespace prt

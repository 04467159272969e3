#include "prt/light/environment_sampling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "prt/image/tone_curve.h"

namespace prt {
namespace {

std::vector<double> weighTexels(const Environment& environment) {
    const Image& image = environment.radiance;
    std::vector<double> weights;
    weights.reserve(image.pixels.size());
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3f& radiance = image.at(x, y);
            const float brightness =
                luminance(Vec3f(std::abs(radiance.x), std::abs(radiance.y), std::abs(radiance.z)));
            weights.push_back(
                static_cast<double>(brightness) *
                sphereTexel(environment.map, image.width, image.height, x, y).solidAngle);
        }
    }
    return weights;
}

}  // namespace

EnvironmentSampler::EnvironmentSampler(const Environment& environment)
    : map_(environment.map),
      width_(environment.radiance.width),
      height_(environment.radiance.height),
      table_(weighTexels(environment)) {}

EnvironmentPlace EnvironmentSampler::sample(RandomStream& random) const {
    const std::size_t texel = table_.sample(random.nextUnitDouble());
    const auto width = static_cast<std::size_t>(width_);
    const double x = static_cast<double>(texel % width) + random.nextUnitDouble();
    const double y = static_cast<double>(texel / width) + random.nextUnitDouble();
    return placeAt(texel, x, y);
}

EnvironmentPlace EnvironmentSampler::find(const Vec3f& direction) const {
    const Vec2f pixel = pixelFromDirection(map_, width_, height_, direction);
    const int x = std::clamp(static_cast<int>(pixel.x), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(pixel.y), 0, height_ - 1);
    const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x);
    return placeAt(texel, static_cast<double>(pixel.x), static_cast<double>(pixel.y));
}

EnvironmentPlace EnvironmentSampler::placeAt(std::size_t texel, double x, double y) const {
    const SpherePlace place = spherePlace(map_, width_, height_, x, y);
    if (place.solidAngleDensity <= 0.0) return {texel, place.direction, 0.0};
    return {texel, place.direction, table_.probability(texel) / place.solidAngleDensity};
}

}  // namespace prt

#include "prt/render/distant_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "prt/image/tone_curve.h"
#include "prt/math/alias_table.h"
#include "prt/math/frame.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

class SunLight final : public DistantLight {
  public:
    SunLight(const Vec3d& direction, double halfAngleRadians)
        : frame_(frameFromNormal(direction)),
          chord_(2.0 * std::sin(0.5 * halfAngleRadians)),
          density_(1.0 / (kPi * chord_ * chord_)) {
        const double sine = std::sin(std::min(halfAngleRadians, 0.5 * kPi));
        radiance_ = 1.0 / (kPi * sine * sine);
    }

    LightSample sample(RandomStream& random) const override {
        if (chord_ == 0.0)
            return {Vec3f(frame_.normal), Vec3f(1.0f), std::numeric_limits<double>::infinity()};
        // Areas of caps are those of discs with their chord as radius, so 1 − cos θ is uniform.
        const double height = 0.5 * chord_ * chord_ * random.nextUnitDouble();
        const double radius = std::sqrt(std::max(height * (2.0 - height), 0.0));
        const double phi = 2.0 * kPi * random.nextUnitDouble();
        const Vec3d local(radius * std::cos(phi), radius * std::sin(phi), 1.0 - height);
        return {Vec3f(frame_.worldFromLocal(local)),
                Vec3f(static_cast<float>(radiance_ / density_)), density_};
    }

    LightValue evaluate(const Vec3f& direction) const override {
        // The chord is accurate where the cosine of a small angle is not.
        if ((Vec3d(direction) - frame_.normal).length() >= chord_) return {};
        return {Vec3f(static_cast<float>(radiance_)), density_};
    }

  private:
    Frame<double> frame_;
    double chord_;  // from the centre of the disc to its rim, on the unit sphere
    double density_;
    double radiance_ = 0.0;
};

/// Draws texels of an image of the sphere by their luminance and solid angle, and places in them.
class TexelSampler {
  public:
    explicit TexelSampler(const Environment& environment)
        : map_(environment.map),
          width_(environment.radiance.width),
          height_(environment.radiance.height),
          table_(weighTexels(environment)) {}

    struct Place {
        std::size_t texel = 0;
        Vec3d direction{0.0, 0.0, 0.0};
        double density = 0.0;  // per steradian; 0 where the image shows nothing
    };

    Place sample(RandomStream& random) const {
        const std::size_t texel = table_.sample(random.nextUnitDouble());
        const auto width = static_cast<std::size_t>(width_);
        const double x = static_cast<double>(texel % width) + random.nextUnitDouble();
        const double y = static_cast<double>(texel / width) + random.nextUnitDouble();
        return placeAt(texel, x, y);
    }

    Place find(const Vec3f& direction) const {
        const Vec2f pixel = pixelFromDirection(map_, width_, height_, direction);
        const int x = std::clamp(static_cast<int>(pixel.x), 0, width_ - 1);
        const int y = std::clamp(static_cast<int>(pixel.y), 0, height_ - 1);
        const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x);
        return placeAt(texel, static_cast<double>(pixel.x), static_cast<double>(pixel.y));
    }

  private:
    static std::vector<double> weighTexels(const Environment& environment) {
        const Image& image = environment.radiance;
        std::vector<double> weights;
        weights.reserve(image.pixels.size());
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Vec3f& radiance = image.at(x, y);
                const float brightness = luminance(
                    Vec3f(std::abs(radiance.x), std::abs(radiance.y), std::abs(radiance.z)));
                weights.push_back(
                    static_cast<double>(brightness) *
                    sphereTexel(environment.map, image.width, image.height, x, y).solidAngle);
            }
        }
        return weights;
    }

    Place placeAt(std::size_t texel, double x, double y) const {
        const SpherePlace place = spherePlace(map_, width_, height_, x, y);
        if (place.solidAngleDensity <= 0.0) return {texel, place.direction, 0.0};
        return {texel, place.direction, table_.probability(texel) / place.solidAngleDensity};
    }

    SphereMap map_;
    int width_;
    int height_;
    AliasTable table_;
};

class EnvironmentLight final : public DistantLight {
  public:
    EnvironmentLight(Environment environment, const Mat3d& worldFromEnvironment)
        : environment_(std::move(environment)),
          worldFromEnvironment_(worldFromEnvironment),
          environmentFromWorld_(worldFromEnvironment.transposed()),
          sampler_(environment_) {}

    LightSample sample(RandomStream& random) const override {
        const TexelSampler::Place place = sampler_.sample(random);
        if (place.density == 0.0) return {};
        const Vec3d radiance(environment_.radiance.pixels[place.texel]);
        return {Vec3f(worldFromEnvironment_ * place.direction), Vec3f(radiance / place.density),
                place.density};
    }

    LightValue evaluate(const Vec3f& direction) const override {
        const TexelSampler::Place place = sampler_.find(environmentFromWorld_ * direction);
        return {environment_.radiance.pixels[place.texel], place.density};
    }

  private:
    Environment environment_;
    Mat3d worldFromEnvironment_;
    Mat3d environmentFromWorld_;
    TexelSampler sampler_;
};

class BandLimitedLight final : public DistantLight {
  public:
    explicit BandLimitedLight(const Lighting& lighting)
        : lighting_(lighting),
          sampler_({SphereMap::latLong,
                    reconstructLatLong(lighting, kTexelsPerBand * 2 * lighting.bandCount)}) {
        for (const Vec3d& coefficient : lighting.coefficients)
            coefficients_.emplace_back(coefficient);
    }

    LightSample sample(RandomStream& random) const override {
        const TexelSampler::Place place = sampler_.sample(random);
        if (place.density == 0.0) return {};
        const Vec3f direction(place.direction);
        return {direction, radianceFrom(direction) / static_cast<float>(place.density),
                place.density};
    }

    LightValue evaluate(const Vec3f& direction) const override {
        return {radianceFrom(direction), sampler_.find(direction).density};
    }

  private:
    /// As reconstruct(), without its memory and in float where the straight-line code reaches.
    Vec3f radianceFrom(const Vec3f& direction) const {
        if (lighting_.bandCount > kMaxBandCount)
            return Vec3f(reconstruct(lighting_, Vec3d(direction)));
        std::array<float, shCoefficientCount(kMaxBandCount)> values;
        evaluateSh(direction, lighting_.bandCount, std::span(values.data(), coefficients_.size()));
        Vec3f radiance(0.0f);
        for (std::size_t i = 0; i < coefficients_.size(); ++i)
            radiance += coefficients_[i] * values[i];
        return radiance;
    }

    static constexpr int kTexelsPerBand = 8;  // of the sketch that directions are drawn from

    Lighting lighting_;
    std::vector<Vec3f> coefficients_;
    TexelSampler sampler_;
};

}  // namespace

std::unique_ptr<DistantLight> makeSunLight(const Vec3d& direction, double halfAngleRadians) {
    return std::make_unique<SunLight>(direction, halfAngleRadians);
}

std::unique_ptr<DistantLight> makeBandLimitedLight(const Lighting& lighting) {
    return std::make_unique<BandLimitedLight>(lighting);
}

std::unique_ptr<DistantLight> makeEnvironmentLight(Environment environment,
                                                   const Mat3d& worldFromEnvironment) {
    return std::make_unique<EnvironmentLight>(std::move(environment), worldFromEnvironment);
}

}  // namespace prt

#include "prt/render/distant_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "prt/light/environment_sampling.h"
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

class EnvironmentLight final : public DistantLight {
  public:
    EnvironmentLight(Environment environment, const Mat3d& worldFromEnvironment)
        : environment_(std::move(environment)),
          worldFromEnvironment_(worldFromEnvironment),
          environmentFromWorld_(worldFromEnvironment.transposed()),
          sampler_(environment_) {}

    LightSample sample(RandomStream& random) const override {
        const EnvironmentPlace place = sampler_.sample(random);
        if (place.density == 0.0) return {};
        const Vec3d radiance(environment_.radiance.pixels[place.texel]);
        return {Vec3f(worldFromEnvironment_ * place.direction), Vec3f(radiance / place.density),
                place.density};
    }

    LightValue evaluate(const Vec3f& direction) const override {
        const EnvironmentPlace place = sampler_.find(environmentFromWorld_ * direction);
        return {environment_.radiance.pixels[place.texel], place.density};
    }

  private:
    Environment environment_;
    Mat3d worldFromEnvironment_;
    Mat3d environmentFromWorld_;
    EnvironmentSampler sampler_;
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
        const EnvironmentPlace place = sampler_.sample(random);
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
    EnvironmentSampler sampler_;
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

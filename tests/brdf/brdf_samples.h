#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/brdf/brdf.h"
#include "tests/brdf/measured_table.h"

namespace prt::test {

/// Evenly over the upper hemisphere, a little off the horizon.
inline Vec3d drawUpward(RandomStream& random) {
    const double z = 0.02 + 0.98 * random.nextUnitDouble();
    const double phi = 2.0 * std::numbers::pi * random.nextUnitDouble();
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

/// Above the horizon and at azimuth 0.
inline Vec3d viewAt(double degrees) {
    const double theta = degrees * std::numbers::pi / 180.0;
    return {std::sin(theta), 0.0, std::cos(theta)};
}

inline Brdf makeGgx(double roughness) {
    return {.lobes = {GgxLobe{.f0 = Vec3d(1.0), .alpha = roughness * roughness}}};
}

/// A plastic, measured.
inline const Brdf& measuredPlastic() {
    static const Brdf kMeasured = [] {
        const Brdf plastic = makeGltfBrdf(Vec3f(0.6f, 0.3f, 0.1f), {.roughness = 0.5f});
        return Brdf{.lobes = {MeasuredLobe{std::make_shared<MeasuredBrdf>(
                        measureTable([&](const Vec3d& incident, const Vec3d& view) {
                            return evaluateBrdf(plastic, incident, view);
                        }))}}};
    }();
    return kMeasured;
}

/// One of each kind.
inline std::vector<std::pair<std::string, Brdf>> makeAllKinds() {
    return {
        {"Lambert", {.lobes = {LambertLobe{Vec3d(0.8, 0.5, 0.2)}}}},
        {"Phong", {.lobes = {PhongLobe{.albedo = Vec3d(0.9, 0.8, 0.7), .exponent = 12.5}}}},
        {"paint and Phong",
         {.lobes = {LambertLobe{Vec3d(0.3)}, PhongLobe{.albedo = Vec3d(0.6), .exponent = 40.0}}}},
        {"rough GGX", makeGgx(0.9)},
        {"GGX", makeGgx(0.5)},
        {"dielectric", makeGltfBrdf(Vec3f(0.7f, 0.4f, 0.1f), {.roughness = 0.6f})},
        {"half metal",
         makeGltfBrdf(Vec3f(0.9f, 0.6f, 0.3f), {.metallic = 0.5f, .roughness = 0.7f})},
        {"measured", measuredPlastic()}};
}

}  // namespace prt::test

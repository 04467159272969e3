#pragma once

#include <cmath>

#include "prt/light/environment.h"
#include "prt/scene/procedural.h"
#include "prt/scene/scene.h"

namespace prt::test {

struct SphereMaterial {
    Vec3f baseColor{1.0f, 1.0f, 1.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;
};

/// A unit sphere alone.
inline Scene makeSphereScene(const SphereMaterial& surface, int segmentCount = 96) {
    Material material;
    material.baseColorFactor = {surface.baseColor.x, surface.baseColor.y, surface.baseColor.z,
                                1.0f};
    material.metallicFactor = surface.metallic;
    material.roughnessFactor = surface.roughness;
    Scene scene;
    scene.materials.push_back(material);
    scene.meshes.push_back(makeSphere(Vec3f(0.0f), 1.0f, segmentCount));
    return scene;
}

/// Radiance 1 + ω/2 + a lamp as wide as a hand: every direction looks different.
inline Environment drawSmoothSky() {
    constexpr int kHeight = 64;
    const Vec3d lamp = Vec3d(0.5, 0.6, 0.8).normalized();
    Environment sky{SphereMap::latLong, Image(2 * kHeight, kHeight)};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            const Vec3d direction =
                sphereTexel(SphereMap::latLong, 2 * kHeight, kHeight, x, y).direction;
            const double glow = 3.0 * std::exp(20.0 * (direction.dot(lamp) - 1.0));
            sky.radiance.at(x, y) = Vec3f(Vec3d(1.0 + glow) + direction * 0.5);
        }
    return sky;
}

}  // namespace prt::test

// Rooms in which it is equally bright everywhere, whatever their shape: closed forms for every mesh
// and albedo. Emission stands for what no distant light can do in a closed room.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"
#include "prt/scene/procedural.h"
#include "prt/scene/surface_color.h"
#include "prt/transport/bake.h"
#include "tests/support/scenes.h"
#include "tests/transport/gathered_scene.h"

namespace prt {
namespace {

using test::assembleScene;
using test::GatheredScene;

/// A texture of random greys.
TextureImage makeNoiseTexture(int size) {
    TextureImage texture;
    texture.pixels = Rgba8Image(size, size);
    RandomStream random(9, 0);
    for (Rgba8& pixel : texture.pixels.pixels) {
        const auto grey = static_cast<std::uint8_t>(random.nextBits() >> 24);
        pixel = {grey, grey, grey, 255};
    }
    return texture;
}

/// A closed room with a ball and a box in it, all of them papered with random greys.
Scene makePaperedRoom() {
    Scene scene = assembleScene(
        {{makeBox({-1, -1, -1}, {1, 1, 1}, true, 6), {0.9f, 0.9f, 0.9f}},
         {makeSphere({0.3f, 0.2f, -0.4f}, 0.4f, 24), {0.7f, 0.7f, 0.7f}},
         {makeBox({-0.7f, -0.6f, -0.9f}, {-0.2f, -0.1f, 0.3f}, false, 3), {0.5f, 0.5f, 0.5f}}});
    scene.images.push_back(makeNoiseTexture(8));
    for (Material& material : scene.materials)
        material.baseColorTexture = TextureUse{};
    for (Mesh& mesh : scene.meshes)
        for (const Vec3f& p : mesh.positions)
            mesh.uvSets[0].emplace_back(p.x + 0.3f * p.z, p.y - 0.2f * p.z);
    return scene;
}

/// (1/π) ∫ (1 − ρ) ⟨n, ω⟩ dω over the surfaces that a receiver sees, by plain random rays: what
/// it gathers from surfaces that emit what they do not reflect.
float gatherEmission(const Scene& scene, const GatheredScene& gathered, const Receiver& receiver,
                     int rayCount) {
    RandomStream random(77, receiver.randomStream);
    const Vec3f center = gathered.rays.tracePoint({0.0f, 0.0f, 0.0f});
    const float scale = 1.0f / (gathered.rays.tracePoint({1.0f, 0.0f, 0.0f}) - center).length();
    const Vec3f origin = (receiver.origin - center) * scale;
    double sum = 0.0;
    for (int i = 0; i < rayCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const Vec3f local = sampleCosineHemisphere(u, unitFloatFromBits(random.nextBits()));
        const Hit hit = gathered.rays.intersect(
            {origin, frameFromNormal(receiver.normal).worldFromLocal(local)});
        if (!hit.escaped && !hit.backFace)
            sum += 1.0 - static_cast<double>(evaluateBaseColor(scene, hit.point).x);
    }
    return static_cast<float>(sum / rayCount);
}

TEST(Furnace, SurfacesThatEmitWhatTheyDoNotReflectAreEquallyBright) {  // A10
    const Scene scene = makePaperedRoom();
    const GatheredScene gathered(scene, 1024);
    std::vector<float> source;
    for (const Receiver& receiver : gathered.receivers.fronts)
        source.push_back(gatherEmission(scene, gathered, receiver, 1024));
    const std::vector<float> total = gathered.bounce(source, kInfiniteBounces);

    // No vertex of this room lies inside another object, so that each sees brightness 1. Noise of a
    // receiver: 1024 rays to two independent sums of variance below 1/12, and the bounces' own.
    double sum = 0.0;
    for (const float radiance : total) {
        EXPECT_NEAR(radiance, 1.0f, 6e-2f);
        sum += static_cast<double>(radiance);
    }
    EXPECT_NEAR(sum / static_cast<double>(total.size()), 1.0, 2e-3);
    for (const float direct : gathered.direct)
        EXPECT_EQ(direct, 0.0f) << "the room is closed";
}

TEST(Furnace, InsideASphereBouncesAreAGeometricSeries) {  // A11: E (1 − ρ^{k+1}) / (1 − ρ)
    for (const double albedo : {0.5, 0.8, 0.9}) {
        Mesh sphere = makeSphere({0, 0, 0}, 1.0f, 32);
        for (std::size_t i = 0; i < sphere.indices.size(); i += 3)
            std::swap(sphere.indices[i + 1], sphere.indices[i + 2]);
        for (Vec3f& normal : sphere.normals)
            normal = -normal;
        const auto rho = static_cast<float>(albedo);
        const GatheredScene gathered(assembleScene({{sphere, {rho, rho, rho}}}), 64);
        const std::vector<float> source(gathered.receivers.fronts.size(), 1.0f);

        int bouncesToThousandth = 0;
        for (const int bounceCount : {0, 1, 2, 5, 9, 10, 30, 31, 65, 66}) {
            const double expected = (1.0 - std::pow(albedo, bounceCount + 1)) / (1.0 - albedo);
            const double limit = 1.0 / (1.0 - albedo);
            for (const float total : gathered.bounce(source, bounceCount))
                ASSERT_NEAR(total, expected, 1e-4 * limit) << albedo << ", " << bounceCount;
            if (bouncesToThousandth == 0 && expected > 0.999 * limit)
                bouncesToThousandth = bounceCount;
        }
        EXPECT_EQ(bouncesToThousandth, albedo < 0.6 ? 9 : albedo < 0.85 ? 30 : 65);
        for (const float total : gathered.bounce(source, kInfiniteBounces))
            ASSERT_NEAR(total, 1.0 / (1.0 - albedo), 1e-4 / (1.0 - albedo));
    }
}

}  // namespace
}  // namespace prt

// Light is neither made nor lost, and goes the same way in both directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/lighting.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_scene.h"
#include "prt/transport/bake.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;

constexpr double kPi = std::numbers::pi;

/// A bowl with a ball in it: every surface sees others.
Scene makeBallInBowl(float bowlAlbedo, float ballAlbedo) {
    return assembleScene(
        {{makeBowl(0.3f, 64), {bowlAlbedo, bowlAlbedo, bowlAlbedo}},
         {makeSphere({0.1f, 0.0f, -0.3f}, 0.45f, 48), {ballAlbedo, ballAlbedo, ballAlbedo}}});
}

/// A third of the area of its triangles, for every vertex.
std::vector<double> vertexAreas(const Mesh& mesh) {
    std::vector<double> areas(mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3d a(mesh.positions[mesh.indices[i]]);
        const Vec3d b(mesh.positions[mesh.indices[i + 1]]);
        const Vec3d c(mesh.positions[mesh.indices[i + 2]]);
        for (std::size_t k = 0; k < 3; ++k)
            areas[mesh.indices[i + k]] += (b - a).cross(c - a).length() / 6.0;
    }
    return areas;
}

/// B of every vertex, before its own albedo.
std::vector<double> relight(const TransferField& field, Transport transport,
                            const Lighting& lighting) {
    const TransferLayer& layer = *field.findLayer(transport);
    std::vector<double> radiance;
    for (const std::uint32_t receiver : field.receiverOfVertex) {
        const auto transfer = transferVector(field, layer, receiver, 0);
        double sum = 0.0;
        for (std::size_t i = 0; i < transfer.size(); ++i)
            sum += static_cast<double>(transfer[i]) * lighting.coefficients[i].x;
        radiance.push_back(sum);
    }
    return radiance;
}

// Under a white sky a surface receives π u a square metre, u = B before albedo, keeps the part 1 −
// ρ of it, and what it sends back escapes where the sky is seen.
TEST(Energy, WhatComesInIsAbsorbedOrEscapes) {  // A18
    const std::vector<float> albedos = {0.8f, 0.35f};
    const Scene scene = makeBallInBowl(albedos[0], albedos[1]);
    const TransferField field =
        bakeTransfer(scene, {.bandCount = 1, .sampleCount = 1024, .bounceCount = kInfiniteBounces});
    const Lighting sky = uniformLighting(Vec3d(1.0), 1);
    const std::vector<double> skyView = relight(field, Transport::shadowed, sky);
    const std::vector<double> received = relight(field, Transport::interreflected, sky);

    double incident = 0.0, absorbed = 0.0, escaped = 0.0;
    std::size_t vertex = 0;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const double albedo = static_cast<double>(albedos[mesh]);
        for (const double area : vertexAreas(scene.meshes[mesh])) {
            EXPECT_LE(received[vertex], 1.0 + 1e-5);
            incident += kPi * area * skyView[vertex];
            absorbed += kPi * area * (1.0 - albedo) * received[vertex];
            escaped += kPi * area * albedo * received[vertex] * skyView[vertex];
            ++vertex;
        }
    }
    EXPECT_NEAR((absorbed + escaped) / incident, 1.0, 1e-3);
}

/// Power that arrives at each triangle, from particles sent in by a light of radiance 1 + ½ y/|y|
/// from everywhere: the other way round from a bake.
class ParticleTracer {
  public:
    explicit ParticleTracer(const Scene& scene) : scene_(scene), rays_(scene) {
        for (const Mesh& mesh : scene.meshes) {
            power_.emplace_back(mesh.triangleCount());
            count_.emplace_back(mesh.triangleCount());
        }
    }

    void send(std::uint64_t particleCount) {
        constexpr double kRadius = 1.2;  // of a sphere about the scene
        const double power =
            4.0 * kPi * kPi * kRadius * kRadius / static_cast<double>(particleCount);
        for (std::uint64_t i = 0; i < particleCount; ++i) {
            RandomStream random(5, i);
            const Vec3f toLight = sampleDirection(random, sampleUniformSphere);
            const Vec3f disc = sampleDirection(random, sampleCosineHemisphere);  // its shadow
            const Vec3f start = frameFromNormal(toLight).worldFromLocal({disc.x, disc.y, 1.0f});
            follow({start * static_cast<float>(kRadius), -toLight},
                   power * (1.0 + 0.5 * static_cast<double>(toLight.y)), random);
        }
    }

    /// Irradiance / π, as a bake has it before albedo; and its standard error, relative.
    std::pair<double, double> meanRadiance(std::size_t mesh, std::size_t triangle) const {
        const Mesh& m = scene_.meshes[mesh];
        const std::uint32_t* corners = &m.indices[3 * triangle];
        const Vec3d a(m.positions[corners[0]]);
        const double area =
            0.5 *
            (Vec3d(m.positions[corners[1]]) - a).cross(Vec3d(m.positions[corners[2]]) - a).length();
        return {power_[mesh][triangle] / (kPi * area),
                1.5 / std::sqrt(static_cast<double>(count_[mesh][triangle]))};
    }

  private:
    static Vec3f sampleDirection(RandomStream& random, Vec3f (*sample)(float, float)) {
        const float u = unitFloatFromBits(random.nextBits());
        return sample(u, unitFloatFromBits(random.nextBits()));
    }

    void follow(Ray ray, double power, RandomStream& random) {
        for (;;) {
            const Hit hit = rays_.intersect(ray);
            if (hit.escaped || hit.backFace) return;
            power_[hit.point.mesh][hit.point.triangle] += power;
            ++count_[hit.point.mesh][hit.point.triangle];
            const Vec4f albedo = evaluateBaseColor(scene_, hit.point);
            if (random.nextUnitFloat() >= albedo.x) return;
            const Mesh& mesh = scene_.meshes[hit.point.mesh];
            const std::uint32_t* corners = &mesh.indices[3 * hit.point.triangle];
            const Vec3f normal = triangleNormal(
                mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]);
            const Vec3f local = sampleDirection(random, sampleCosineHemisphere);
            ray = {ray.origin + ray.direction * hit.t + normal * 1e-4f,
                   frameFromNormal(normal).worldFromLocal(local)};
        }
    }

    const Scene& scene_;
    RayScene rays_;
    std::vector<std::vector<double>> power_;
    std::vector<std::vector<std::uint64_t>> count_;
};

TEST(Energy, GatheredLightIsTheLightThatParticlesBring) {  // A19
    const Scene scene = makeBallInBowl(0.8f, 0.6f);
    Lighting lighting = uniformLighting(Vec3d(1.0), 2);
    lighting.coefficients[1] = Vec3d(0.5 / -0.48860251190291992);  // ½ y/|y| (C2)
    const TransferField field =
        bakeTransfer(scene, {.bandCount = 2, .sampleCount = 1024, .bounceCount = kInfiniteBounces});
    const std::vector<double> radiance = relight(field, Transport::interreflected, lighting);
    ParticleTracer particles(scene);
    particles.send(3'000'000);

    double zSum = 0.0;
    int pairCount = 0;
    RandomStream random(6, 0);
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    for (; pairCount < 100; ++pairCount) {
        const std::size_t mesh = random.nextBits() % 2;
        const Mesh& m = scene.meshes[mesh];
        const std::size_t triangle = random.nextBits() % m.triangleCount();
        double gathered = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            gathered += radiance[offsets[mesh] + m.indices[3 * triangle + k]] / 3.0;
        const auto [brought, relativeError] = particles.meanRadiance(mesh, triangle);
        const double z = (gathered / brought - 1.0) / relativeError;
        EXPECT_LE(std::abs(z), 4.0) << "mesh " << mesh << ", triangle " << triangle;
        zSum += z;
    }
    EXPECT_LE(std::abs(zSum), 4.0 * std::sqrt(pairCount));
}

}  // namespace
}  // namespace prt

#include "prt/render/exit_shading.h"

#include "prt/base/assert.h"

namespace prt {

ExitRadiance interpolateExit(const Mesh& mesh, const SurfacePoint& point,
                             std::span<const ExitRadiance> meshRadiance) {
    const std::uint32_t* corners = &mesh.indices[3 * point.triangle];
    const auto lerp = [&](auto ExitRadiance::*member) {
        const auto& origin = meshRadiance[corners[0]].*member;
        return origin + (meshRadiance[corners[1]].*member - origin) * point.u +
               (meshRadiance[corners[2]].*member - origin) * point.v;
    };
    return {lerp(&ExitRadiance::perBaseColor), lerp(&ExitRadiance::constant),
            lerp(&ExitRadiance::mirrorVisibility)};
}

Vec3f shadePoint(const Scene& scene, const SurfacePoint& point, const ExitRadiance& radiance,
                 const Vec3f& normal, const Vec3f& view, const MirrorEnvironment* mirrors) {
    const Vec3f baseColor = evaluateAlbedo(scene, point);
    const Vec3f held = baseColor * radiance.perBaseColor + radiance.constant;
    if (!mirrors || radiance.mirrorVisibility <= 0.0f) return held;
    return held + showMirrored(*mirrors, normal, view, baseColor,
                               evaluateMetallicRoughness(scene, point)) *
                      radiance.mirrorVisibility;
}

std::vector<std::optional<SurfacePoint>> findVertexPoints(const Scene& scene) {
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    std::vector<std::optional<SurfacePoint>> points(scene.vertexCount());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (std::size_t i = 0; i < scene.meshes[m].indices.size(); ++i) {
            const std::size_t corner = i % 3;
            points[offsets[m] + scene.meshes[m].indices[i]] = {m, i / 3, corner == 1 ? 1.0f : 0.0f,
                                                               corner == 2 ? 1.0f : 0.0f};
        }
    return points;
}

std::vector<Vec3f> shadeVertices(const Scene& scene, std::span<const ExitRadiance> vertexRadiance,
                                 const Vec3f& eye, const MirrorEnvironment* mirrors) {
    PRT_ASSERT(vertexRadiance.size() == scene.vertexCount(), "one radiance a vertex");
    const auto points = findVertexPoints(scene);
    std::vector<Vec3f> shaded(points.size(), Vec3f(0.0f));
    std::size_t vertex = 0;
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex)
            if (points[vertex])
                shaded[vertex] =
                    shadePoint(scene, *points[vertex], vertexRadiance[vertex], mesh.normals[i],
                               (eye - mesh.positions[i]).normalized(), mirrors);
    return shaded;
}

}  // namespace prt

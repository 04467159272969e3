#pragma once

#include <utility>
#include <vector>

#include "prt/math/transform.h"
#include "prt/scene/normals.h"
#include "prt/scene/procedural.h"
#include "prt/scene/scene.h"

namespace prt::test {

/// A mesh and what it is made of.
struct Part {
    Mesh mesh;
    Vec3f albedo{0.5f, 0.5f, 0.5f};
    bool doubleSided = false;
};

inline Scene assembleScene(std::vector<Part> parts) {
    Scene scene;
    for (Part& part : parts) {
        Material material;
        material.baseColorFactor = {part.albedo.x, part.albedo.y, part.albedo.z, 1.0f};
        material.doubleSided = part.doubleSided;
        part.mesh.material = scene.materials.size();
        scene.materials.push_back(material);
        scene.meshes.push_back(std::move(part.mesh));
    }
    return scene;
}

/// Two triangles a b c, a c d with their geometric normal.
inline Mesh makeQuad(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
    Mesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.normals.assign(4, triangleNormal(a, b, c));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

/// One small triangle around `center`, facing `normal`: a place to look from.
inline Mesh makePatch(const Vec3f& center, const Vec3f& normal, float size) {
    const Vec3f helper =
        std::abs(normal.x) < 0.9f ? Vec3f(1.0f, 0.0f, 0.0f) : Vec3f(0.0f, 1.0f, 0.0f);
    const Vec3f u = normal.cross(helper).normalized() * size;
    const Vec3f v = normal.cross(u);
    Mesh mesh;
    mesh.positions = {center + u, center - u * 0.5f + v, center - u * 0.5f - v};
    mesh.normals.assign(3, normal);
    mesh.indices = {0, 1, 2};
    return mesh;
}

/// A room with one wall missing, and what stands in it.
inline Scene makeRoomAround(std::vector<Part> things) {
    std::vector<Part> parts = {
        {makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}), {0.8f, 0.8f, 0.8f}},
        {makeQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}), {0.1f, 0.7f, 0.2f}},
        {makeQuad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}), {0.7f, 0.1f, 0.1f}}};
    for (Part& thing : things)
        parts.push_back(std::move(thing));
    return assembleScene(std::move(parts));
}

/// With a ball.
inline Scene makeRoomScene() {
    return makeRoomAround({{makeSphere({0, 0, 0.5f}, 0.5f, 16)}});
}

/// With a ball, and a double-sided sheet that hangs there.
inline Scene makeFurnishedRoom() {
    return makeRoomAround({{makeQuad({0.2f, -0.3f, 1.2f}, {0.9f, -0.3f, 1.3f}, {0.9f, 0.5f, 1.4f},
                                     {0.2f, 0.5f, 1.3f}),
                            {0.6f, 0.5f, 0.9f},
                            true},
                           {makeSphere({0.1f, 0.2f, 0.5f}, 0.45f, 12), {0.9f, 0.9f, 0.5f}}});
}

/// With a ball, and a screen that reflects on both sides.
inline Scene makeScreenScene() {
    return makeRoomAround({{makeSphere({0, 0, 0.5f}, 0.5f, 16)},
                           {makeQuad({-0.9f, -0.8f, 0.1f}, {-0.2f, -0.9f, 0.1f},
                                     {-0.2f, -0.9f, 1.2f}, {-0.9f, -0.8f, 1.2f}),
                            {0.9f, 0.6f, 0.3f},
                            true}});
}

/// Rotates, scales and moves a whole scene.
inline Scene transformScene(Scene scene, const Mat3d& rotation, double scale, const Vec3f& offset) {
    for (Mesh& mesh : scene.meshes) {
        for (Vec3f& position : mesh.positions)
            position = Vec3f((rotation * Vec3d(position)) * scale + Vec3d(offset));
        for (Vec3f& normal : mesh.normals)
            normal = rotation * normal;
    }
    return scene;
}

}  // namespace prt::test

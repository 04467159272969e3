#pragma once

#include <span>
#include <string_view>

#include "prt/scene/scene.h"

namespace prt {

/// A scene made by code, from published facts only: name and one line of what it is for.
struct ProceduralScene {
    std::string_view name;
    std::string_view description;
    Scene (*make)();
};

/// teapot, cornell, columns, bowl, sphere-over-plane, blocker, materials, box.
std::span<const ProceduralScene> proceduralScenes();

/// @param name    one of proceduralScenes()
/// @throws Error  invalidOption for any other name, listing those there are
Scene makeProceduralScene(std::string_view name);

// Parts, for tests and for composing scenes: each one mesh with normals, of material 0.

/// A sphere of rows about the z axis, its vertices on the sphere.
/// @param segmentCount  around the equator
Mesh makeSphere(const Vec3f& center, float radius, int segmentCount);
/// A square in the plane y = height, facing +y.
Mesh makeFloor(float halfWidth, float height, int cellCount);
/// An axis-aligned box; facing outwards, or inwards for a closed room.
Mesh makeBox(const Vec3f& low, const Vec3f& high, bool facingInwards, int cellCount);
/// The unit sphere's part with z < openingHeight, seen from inside: the bowl whose interreflection
/// has a closed form (docs/conventions.md, "Known answers").
Mesh makeBowl(float openingHeight, int segmentCount);
/// The Utah teapot from Newell's 32 patches, on y = 0, 2 m wide from the handle (−x) to
/// the spout (+x) [Newell75]. As in the original, lid and rim do not touch, and handle
/// and spout end inside the body.
/// @param patchCellCount  cells along each side of a patch, at least 2
Mesh makeTeapot(int patchCellCount);

}  // namespace prt

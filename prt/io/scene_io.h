#pragma once

#include <filesystem>

#include "prt/gltf/gltf_scene.h"
#include "prt/io/image_io.h"
#include "prt/scene/scene.h"

namespace prt {

struct SceneLimits {
    GltfLimits gltf;
    ImageLimits textures;
};

/// Reads .gltf, .glb, .obj (with its .mtl) or .ply (ascii, little and big endian) as told by the
/// file's suffix, with textures decoded and normals present.
///
/// OBJ and PLY files are taken as metres, Y up (C1); OBJ vertices are split only where UV or normal
/// differ; polygons are cut into triangles. What findSceneProblems finds is kept, with a warning.
///
/// @throws Error  notFound, unreadable, malformed, unsupported, or limitExceeded
Scene loadScene(const std::filesystem::path& path, const SceneLimits& limits = {});

/// Reads a Wavefront OBJ as one mesh a material. Textures stay encoded.
///
/// Of MTL, Kd becomes the base colour (linear), Ke the emission and map_Kd the base colour
/// texture. Transparency is left out; so are libraries and textures that are missing or outside
/// the OBJ's folder, and textures neither PNG nor JPEG. Scene::warnings says so. Vertex colours
/// (`v x y z r g b`) are decoded from sRGB, as Blender and MeshLab write them. v is turned to
/// count from the top, as in glTF.
///
/// @throws Error  as loadScene; malformed names the line
Scene readObj(const std::filesystem::path& path);

/// Reads a PLY as one mesh: x y z, nx ny nz, s t (or u v, texture_u texture_v), red green blue
/// alpha, and faces of any size and integer type. Other elements and properties are skipped.
///
/// Integer colours are decoded from sRGB, floating-point ones are linear. v
/// is turned to count from the top.
///
/// @throws Error  as loadScene; unsupported for a point cloud
Scene readPly(const std::filesystem::path& path);

}  // namespace prt

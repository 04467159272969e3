#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prt/image/image.h"
#include "prt/math/vector.h"

namespace prt {

enum class TextureWrap { repeat, mirroredRepeat, clampToEdge };
enum class TextureFilter { nearest, linear };

/// A texture as a material uses it. Image coordinates as in glTF: (0, 0) is the top left corner.
struct TextureUse {
    std::size_t image = 0;  ///< index into Scene::images
    int uvSet = 0;          ///< 0 or 1
    TextureWrap wrapU = TextureWrap::repeat;
    TextureWrap wrapV = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::linear;
};

/// An image file as it came, kept to be handed on, and its decoded pixels for those who need them.
struct TextureImage {
    std::string name;
    std::string mimeType;  ///< "image/png" or "image/jpeg"
    std::vector<std::byte> encoded;
    Rgba8Image pixels;  ///< empty until decoded (io/image_io.h, decodeTextures)
};

enum class AlphaMode { opaque, mask, blend };

/// What bakes need of a glTF material, and what is carried through them untouched.
struct Material {
    std::string name;
    /// Linear; rgb is the diffuse albedo, metallic or not.
    Vec4f baseColorFactor{1.0f, 1.0f, 1.0f, 1.0f};
    std::optional<TextureUse> baseColorTexture;
    Vec3f emissiveFactor{0.0f, 0.0f, 0.0f};
    std::optional<TextureUse> emissiveTexture;
    float metallicFactor = 0.0f;
    float roughnessFactor = 1.0f;
    /// Factors of both: green of roughness, blue of metallic, as they stand in the file (no sRGB).
    std::optional<TextureUse> metallicRoughnessTexture;
    AlphaMode alphaMode = AlphaMode::opaque;  ///< blend is opaque to the bake
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
};

/// Triangles with one material, in world space: instances are flattened,
/// each is a receiver of its own.
struct Mesh {
    std::string name;
    std::size_t material = 0;                  ///< index into Scene::materials
    std::vector<Vec3f> positions;              ///< metres (C1)
    std::vector<Vec3f> normals;                ///< unit; as many as positions
    std::array<std::vector<Vec2f>, 2> uvSets;  ///< each empty or as many as positions
    std::vector<Vec4f> colors;  ///< linear factors of base colour; empty or as many as positions
    std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from outside

    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return indices.size() / 3; }
};

/// A pinhole camera in world space.
struct Camera {
    std::string name;
    Vec3f eye{0.0f, 0.0f, 0.0f};
    Vec3f forward{0.0f, 0.0f, -1.0f};  ///< unit
    Vec3f up{0.0f, 1.0f, 0.0f};        ///< unit, orthogonal to forward
    float verticalFovRadians = 0.8f;
};

/// Everything that is baked together. A reader promises: indices in range, positions and normals
/// finite, normals unit, every reference valid.
struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  ///< never empty when there is a mesh
    std::vector<TextureImage> images;
    std::vector<Camera> cameras;
    std::vector<std::string> warnings;  ///< what a reader mended or left out, one sentence each

    std::size_t vertexCount() const;
    std::size_t triangleCount() const;
};

/// Where each mesh's vertices start in the scene-wide numbering (mesh after
/// mesh); one entry more than meshes.
std::vector<std::size_t> vertexOffsets(const Scene& scene);

/// Smallest axis-aligned box.
struct Bounds {
    Vec3f low{0.0f, 0.0f, 0.0f};
    Vec3f high{0.0f, 0.0f, 0.0f};

    Vec3f center() const { return low + (high - low) * 0.5f; }
    float radius() const { return (high - low).length() * 0.5f; }
};

/// @param scene  at least one vertex
Bounds computeBounds(const Scene& scene);

}  // namespace prt

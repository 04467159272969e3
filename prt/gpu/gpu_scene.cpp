#include "prt/gpu/gpu_scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "prt/gpu/gl_objects.h"
#include "prt/gpu/gpu_textures.h"
#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

constexpr float kNoCutoff = std::numeric_limits<float>::lowest();

/// A vertex as relight.vert has it.
struct GpuVertex {
    Vec3f position{0.0f, 0.0f, 0.0f};
    Vec2f uv0{0.0f, 0.0f};
    Vec2f uv1{0.0f, 0.0f};
    Vec4f color{1.0f, 1.0f, 1.0f, 1.0f};
    Vec3f normal{0.0f, 0.0f, 0.0f};
};

/// A mesh as a range of the scene's indices.
struct Part {
    std::size_t firstIndex = 0;
    std::size_t indexCount = 0;
    Material material;  ///< without the textures that the mesh has no coordinates for
};

std::vector<GpuVertex> collectVertices(const Mesh& mesh) {
    std::vector<GpuVertex> vertices(mesh.vertexCount());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i].position = mesh.positions[i];
        vertices[i].normal = mesh.normals[i];
        if (!mesh.uvSets[0].empty()) vertices[i].uv0 = mesh.uvSets[0][i];
        if (!mesh.uvSets[1].empty()) vertices[i].uv1 = mesh.uvSets[1][i];
        if (!mesh.colors.empty()) vertices[i].color = mesh.colors[i];
    }
    return vertices;
}

void dropMissingTexture(const Mesh& mesh, std::optional<TextureUse>& texture) {
    if (texture && mesh.uvSets[texture->uvSet == 1 ? 1 : 0].empty()) texture.reset();
}

void setMaterial(const Material& material, const GpuTextures& gpuTextures) {
    const auto uvSetOf = [](const std::optional<TextureUse>& texture) {
        return texture && texture->uvSet == 1 ? 1 : 0;
    };
    gpuTextures.bind(textures::kBaseColor, material.baseColorTexture);
    gpuTextures.bind(textures::kEmission, material.emissiveTexture);
    gpuTextures.bind(textures::kMetallicRoughness, material.metallicRoughnessTexture,
                     TexelCurve::linear);
    glUniform4fv(uniforms::kBaseColorFactor, 1, &material.baseColorFactor.x);
    glUniform3fv(uniforms::kEmissiveFactor, 1, &material.emissiveFactor.x);
    glUniform2f(uniforms::kMetallicRoughnessFactors, material.metallicFactor,
                material.roughnessFactor);
    glUniform3i(uniforms::kTextureUvSets, uvSetOf(material.baseColorTexture),
                uvSetOf(material.emissiveTexture), uvSetOf(material.metallicRoughnessTexture));
    const bool isMask = material.alphaMode == AlphaMode::mask;
    glUniform1f(uniforms::kAlphaCutoff, isMask ? material.alphaCutoff : kNoCutoff);
    if (material.doubleSided)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
}

void addAttribute(unsigned location, GLint size, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(GpuVertex),
                          reinterpret_cast<const void*>(offset));
}

}  // namespace

struct GpuScene::Content {
    std::size_t vertexCount = 0;
    Bounds bounds;
    GpuTextures textures;
    GlName vertices;
    GlName indices;
    GlName layout;
    std::vector<Part> parts;

    explicit Content(const Scene& scene)
        : vertexCount(scene.vertexCount()),
          textures(scene),
          vertices(makeBuffer(scene.vertexCount() * sizeof(GpuVertex), "vertices")),
          indices(makeBuffer(3 * scene.triangleCount() * sizeof(std::uint32_t), "triangles")) {
        if (vertexCount > 0) bounds = computeBounds(scene);
        std::size_t firstVertex = 0;
        std::size_t firstIndex = 0;
        for (const Mesh& mesh : scene.meshes) {
            addMesh(mesh, scene.materials[mesh.material], firstVertex, firstIndex);
            firstVertex += mesh.vertexCount();
            firstIndex += mesh.indices.size();
        }
        describeLayout();
    }

    /// Vertices are numbered through the scene, as receivers are.
    void addMesh(const Mesh& mesh, Material material, std::size_t firstVertex,
                 std::size_t firstIndex) {
        const std::vector<GpuVertex> collected = collectVertices(mesh);
        writeBuffer(vertices, firstVertex * sizeof(GpuVertex), std::as_bytes(std::span(collected)));
        std::vector<std::uint32_t> numbers = mesh.indices;
        for (std::uint32_t& number : numbers)
            number += static_cast<std::uint32_t>(firstVertex);
        writeBuffer(indices, firstIndex * sizeof(std::uint32_t), std::as_bytes(std::span(numbers)));
        dropMissingTexture(mesh, material.baseColorTexture);
        dropMissingTexture(mesh, material.emissiveTexture);
        dropMissingTexture(mesh, material.metallicRoughnessTexture);
        parts.push_back({firstIndex, numbers.size(), std::move(material)});
    }

    void describeLayout() {
        unsigned name = 0;
        glGenVertexArrays(1, &name);
        layout = GlName(name, [](unsigned given) { glDeleteVertexArrays(1, &given); });
        glBindVertexArray(name);
        glBindBuffer(GL_ARRAY_BUFFER, vertices.get());
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.get());
        addAttribute(attributes::kPosition, 3, offsetof(GpuVertex, position));
        addAttribute(attributes::kUvSets, 4, offsetof(GpuVertex, uv0));
        addAttribute(attributes::kColor, 4, offsetof(GpuVertex, color));
        addAttribute(attributes::kNormal, 3, offsetof(GpuVertex, normal));
        glBindVertexArray(0);
    }
};

static_assert(offsetof(GpuVertex, uv1) == offsetof(GpuVertex, uv0) + sizeof(Vec2f));

GpuScene::GpuScene(const Scene& scene) : content_(std::make_unique<Content>(scene)) {}
GpuScene::~GpuScene() = default;
GpuScene::GpuScene(GpuScene&&) noexcept = default;
GpuScene& GpuScene::operator=(GpuScene&&) noexcept = default;

std::size_t GpuScene::vertexCount() const {
    return content_->vertexCount;
}

bool GpuScene::hasTextures() const {
    return std::ranges::any_of(content_->parts, [](const Part& part) {
        return part.material.baseColorTexture || part.material.emissiveTexture ||
               part.material.metallicRoughnessTexture;
    });
}

const Bounds& GpuScene::bounds() const {
    return content_->bounds;
}

void GpuScene::drawTriangles() const {
    glBindVertexArray(content_->layout.get());
    for (const Part& part : content_->parts) {
        setMaterial(part.material, content_->textures);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(part.indexCount), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(part.firstIndex * sizeof(std::uint32_t)));
    }
    glBindVertexArray(0);
}

}  // namespace prt

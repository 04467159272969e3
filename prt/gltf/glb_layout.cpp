#include "prt/gltf/glb_layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gltf/accessor.h"

namespace prt::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF stores little endian, as we write");

// The largest index of 16 bits is kept for primitive restart [glTF 2.0, 3.7.2.1].
constexpr std::size_t kMaxShortIndexedVertices = 65535;

/// Copies an array as it lies in memory.
template <class Value>
auto copyOf(const std::vector<Value>& values) {
    return [&values](std::span<std::byte> bytes) {
        PRT_ASSERT(bytes.size() == values.size() * sizeof(Value), "there is one value a vertex");
        std::memcpy(bytes.data(), values.data(), bytes.size());
    };
}

template <class Index>
auto narrowedCopyOf(const std::vector<std::uint32_t>& indices) {
    return [&indices](std::span<std::byte> bytes) {
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const auto index = static_cast<Index>(indices[i]);
            std::memcpy(bytes.data() + i * sizeof(Index), &index, sizeof(Index));
        }
    };
}

std::pair<Vec3f, Vec3f> boundsOf(const std::vector<Vec3f>& positions) {
    Vec3f low = positions.front();
    Vec3f high = low;
    for (const Vec3f& position : positions) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], position[axis]);
            high[axis] = std::max(high[axis], position[axis]);
        }
    }
    return {low, high};
}

/// How many UV sets to write: glTF wants them numbered without gaps.
std::size_t countUvSets(const Mesh& mesh) {
    std::size_t count = mesh.uvSets.size();
    while (count > 0 && mesh.uvSets[count - 1].empty())
        --count;
    return count;
}

/// Lays one part of the file after another.
class Arranger {
  public:
    void addOwnAccessor(const GlbAccessor& accessor) {
        addAccessor(accessor.name, accessor.info, ViewTarget::none, accessor.write);
    }

    void addMesh(const Scene& scene, std::size_t meshIndex, const GlbExtension* extension) {
        const Mesh& mesh = scene.meshes[meshIndex];
        meshName_ = " of mesh " + std::to_string(meshIndex);
        vertexCount_ = mesh.vertexCount();
        layout_.primitives.push_back({meshIndex, {}, 0});

        addAttribute("POSITION", {vertexCount_, 3}, copyOf(mesh.positions));
        layout_.accessors.back().bounds = boundsOf(mesh.positions);
        if (!mesh.normals.empty()) addAttribute("NORMAL", {vertexCount_, 3}, copyOf(mesh.normals));
        for (std::size_t set = 0; set < countUvSets(mesh); ++set)
            addUvSet(mesh, set);
        if (!mesh.colors.empty()) addColors(mesh);
        if (extension) {
            for (const GlbAccessor& attribute : extension->attributes[meshIndex])
                addAttribute(attribute.name, attribute.info, attribute.write);
        }
        addIndices(mesh);
    }

    void addImage(const TextureImage& image, std::size_t index) {
        const std::string name = "image " + std::to_string(index);
        if (image.encoded.empty())
            throw Error(ErrorCode::unsupported, name + " has no PNG or JPEG data to be stored");
        addView({name, 0, image.encoded.size(), ViewTarget::none, false, copyOf(image.encoded)},
                image.encoded.size());
    }

    GlbLayout takeLayout() { return std::move(layout_); }

  private:
    using Writer = std::function<void(std::span<std::byte>)>;

    void addUvSet(const Mesh& mesh, std::size_t set) {
        const std::vector<Vec2f>& uvs = mesh.uvSets[set];
        const Writer writeZeros = [](std::span<std::byte>) {};
        addAttribute("TEXCOORD_" + std::to_string(set), {vertexCount_, 2},
                     uvs.empty() ? writeZeros : copyOf(uvs));
    }

    void addColors(const Mesh& mesh) {
        addAttribute("COLOR_0", {vertexCount_, 4},
                     [&colors = mesh.colors](std::span<std::byte> bytes) {
                         for (std::size_t i = 0; i < colors.size(); ++i) {
                             Vec4f color = colors[i];
                             for (int c = 0; c < 4; ++c)
                                 color[c] = std::clamp(color[c], 0.0f, 1.0f);
                             std::memcpy(bytes.data() + i * sizeof(color), &color, sizeof(color));
                         }
                     });
    }

    void addAttribute(const std::string& semantic, const AccessorInfo& info, Writer write) {
        PRT_ASSERT(info.count == vertexCount_, "an attribute has one value a vertex");
        layout_.primitives.back().attributes.emplace_back(semantic, layout_.accessors.size());
        addAccessor(semantic + meshName_, info, ViewTarget::vertices, std::move(write));
    }

    void addIndices(const Mesh& mesh) {
        layout_.primitives.back().indices = layout_.accessors.size();
        AccessorInfo info{mesh.indices.size(), 1, ComponentType::uint32};
        Writer write = copyOf(mesh.indices);
        if (vertexCount_ <= kMaxShortIndexedVertices) {
            info.type = ComponentType::uint16;
            write = narrowedCopyOf<std::uint16_t>(mesh.indices);
        }
        addAccessor("the indices" + meshName_, info, ViewTarget::indices, std::move(write));
    }

    void addAccessor(const std::string& name, const AccessorInfo& info, ViewTarget target,
                     Writer write) {
        const std::size_t elementBytes =
            static_cast<std::size_t>(info.componentCount) * componentBytes(info.type);
        PRT_ASSERT(target != ViewTarget::vertices || elementBytes % kAlignmentBytes == 0,
                   "vertex attributes start at multiples of four bytes");
        layout_.accessors.push_back({info, std::nullopt});
        // What an accessor reads is padded; images need no alignment, and stay as long as they
        // came.
        const std::size_t dataBytes = info.count * elementBytes;
        addView({name, 0, alignUp(dataBytes), target, info.type == ComponentType::float32,
                 std::move(write)},
                dataBytes);
    }

    /// @param dataBytes  of view.byteLength, for view.write; the rest stays zero
    void addView(ViewLayout view, std::size_t dataBytes) {
        view.write = [write = std::move(view.write), dataBytes](std::span<std::byte> bytes) {
            write(bytes.first(dataBytes));
        };
        view.byteOffset = layout_.byteLength;
        layout_.byteLength += view.byteLength;
        layout_.views.push_back(std::move(view));
    }

    GlbLayout layout_;
    std::string meshName_;
    std::size_t vertexCount_ = 0;
};

void requireFinite(const ViewLayout& view, std::span<const std::byte> bytes) {
    for (std::size_t offset = 0; offset < bytes.size(); offset += sizeof(float)) {
        float value;
        std::memcpy(&value, bytes.data() + offset, sizeof(value));
        if (!std::isfinite(value))
            throw Error(ErrorCode::malformed, view.name + " holds a number that is not finite");
    }
}

}  // namespace

GlbLayout layOutBinary(const Scene& scene, const GlbExtension* extension) {
    Arranger arranger;
    if (extension)
        for (const GlbAccessor& accessor : extension->accessors)
            arranger.addOwnAccessor(accessor);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        if (scene.meshes[mesh].triangleCount() > 0) arranger.addMesh(scene, mesh, extension);
    for (std::size_t image = 0; image < scene.images.size(); ++image)
        arranger.addImage(scene.images[image], image);
    return arranger.takeLayout();
}

void writeView(const ViewLayout& view, std::span<std::byte> bytes) {
    view.write(bytes);
    if (view.holdsFloats) requireFinite(view, bytes);
}

}  // namespace prt::gltf

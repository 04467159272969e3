#include "prt/gltf/glb_description.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "prt/base/assert.h"
#include "prt/base/error.h"

namespace prt::gltf {
namespace {

using Json = nlohmann::ordered_json;

// Behind the binary chunk, which is the first.
constexpr int kFallbackBuffer = 1;
constexpr const char* kUnlitExtension = "KHR_materials_unlit";
// A near plane that keeps the depth buffer useful: this fraction of the scene's size.
constexpr double kNearPerSceneRadius = 1e-3;

double requireFinite(double number, const char* what) {
    if (std::isfinite(number)) return number;
    throw Error(ErrorCode::malformed, std::string("the scene has ") + what + " that is not finite");
}

template <class Vector>
Json describeVector(const Vector& vector, const char* what) {
    Json numbers = Json::array();
    for (unsigned int i = 0; i < Vector::dimensions(); ++i)
        numbers.push_back(requireFinite(vector[static_cast<int>(i)], what));
    return numbers;
}

double clampToUnit(double factor) {
    return std::clamp(requireFinite(factor, "a material factor"), 0.0, 1.0);
}

void addName(Json& object, const std::string& name) {
    if (!name.empty()) object["name"] = name;
}

void addUnlessEmpty(Json& object, const char* key, Json list) {
    if (!list.empty()) object[key] = std::move(list);
}

/// The index of an object in a list without duplicates, to which it is added when new.
std::size_t findOrAdd(Json& list, const Json& object) {
    const auto found = std::find(list.begin(), list.end(), object);
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    list.push_back(object);
    return list.size() - 1;
}

int wrapCode(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::repeat:
            break;
        case TextureWrap::mirroredRepeat:
            return 33648;
        case TextureWrap::clampToEdge:
            return 33071;
    }
    return 10497;
}

int componentCode(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return 5120;
        case ComponentType::uint8:
            return 5121;
        case ComponentType::int16:
            return 5122;
        case ComponentType::uint16:
            return 5123;
        case ComponentType::uint32:
            return 5125;
        case ComponentType::float32:
            break;
    }
    return 5126;
}

const char* elementType(int componentCount) {
    switch (componentCount) {
        case 1:
            return "SCALAR";
        case 2:
            return "VEC2";
        case 3:
            return "VEC3";
        case 4:
            break;
        default:
            PRT_ASSERT(false, "attributes have one to four components");
    }
    return "VEC4";
}

/// The file's JSON, part by part.
class GlbDescription {
  public:
    GlbDescription(const Scene& scene, const GlbExtension* extension, const GlbLayout& layout,
                   const GlbStorage& storage, const GlbOptions& options)
        : scene_(scene),
          extension_(extension),
          layout_(layout),
          storage_(storage),
          options_(options) {}

    std::string dump() {
        Json root;
        root["asset"] = {{"version", "2.0"}, {"generator", "OpenPRT"}};
        if (extension_) useExtension(extension_->name);
        describeMaterials();
        describeMeshes();
        describeCameras();
        if (storage_.hasEncodedViews()) {
            useExtension(kMeshoptExtension);
            root["extensionsRequired"] = {kMeshoptExtension};
        }
        addUnlessEmpty(root, "extensionsUsed", extensionsUsed_);
        Json rootNodes = Json::array();
        for (std::size_t node = 0; node < nodes_.size(); ++node)
            rootNodes.push_back(node);
        Json scene = Json::object();
        addUnlessEmpty(scene, "nodes", std::move(rootNodes));
        root["scene"] = 0;
        root["scenes"] = Json::array({std::move(scene)});
        addUnlessEmpty(root, "nodes", std::move(nodes_));
        addUnlessEmpty(root, "cameras", std::move(cameras_));
        addUnlessEmpty(root, "meshes", std::move(meshes_));
        addUnlessEmpty(root, "materials", std::move(materials_));
        addUnlessEmpty(root, "textures", std::move(textures_));
        addUnlessEmpty(root, "samplers", std::move(samplers_));
        addUnlessEmpty(root, "images", describeImages());
        addUnlessEmpty(root, "accessors", describeAccessors());
        addUnlessEmpty(root, "bufferViews", describeViews());
        addUnlessEmpty(root, "buffers", describeBuffers());
        if (extension_) {
            Json object = Json::parse(extension_->rootJson);
            object["checksums"] = Json::array();
            for (const StoredView& view : storage_.views)
                object["checksums"].push_back(view.checksum);
            root["extensions"][extension_->name] = std::move(object);
        }
        // Names may come from anywhere; glTF is UTF-8.
        return root.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

  private:
    void useExtension(const std::string& name) {
        if (std::find(extensionsUsed_.begin(), extensionsUsed_.end(), name) ==
            extensionsUsed_.end())
            extensionsUsed_.push_back(name);
    }

    Json describeTexture(const TextureUse& use) {
        const bool isNearest = use.filter == TextureFilter::nearest;
        const std::size_t sampler = findOrAdd(samplers_, {{"magFilter", isNearest ? 9728 : 9729},
                                                          {"minFilter", isNearest ? 9728 : 9987},
                                                          {"wrapS", wrapCode(use.wrapU)},
                                                          {"wrapT", wrapCode(use.wrapV)}});
        Json info;
        info["index"] = findOrAdd(textures_, {{"sampler", sampler}, {"source", use.image}});
        if (use.uvSet != 0) info["texCoord"] = use.uvSet;
        return info;
    }

    void describeMaterials() {
        for (const Material& material : scene_.materials)
            materials_.push_back(describeMaterial(material));
    }

    Json describeMaterial(const Material& material) {
        Json object;
        addName(object, material.name);
        Json& surface = object["pbrMetallicRoughness"];
        for (int c = 0; c < 4; ++c)
            surface["baseColorFactor"].push_back(clampToUnit(material.baseColorFactor[c]));
        if (material.baseColorTexture)
            surface["baseColorTexture"] = describeTexture(*material.baseColorTexture);
        surface["metallicFactor"] = clampToUnit(material.metallicFactor);
        surface["roughnessFactor"] = clampToUnit(material.roughnessFactor);
        if (material.metallicRoughnessTexture)
            surface["metallicRoughnessTexture"] =
                describeTexture(*material.metallicRoughnessTexture);
        describeEmission(material, object);
        if (material.alphaMode == AlphaMode::mask) {
            object["alphaMode"] = "MASK";
            object["alphaCutoff"] =
                std::max(0.0, requireFinite(material.alphaCutoff, "an alpha cutoff"));
        } else if (material.alphaMode == AlphaMode::blend) {
            object["alphaMode"] = "BLEND";
        }
        if (material.doubleSided) object["doubleSided"] = true;
        if (options_.unlit) {
            useExtension(kUnlitExtension);
            object["extensions"][kUnlitExtension] = Json::object();
        }
        return object;
    }

    /// Splits emission into a colour, which glTF keeps within [0, 1], and a strength.
    void describeEmission(const Material& material, Json& object) {
        if (material.emissiveTexture)
            object["emissiveTexture"] = describeTexture(*material.emissiveTexture);
        const Vec3f& factor = material.emissiveFactor;
        if (factor == Vec3f(0.0f)) return;
        const float strength = std::max({1.0f, factor.x, factor.y, factor.z});
        object["emissiveFactor"] = describeVector(factor / strength, "an emissive factor");
        if (strength == 1.0f) return;
        constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
        useExtension(kEmissiveStrength);
        object["extensions"][kEmissiveStrength]["emissiveStrength"] = strength;
    }

    void describeMeshes() {
        for (const PrimitiveLayout& layout : layout_.primitives) {
            const Mesh& mesh = scene_.meshes[layout.mesh];
            Json primitive;
            for (const auto& [semantic, accessor] : layout.attributes)
                primitive["attributes"][semantic] = accessor;
            primitive["indices"] = layout.indices;
            primitive["material"] = findMaterial(mesh);
            if (extension_) primitive["extensions"][extension_->name] = describeBinding(layout);

            Json node = {{"mesh", meshes_.size()}};
            addName(node, mesh.name);
            nodes_.push_back(std::move(node));
            Json object;
            addName(object, mesh.name);
            object["primitives"] = Json::array({std::move(primitive)});
            meshes_.push_back(std::move(object));
        }
    }

    /// The mesh's material; without the textures for which the mesh has no
    /// UVs, which glTF does not allow.
    std::size_t findMaterial(const Mesh& mesh) {
        const auto lacksUvs = [&](const std::optional<TextureUse>& texture) {
            return texture && mesh.uvSets[static_cast<std::size_t>(texture->uvSet)].empty();
        };
        Material material = scene_.materials[mesh.material];
        bool isWhole = true;
        for (std::optional<TextureUse>* texture :
             {&material.baseColorTexture, &material.metallicRoughnessTexture,
              &material.emissiveTexture}) {
            if (!lacksUvs(*texture)) continue;
            texture->reset();
            isWhole = false;
        }
        return isWhole ? mesh.material : findOrAdd(materials_, describeMaterial(material));
    }

    Json describeBinding(const PrimitiveLayout& layout) const {
        Json object = Json::parse(extension_->meshJson[layout.mesh]);
        for (const auto& [semantic, accessor] : layout.attributes)
            object["checksums"][semantic] = storage_.views[accessor].valuesChecksum;
        return object;
    }

    void describeCameras() {
        if (scene_.cameras.empty()) return;
        const double radius = scene_.vertexCount() > 0 ? computeBounds(scene_).radius() : 0.0;
        const double nearPlane = radius > 0.0 ? kNearPerSceneRadius * radius : kNearPerSceneRadius;
        const Json identity = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
                               0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
        for (const Camera& camera : scene_.cameras) {
            const double fov = requireFinite(camera.verticalFovRadians, "a field of view");
            Json object;
            object["type"] = "perspective";
            object["perspective"] = {{"yfov", fov}, {"znear", nearPlane}};
            addName(object, camera.name);

            Json node = {{"camera", cameras_.size()}};
            addName(node, camera.name);
            const Json worldFromCamera = describePose(camera);
            if (worldFromCamera != identity) node["matrix"] = worldFromCamera;
            nodes_.push_back(std::move(node));
            cameras_.push_back(std::move(object));
        }
    }

    /// The column-major worldFromCamera: a glTF camera looks along its −z, with +y up.
    static Json describePose(const Camera& camera) {
        const Vec3d back = -Vec3d(camera.forward).normalized();
        const Vec3d right = Vec3d(camera.up).cross(back).normalized();
        const Vec3d up = back.cross(right);
        Json matrix = Json::array();
        for (const Vec3d& column : {right, up, back, Vec3d(camera.eye)}) {
            for (int axis = 0; axis < 3; ++axis)
                matrix.push_back(requireFinite(column[axis], "a camera"));
            matrix.push_back(matrix.size() == 15 ? 1.0 : 0.0);
        }
        return matrix;
    }

    Json describeImages() const {
        Json images = Json::array();
        for (std::size_t i = 0; i < scene_.images.size(); ++i) {
            Json image;
            addName(image, scene_.images[i].name);
            image["mimeType"] = scene_.images[i].mimeType;
            image["bufferView"] = layout_.viewOfImage(i);
            images.push_back(std::move(image));
        }
        return images;
    }

    Json describeAccessors() const {
        Json accessors = Json::array();
        for (std::size_t i = 0; i < layout_.accessors.size(); ++i) {
            const AccessorLayout& layout = layout_.accessors[i];
            Json accessor;
            accessor["bufferView"] = i;
            accessor["componentType"] = componentCode(layout.info.type);
            if (layout.info.normalized) accessor["normalized"] = true;
            accessor["count"] = layout.info.count;
            accessor["type"] = elementType(layout.info.componentCount);
            if (layout.bounds) {
                accessor["min"] = describeVector(layout.bounds->first, "a position");
                accessor["max"] = describeVector(layout.bounds->second, "a position");
            }
            accessors.push_back(std::move(accessor));
        }
        return accessors;
    }

    Json describeViews() const {
        Json views = Json::array();
        for (std::size_t i = 0; i < layout_.views.size(); ++i) {
            const ViewLayout& layout = layout_.views[i];
            const StoredView& stored = storage_.views[i];
            Json view;
            view["buffer"] = stored.encoding ? kFallbackBuffer : 0;
            view["byteOffset"] = stored.encoding ? layout.byteOffset : stored.byteOffset;
            view["byteLength"] =
                stored.encoding ? stored.encoding->decodedBytes() : stored.byteLength;
            if (layout.target != ViewTarget::none) view["target"] = static_cast<int>(layout.target);
            if (stored.encoding)
                view["extensions"][kMeshoptExtension] = {
                    {"buffer", 0},
                    {"byteOffset", stored.byteOffset},
                    {"byteLength", stored.byteLength},
                    {"byteStride", stored.encoding->byteStride},
                    {"count", stored.encoding->count},
                    {"mode", meshoptModeName(stored.encoding->mode)}};
            views.push_back(std::move(view));
        }
        return views;
    }

    /// The binary chunk; and the buffer without bytes in which encoded views would lie decoded.
    Json describeBuffers() const {
        Json buffers = Json::array();
        if (storage_.byteLength > 0) buffers.push_back({{"byteLength", storage_.byteLength}});
        if (storage_.hasEncodedViews()) {
            Json fallback = {{"byteLength", layout_.byteLength}};
            fallback["extensions"][kMeshoptExtension]["fallback"] = true;
            buffers.push_back(std::move(fallback));
        }
        return buffers;
    }

    const Scene& scene_;
    const GlbExtension* extension_;
    const GlbLayout& layout_;
    const GlbStorage& storage_;
    const GlbOptions& options_;
    Json extensionsUsed_ = Json::array();
    Json nodes_ = Json::array();
    Json cameras_ = Json::array();
    Json meshes_ = Json::array();
    Json materials_ = Json::array();
    Json textures_ = Json::array();
    Json samplers_ = Json::array();
};

}  // namespace

std::string describeGlb(const Scene& scene, const GlbExtension* extension, const GlbLayout& layout,
                        const GlbStorage& storage, const GlbOptions& options) {
    return GlbDescription(scene, extension, layout, storage, options).dump();
}

}  // namespace prt::gltf

#include "prt/gltf/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "prt/base/error.h"
#include "prt/scene/normals.h"

namespace prt::gltf {
namespace {

template <class Vector>
std::span<const float> componentsOf(const std::vector<Vector>& vectors) {
    return {&vectors.data()->x, vectors.size() * Vector::dimensions()};
}

/// Reads an attribute all of whose numbers are finite.
///
/// @param place  where the attribute stands in the file
template <class Vector>
std::vector<Vector> readFinite(const Accessor& accessor, const std::string& place) {
    std::vector<Vector> vectors = readVectors<Vector>(accessor);
    checkFinite(componentsOf(vectors), place);
    return vectors;
}

std::string placeOf(const Primitive& primitive, const std::string& semantic) {
    return primitive.place + ".attributes." + semantic;
}

/// @throws Error  malformed for what no float can hold
float toFloat(double number, const std::string& place) {
    if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max())))
        throw Error(ErrorCode::malformed, place + " is transformed beyond what a float can hold");
    return static_cast<float>(number);
}

std::vector<Vec3f> readPositions(const Model& model, const Primitive& primitive,
                                 const Affine3d& worldFromNode) {
    const std::string place = placeOf(primitive, "POSITION");
    const std::size_t accessor = *primitive.findAttribute("POSITION");
    std::vector<Vec3f> positions = readFinite<Vec3f>(model.accessors[accessor], place);
    for (Vec3f& position : positions) {
        const Vec3d world = transformPoint(worldFromNode, Vec3d(position));
        position = Vec3f(toFloat(world.x, place), toFloat(world.y, place), toFloat(world.z, place));
    }
    return positions;
}

void turnTriangles(std::vector<std::uint32_t>& indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        std::swap(indices[i + 1], indices[i + 2]);
}

/// A unit vector, or zero where there is no direction.
Vec3f unitOrZero(const Vec3d& vector) {
    const double length = vector.length();
    return length > 0.0 && std::isfinite(length) ? Vec3f(vector / length) : Vec3f(0.0f);
}

/// Gives the mesh the file's normals, and computed ones where the file's
/// have no direction or are missing.
void readNormals(const Model& model, const Primitive& primitive, const Mat3d& worldFromNormal,
                 Mesh& mesh, Warnings& warnings) {
    std::vector<Vec3f> normals(mesh.vertexCount(), Vec3f(0.0f));
    const auto accessor = primitive.findAttribute("NORMAL");
    if (accessor) normals = readVectors<Vec3f>(model.accessors[*accessor]);
    for (Vec3f& normal : normals)
        normal = unitOrZero(worldFromNormal * Vec3d(normal));

    if (std::find(normals.begin(), normals.end(), Vec3f(0.0f)) != normals.end()) {
        if (accessor)
            warnings.add(primitive.place + " has normals without a direction, which were computed");
        computeMissingNormals(mesh);
        for (std::size_t i = 0; i < normals.size(); ++i)
            if (normals[i] == Vec3f(0.0f)) normals[i] = mesh.normals[i];
    }
    mesh.normals = std::move(normals);
}

void mapUvs(const UvSource& source, const std::string& place, std::vector<Vec2f>& uvs) {
    const auto& m = source.linear;
    for (Vec2f& uv : uvs) {
        const double u = static_cast<double>(uv.x);
        const double v = static_cast<double>(uv.y);
        uv = Vec2f(toFloat(m[0] * u + m[1] * v + source.offset[0], place),
                   toFloat(m[2] * u + m[3] * v + source.offset[1], place));
    }
}

bool usesUvSet(const Material& material, int uvSet) {
    const auto isUse = [uvSet](const std::optional<TextureUse>& texture) {
        return texture && texture->uvSet == uvSet;
    };
    return isUse(material.baseColorTexture) || isUse(material.emissiveTexture) ||
           isUse(material.metallicRoughnessTexture);
}

void readUvSets(const Model& model, const Primitive& primitive, Mesh& mesh, Warnings& warnings) {
    const MaterialRecord record =
        primitive.material ? model.materials.records[*primitive.material] : MaterialRecord();
    for (std::size_t set = 0; set < mesh.uvSets.size(); ++set) {
        const UvSource& source = record.uvSources[set];
        const std::string semantic = "TEXCOORD_" + std::to_string(source.texCoord);
        const std::string place = placeOf(primitive, semantic);
        if (const auto accessor = primitive.findAttribute(semantic)) {
            mesh.uvSets[set] = readFinite<Vec2f>(model.accessors[*accessor], place);
            if (source.isMapped()) mapUvs(source, place, mesh.uvSets[set]);
        } else if (usesUvSet(record.material, static_cast<int>(set))) {
            warnings.add(place + " is missing, and its texture is read at (0, 0)");
            mesh.uvSets[set].assign(mesh.vertexCount(), Vec2f(0.0f));
        }
    }
}

std::vector<Vec4f> readColors(const Model& model, const Primitive& primitive, Warnings& warnings) {
    const auto index = primitive.findAttribute("COLOR_0");
    if (!index) return {};
    const Accessor& accessor = model.accessors[*index];
    const std::string place = placeOf(primitive, "COLOR_0");
    std::vector<Vec4f> colors;
    if (accessor.info.componentCount == 4)
        colors = readFinite<Vec4f>(accessor, place);
    else
        for (const Vec3f& rgb : readFinite<Vec3f>(accessor, place))
            colors.emplace_back(rgb.x, rgb.y, rgb.z, 1.0f);

    for (Vec4f& color : colors) {
        const Vec4f given = color;
        for (int i = 0; i < 4; ++i)
            color[i] = std::clamp(color[i], 0.0f, 1.0f);
        if (color != given) warnings.add(place + " is out of range and was clamped");
    }
    return colors;
}

}  // namespace

Mesh buildMesh(const Model& model, const Primitive& primitive, const Instance& instance,
               Warnings& warnings) {
    Mesh mesh;
    mesh.positions = readPositions(model, primitive, instance.worldFromNode);
    mesh.indices = readTriangles(primitive, model.accessors);
    if (instance.isMirrored) turnTriangles(mesh.indices);
    readNormals(model, primitive, instance.worldFromNormal, mesh, warnings);
    readUvSets(model, primitive, mesh, warnings);
    mesh.colors = readColors(model, primitive, warnings);
    return mesh;
}

}  // namespace prt::gltf

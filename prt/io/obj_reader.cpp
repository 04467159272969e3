#include "prt/io/obj_reader.h"

#include <algorithm>
#include <unordered_map>

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/base/random.h"
#include "prt/image/tone_curve.h"
#include "prt/io/mesh_completion.h"
#include "prt/io/obj_materials.h"
#include "prt/io/obj_parser.h"
#include "prt/io/scene_io.h"

namespace prt {
namespace {

// A corner takes two bytes at least: below this size all indices fit in 32 bits.
constexpr std::uintmax_t kMaxObjBytes = std::uintmax_t(4) << 30;

struct CornerHash {
    std::size_t operator()(const ObjCorner& corner) const {
        const std::uint64_t uvAndNormal = (std::uint64_t(corner.uv) << 32) | corner.normal;
        return mixBits(mixBits(uvAndNormal) ^ corner.position);
    }
};

/// Gathers the faces of one material; corners that agree in all three indices are one vertex.
class ObjMeshBuilder {
  public:
    explicit ObjMeshBuilder(const ObjGeometry& geometry) : geometry_(geometry) {}

    void addFace(const ObjFace& face) {
        polygon_.clear();
        polygonPositions_.clear();
        for (std::size_t i = 0; i < face.cornerCount; ++i) {
            const ObjCorner& corner = geometry_.corners[face.firstCorner + i];
            polygon_.push_back(findOrAddVertex(corner));
            polygonPositions_.push_back(geometry_.positions[corner.position]);
        }
        polygonTriangles_.clear();
        triangulatePolygon(polygonPositions_, polygonTriangles_);
        for (const std::uint32_t corner : polygonTriangles_)
            mesh_.indices.push_back(polygon_[corner]);
    }

    Mesh finish() {
        for (const ObjCorner& vertex : vertices_)
            mesh_.positions.push_back(geometry_.positions[vertex.position]);
        addUvs();
        addNormals();
        addColors();
        return std::move(mesh_);
    }

  private:
    std::uint32_t findOrAddVertex(const ObjCorner& corner) {
        const auto [entry, isNew] =
            vertexOfCorner_.try_emplace(corner, static_cast<std::uint32_t>(vertices_.size()));
        if (isNew) vertices_.push_back(corner);
        return entry->second;
    }

    template <class Predicate>
    bool anyVertex(Predicate predicate) const {
        return std::any_of(vertices_.begin(), vertices_.end(), predicate);
    }

    void addUvs() {
        if (!anyVertex([](const ObjCorner& vertex) { return vertex.uv != kObjNone; })) return;
        for (const ObjCorner& vertex : vertices_) {
            const Vec2f uv = vertex.uv == kObjNone ? Vec2f(0.0f, 1.0f) : geometry_.uvs[vertex.uv];
            // glTF counts v from the top row of the image, OBJ from the bottom.
            mesh_.uvSets[0].emplace_back(uv.x, 1.0f - uv.y);
        }
    }

    void addNormals() {
        if (!anyVertex([](const ObjCorner& vertex) { return vertex.normal != kObjNone; })) return;
        for (const ObjCorner& vertex : vertices_)
            mesh_.normals.push_back(vertex.normal == kObjNone ? Vec3f(0.0f)
                                                              : geometry_.normals[vertex.normal]);
    }

    void addColors() {
        if (geometry_.colors.empty()) return;
        for (const ObjCorner& vertex : vertices_) {
            const Vec3f& color = geometry_.colors[vertex.position];
            mesh_.colors.emplace_back(decodeSrgb(color.x), decodeSrgb(color.y), decodeSrgb(color.z),
                                      1.0f);
        }
    }

    const ObjGeometry& geometry_;
    std::vector<ObjCorner> vertices_;
    std::unordered_map<ObjCorner, std::uint32_t, CornerHash> vertexOfCorner_;
    std::vector<std::uint32_t> polygon_;
    std::vector<Vec3f> polygonPositions_;
    std::vector<std::uint32_t> polygonTriangles_;
    Mesh mesh_;
};

/// The faces of each material, by its index in the geometry; materials in
/// the order of their first face.
std::vector<std::vector<std::size_t>> groupFacesByMaterial(const ObjGeometry& geometry) {
    std::vector<std::size_t> groupOfMaterial(geometry.materialNames.size(), geometry.faces.size());
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < geometry.faces.size(); ++i) {
        std::size_t& group = groupOfMaterial[geometry.faces[i].material];
        if (group == geometry.faces.size()) {
            group = groups.size();
            groups.emplace_back();
        }
        groups[group].push_back(i);
    }
    return groups;
}

Mesh buildMesh(const ObjGeometry& geometry, const std::vector<std::size_t>& faces) {
    ObjMeshBuilder builder(geometry);
    for (const std::size_t face : faces)
        builder.addFace(geometry.faces[face]);
    return builder.finish();
}

/// A texture without coordinates has no place on the mesh.
void dropTextureWithoutUvs(const Mesh& mesh, Scene& scene) {
    Material& material = scene.materials[mesh.material];
    if (!material.baseColorTexture || !mesh.uvSets[0].empty()) return;
    material.baseColorTexture.reset();
    scene.warnings.push_back("the texture of material \"" + material.name +
                             "\" was left out: its faces have no texture coordinates");
}

}  // namespace

Scene parseObjScene(std::string_view text, const std::filesystem::path& path) {
    const ObjGeometry geometry = parseObj(text, path.string());
    if (geometry.faces.empty()) throw Error(ErrorCode::malformed, "has no faces", path.string());

    Scene scene;
    if (geometry.degenerateFaceCount > 0)
        scene.warnings.push_back(std::to_string(geometry.degenerateFaceCount) +
                                 " faces with fewer than three corners were left out");
    ObjMaterials materials(path.parent_path(), scene);
    for (const std::string& names : geometry.libraryNames)
        materials.addLibraries(names);
    for (const std::vector<std::size_t>& faces : groupFacesByMaterial(geometry)) {
        const std::string& name = geometry.materialNames[geometry.faces[faces[0]].material];
        Mesh mesh = buildMesh(geometry, faces);
        mesh.material = materials.use(name);
        mesh.name = scene.materials[mesh.material].name;
        if (const std::size_t count = completeNormals(mesh))
            scene.warnings.push_back(std::to_string(count) + " normals of \"" + mesh.name +
                                     "\" were missing or zero and were computed");
        dropTextureWithoutUvs(mesh, scene);
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

Scene readObj(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path, kMaxObjBytes);
    return parseObjScene({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace prt

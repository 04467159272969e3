#include "prt/gltf/flatten.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "prt/base/error.h"
#include "prt/gltf/mesh_builder.h"
#include "prt/math/transform.h"

namespace prt::gltf {
namespace {

/// Below this volume of its unit cube's image, for axes of length 1, a map is taken for flat.
constexpr double kFlatVolume = 1e-12;

/// A primitive that makes triangles.
struct Drawable {
    std::size_t primitive = 0;
    std::size_t vertexCount = 0;
    std::size_t triangleCount = 0;
};

class Flattener {
  public:
    explicit Flattener(const Model& model) : model_(model), warnings_(model.warnings) {}

    FlattenedGltf flatten();

  private:
    void findDrawables();
    void findDrawable(std::size_t mesh, std::size_t primitive);
    void checkLimits(const std::vector<PlacedNode>& nodes) const;
    void addCamera(const PlacedNode& placed);
    void addMeshes(const PlacedNode& placed);
    std::size_t materialOf(const Primitive& primitive);

    const Model& model_;
    Warnings warnings_;
    std::vector<std::vector<Drawable>> drawables_;  ///< for each mesh of the file
    std::optional<std::size_t> defaultMaterial_;
    FlattenedGltf result_;
};

FlattenedGltf Flattener::flatten() {
    // Count before anything is allocated.
    findDrawables();
    const std::vector<PlacedNode> nodes = placeNodes(model_.nodeTree, model_.limits.maxNodeDepth);
    checkLimits(nodes);

    Scene& scene = result_.scene;
    for (const MaterialRecord& record : model_.materials.records)
        scene.materials.push_back(record.material);
    for (const PlacedNode& placed : nodes) {
        addCamera(placed);
        addMeshes(placed);
    }
    if (scene.meshes.empty())
        throw Error(ErrorCode::malformed, "holds no triangles", {},
                    "its scene must have a node with a mesh of triangles");

    ResourceLoader loader = model_.loader;
    scene.images = loadImages(model_.root(), model_.materials.images, model_.buffers.views, loader);
    scene.warnings = warnings_.sentences();
    return std::move(result_);
}

void Flattener::findDrawables() {
    drawables_.resize(model_.meshes.size());
    for (std::size_t m = 0; m < model_.meshes.size(); ++m)
        for (std::size_t p = 0; p < model_.meshes[m].primitives.size(); ++p)
            findDrawable(m, p);
}

void Flattener::findDrawable(std::size_t mesh, std::size_t index) {
    const Primitive& primitive = model_.meshes[mesh].primitives[index];
    const Drawable drawable{index, countVertices(primitive, model_.accessors),
                            countTriangles(primitive, model_.accessors)};
    if (drawable.vertexCount == 0 || drawable.triangleCount == 0) {
        warnings_.add(primitive.place + " has no triangles and was left out");
        return;
    }
    if (primitive.topology == Topology::triangles &&
        countCorners(primitive, model_.accessors) % 3 != 0)
        warnings_.add(primitive.place + " ends within a triangle, which was left out");
    if (primitive.hasTargets)
        warnings_.add(primitive.place + " has morph targets, which were left out");
    drawables_[mesh].push_back(drawable);
}

[[noreturn]] void throwLimit(const Node& node, const std::string& limit) {
    throw Error(ErrorCode::limitExceeded,
                node.place + " brings the scene beyond the limit of " + limit, {},
                "allow more with --max-vertices");
}

void Flattener::checkLimits(const std::vector<PlacedNode>& nodes) const {
    const GltfLimits& limits = model_.limits;
    std::size_t meshesLeft = limits.maxMeshCount;
    std::size_t verticesLeft =
        std::min<std::size_t>(limits.maxVertexCount, std::numeric_limits<std::uint32_t>::max());
    std::size_t trianglesLeft = limits.maxIndexCount / 3;
    for (const PlacedNode& placed : nodes) {
        const Node& node = model_.nodeTree.nodes[placed.node];
        if (!node.mesh) continue;
        for (const Drawable& drawable : drawables_[*node.mesh]) {
            if (meshesLeft == 0) throwLimit(node, std::to_string(limits.maxMeshCount) + " meshes");
            if (drawable.vertexCount > verticesLeft || drawable.triangleCount > trianglesLeft)
                throwLimit(node, std::to_string(limits.maxVertexCount) + " vertices and " +
                                     std::to_string(limits.maxIndexCount / 3) + " triangles");
            --meshesLeft;
            verticesLeft -= drawable.vertexCount;
            trianglesLeft -= drawable.triangleCount;
        }
    }
}

void Flattener::addCamera(const PlacedNode& placed) {
    const Node& node = model_.nodeTree.nodes[placed.node];
    if (!node.camera) return;
    std::optional<Camera> camera = placeCamera(model_.cameras[*node.camera], placed.worldFromNode);
    if (!camera) {
        warnings_.add(node.place + " has a camera that is no pinhole, which was left out");
        return;
    }
    if (camera->name.empty()) camera->name = node.name;
    result_.scene.cameras.push_back(*std::move(camera));
}

double largestEntry(const Mat3d& matrix) {
    double largest = 0.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            largest = std::max(largest, std::abs(matrix[row][column]));
    return largest;
}

/// The volume of the unit cube's image, for a matrix whose columns have been given length 1.
double relativeVolume(const Mat3d& linear) {
    const auto column = [&](int j) {
        return Vec3d(linear[0][j], linear[1][j], linear[2][j]).normalized();
    };
    return column(0).dot(column(1).cross(column(2)));
}

void Flattener::addMeshes(const PlacedNode& placed) {
    const Node& node = model_.nodeTree.nodes[placed.node];
    if (!node.mesh || drawables_[*node.mesh].empty()) return;
    if (node.isSkinned) warnings_.add(node.place + " has a skin, which was left out");

    // A flat instance has no inside and no area that a bake could light.
    const Mat3d& linear = placed.worldFromNode.linear;
    const double volume = relativeVolume(linear);
    if (!(std::abs(volume) > kFlatVolume)) {
        warnings_.add(node.place + " has a transform without an inverse and was left out");
        return;
    }
    // Normals turn with the inverse transpose: the cofactors, negated where the map mirrors.
    const double sign = volume < 0.0 ? -1.0 : 1.0;
    const Mat3d worldFromNormal = normalMatrix(linear * (1.0 / largestEntry(linear))) * sign;
    const Instance instance{placed.worldFromNode, worldFromNormal, volume < 0.0};
    const MeshRecord& record = model_.meshes[*node.mesh];
    for (const Drawable& drawable : drawables_[*node.mesh]) {
        const Primitive& primitive = record.primitives[drawable.primitive];
        Mesh mesh = buildMesh(model_, primitive, instance, warnings_);
        mesh.name = record.name.empty() ? node.name : record.name;
        mesh.material = materialOf(primitive);
        result_.scene.meshes.push_back(std::move(mesh));
        result_.primitiveOfMesh.push_back({*node.mesh, drawable.primitive});
    }
}

std::size_t Flattener::materialOf(const Primitive& primitive) {
    if (primitive.material) return *primitive.material;
    std::vector<Material>& materials = result_.scene.materials;
    if (!defaultMaterial_) {
        defaultMaterial_ = materials.size();
        materials.push_back(defaultMaterial());
    }
    return *defaultMaterial_;
}

}  // namespace

FlattenedGltf flattenModel(const Model& model) {
    return Flattener(model).flatten();
}

}  // namespace prt::gltf

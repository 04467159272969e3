#include "prt/gltf/node_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "prt/base/error.h"

namespace prt::gltf {
namespace {

/// How far a rotation's length may be from 1: what 8-bit components make of it.
constexpr double kRotationTolerance = 1e-2;

/// A column-major 4×4 matrix whose last row says that it is affine.
Affine3d parseMatrix(const JsonCursor& value) {
    const std::array<double, 16> m = value.toNumbers<16>();
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        value.reject("has a last row that is not 0, 0, 0, 1");
    Affine3d map;
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row)
            map.linear[static_cast<int>(row)][static_cast<int>(column)] = m[4 * column + row];
    map.translation = Vec3d(m[12], m[13], m[14]);
    return map;
}

/// The rotation of a unit quaternion (x, y, z, w).
Mat3d parseRotation(const JsonCursor& value) {
    const auto [x, y, z, w] = value.toNumbers<4>();
    const Imath::Quatd quaternion(w, x, y, z);
    if (!(std::abs(quaternion.length() - 1.0) <= kRotationTolerance))
        value.reject("is not a unit quaternion");
    return rotationFromQuaternion(quaternion.normalized());
}

Affine3d parseTransform(const JsonCursor& node) {
    const std::optional<JsonCursor> matrix = node.find("matrix");
    const std::optional<JsonCursor> rotation = node.find("rotation");
    if (matrix && (rotation || node.find("translation") || node.find("scale")))
        node.reject("has both a matrix and its parts");
    if (matrix) return parseMatrix(*matrix);

    const auto t = node.numbersOr<3>("translation", {0.0, 0.0, 0.0});
    const auto s = node.numbersOr<3>("scale", {1.0, 1.0, 1.0});
    Affine3d map;
    if (rotation) map.linear = parseRotation(*rotation);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            map.linear[row][column] *= s[static_cast<std::size_t>(column)];
    map.translation = Vec3d(t[0], t[1], t[2]);
    return map;
}

/// A list of node indices, such as children.
std::vector<std::size_t> parseNodeList(const JsonCursor& object, const char* key,
                                       std::size_t nodeCount) {
    return parseEach(object, key,
                     [&](const JsonCursor& value) { return value.toIndex(nodeCount, "nodes"); });
}

Node parseNode(const JsonCursor& value, std::size_t nodeCount, std::size_t meshCount,
               std::size_t cameraCount) {
    Node node;
    node.place = value.place();
    node.name = value.stringOr("name", "");
    node.parentFromNode = parseTransform(value);
    node.children = parseNodeList(value, "children", nodeCount);
    node.mesh = value.findIndex("mesh", meshCount, "meshes");
    node.camera = value.findIndex("camera", cameraCount, "cameras");
    node.isSkinned = value.find("skin").has_value();
    return node;
}

/// The nodes without a parent, ascending, once no node is known to have two.
std::vector<std::size_t> findRoots(const std::vector<Node>& nodes) {
    std::vector<bool> hasParent(nodes.size(), false);
    for (const Node& node : nodes) {
        for (const std::size_t child : node.children) {
            if (hasParent[child])
                throw Error(ErrorCode::malformed, nodes[child].place + " has two parents");
            hasParent[child] = true;
        }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!hasParent[i]) roots.push_back(i);
    return roots;
}

/// With one parent each, nodes that no root reaches stand in a circle.
void checkAcyclic(const std::vector<Node>& nodes, const std::vector<std::size_t>& roots) {
    std::vector<std::size_t> pending = roots;
    std::size_t reachedCount = 0;
    while (!pending.empty()) {
        const Node& node = nodes[pending.back()];
        pending.pop_back();
        pending.insert(pending.end(), node.children.begin(), node.children.end());
        ++reachedCount;
    }
    if (reachedCount != nodes.size())
        throw Error(ErrorCode::malformed, "has nodes that are their own ancestors");
}

/// The nodes of a scene: roots of the forest, each once.
std::vector<std::size_t> parseScene(const JsonCursor& scene, std::size_t nodeCount,
                                    const std::vector<std::size_t>& roots) {
    const std::vector<std::size_t> members = parseNodeList(scene, "nodes", nodeCount);
    for (const std::size_t node : members)
        if (!std::binary_search(roots.begin(), roots.end(), node))
            scene.reject("lists node " + std::to_string(node) + ", which has a parent");
    std::vector<std::size_t> sorted = members;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        scene.reject("lists a node twice");
    return members;
}

}  // namespace

NodeTree parseNodes(const JsonCursor& root) {
    const std::size_t nodeCount = countElements(root, "nodes");
    const std::size_t meshCount = countElements(root, "meshes");
    const std::size_t cameraCount = countElements(root, "cameras");
    NodeTree tree;
    tree.nodes = parseEach(root, "nodes", [&](const JsonCursor& value) {
        return parseNode(value, nodeCount, meshCount, cameraCount);
    });
    tree.roots = findRoots(tree.nodes);
    checkAcyclic(tree.nodes, tree.roots);

    const std::vector<std::vector<std::size_t>> scenes = parseEach(
        root, "scenes",
        [&](const JsonCursor& scene) { return parseScene(scene, nodeCount, tree.roots); });
    if (const auto scene = root.findIndex("scene", scenes.size(), "scenes"))
        tree.roots = scenes[*scene];
    return tree;
}

std::vector<PlacedNode> placeNodes(const NodeTree& tree, int maxDepth) {
    struct Pending {
        PlacedNode placed;
        int depth;
    };
    std::vector<Pending> pending;
    const auto push = [&](const std::vector<std::size_t>& siblings, const Affine3d& worldFromParent,
                          int depth) {
        for (auto node = siblings.rbegin(); node != siblings.rend(); ++node)
            pending.push_back({{*node, worldFromParent * tree.nodes[*node].parentFromNode}, depth});
    };

    std::vector<PlacedNode> placed;
    push(tree.roots, Affine3d(), 1);
    while (!pending.empty()) {
        const Pending current = pending.back();
        pending.pop_back();
        const Node& node = tree.nodes[current.placed.node];
        if (current.depth > maxDepth)
            throw Error(ErrorCode::limitExceeded,
                        node.place + " is nested deeper than " + std::to_string(maxDepth));
        placed.push_back(current.placed);
        push(node.children, current.placed.worldFromNode, current.depth + 1);
    }
    return placed;
}

}  // namespace prt::gltf

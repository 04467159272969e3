#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "prt/gltf/json_cursor.h"
#include "prt/math/transform.h"

namespace prt::gltf {

struct Node {
    std::string place;
    std::string name;
    Affine3d parentFromNode;
    std::vector<std::size_t> children;
    std::optional<std::size_t> mesh;
    std::optional<std::size_t> camera;
    bool isSkinned = false;
};

/// The file's nodes, known to be a forest, and where the scene to be read begins in it.
struct NodeTree {
    std::vector<Node> nodes;
    std::vector<std::size_t> roots;  ///< of the default scene, or all there are where none is named
};

NodeTree parseNodes(const JsonCursor& root);

struct PlacedNode {
    std::size_t node = 0;
    Affine3d worldFromNode;
};

/// The nodes of the scene in the order of a depth-first walk.
///
/// @throws Error  limitExceeded for a node deeper than `maxDepth`
std::vector<PlacedNode> placeNodes(const NodeTree& tree, int maxDepth);

}  // namespace prt::gltf

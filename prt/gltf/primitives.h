#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "prt/gltf/accessor.h"
#include "prt/gltf/json_cursor.h"

namespace prt::gltf {

/// What a primitive's vertices are joined to [glTF 2.0, 3.7.2.1].
enum class Topology { points, lines, lineLoop, lineStrip, triangles, triangleStrip, triangleFan };

struct Primitive {
    std::string place;
    Topology topology = Topology::triangles;
    std::map<std::string, std::size_t, std::less<>> attributes;  ///< accessors
    std::optional<std::size_t> indices;                          ///< accessor
    std::optional<std::size_t> material;
    bool hasTargets = false;

    /// The accessor of an attribute, if there is one.
    std::optional<std::size_t> findAttribute(std::string_view semantic) const;
};

struct MeshRecord {
    std::string name;
    std::vector<Primitive> primitives;
};

/// Reads the file's meshes; the accessors of each primitive are known to have
/// formats that their semantics allow.
///
/// @param isQuantized  whether the file uses KHR_mesh_quantization
std::vector<MeshRecord> parseMeshes(const JsonCursor& root, const std::vector<Accessor>& accessors,
                                    bool isQuantized);

/// How many vertices a primitive has, used or not; 0 without positions.
std::size_t countVertices(const Primitive& primitive, const std::vector<Accessor>& accessors);

/// How many vertices are drawn, those that are drawn again included.
std::size_t countCorners(const Primitive& primitive, const std::vector<Accessor>& accessors);

/// How many triangles a primitive makes, those without area included.
std::size_t countTriangles(const Primitive& primitive, const std::vector<Accessor>& accessors);

/// Three vertices a triangle, in the order of the specification.
///
/// @throws Error  malformed for an index that is no vertex
std::vector<std::uint32_t> readTriangles(const Primitive& primitive,
                                         const std::vector<Accessor>& accessors);

}  // namespace prt::gltf

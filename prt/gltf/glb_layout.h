#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "prt/gltf/glb_writer.h"

namespace prt::gltf {

enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };

/// A buffer view of the file to be: where its bytes stand if none is encoded, and what makes them.
struct ViewLayout {
    std::string name;  ///< for complaints: "POSITION of mesh 3"
    std::size_t byteOffset = 0;
    std::size_t byteLength = 0;
    ViewTarget target = ViewTarget::none;
    bool holdsFloats = false;
    std::function<void(std::span<std::byte>)> write;  ///< into memory that is zero
};

/// An accessor; accessor i is the whole of buffer view i, apart from padding at its end.
struct AccessorLayout {
    AccessorInfo info;
    std::optional<std::pair<Vec3f, Vec3f>> bounds;  ///< of positions
};

struct PrimitiveLayout {
    std::size_t mesh = 0;                                         ///< of the scene
    std::vector<std::pair<std::string, std::size_t>> attributes;  ///< semantic and accessor
    std::size_t indices = 0;                                      ///< accessor
};

/// What the binary chunk will hold: an accessor and a view for each of an extension's own
/// accessors, then for each attribute and index list, then a view for each image. Every byte of the
/// buffer lies in exactly one view.
struct GlbLayout {
    std::vector<ViewLayout> views;
    std::vector<AccessorLayout> accessors;
    std::vector<PrimitiveLayout> primitives;  ///< of the meshes that have triangles
    std::size_t byteLength = 0;

    std::size_t viewOfImage(std::size_t image) const { return accessors.size() + image; }
};

/// @param scene, extension  outlive the result
GlbLayout layOutBinary(const Scene& scene, const GlbExtension* extension);

/// Makes the bytes of a view.
///
/// @param bytes   view.byteLength zeros, written
/// @throws Error  malformed if a float is not finite
void writeView(const ViewLayout& view, std::span<std::byte> bytes);

}  // namespace prt::gltf

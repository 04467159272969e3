#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "prt/gltf/glb_layout.h"
#include "prt/gltf/meshopt.h"

namespace prt::gltf {

/// A view as it stands in the binary chunk.
struct StoredView {
    std::size_t byteOffset = 0;
    std::size_t byteLength = 0;
    std::optional<MeshoptView> encoding{};  ///< nothing where these bytes are the view's own
    std::string checksum{};                 ///< of these bytes
    std::string valuesChecksum{};           ///< of the view's own
};

/// What the binary chunk holds: views that are read where they stand, which are aligned, then
/// encoded ones, then images.
struct GlbStorage {
    std::vector<StoredView> views;   ///< numbered as the layout's
    std::vector<std::size_t> order;  ///< in which they follow one another
    std::size_t byteLength = 0;

    bool hasEncodedViews() const;
};

/// The storage of all views as they are, before they are made: its checksums are of the right
/// length alone.
GlbStorage planStorage(const GlbLayout& layout);

/// Makes each view once, for its checksums, and for its length where it is encoded: that is where
/// the file has fewer bytes so.
///
/// @throws Error  as writeView
void measureViews(const GlbLayout& layout, bool encode, GlbStorage& storage);

/// Makes the bytes of a view as it is stored.
///
/// @throws Error  as writeView
std::vector<std::byte> makeStoredView(const GlbLayout& layout, const GlbStorage& storage,
                                      std::size_t index);

}  // namespace prt::gltf

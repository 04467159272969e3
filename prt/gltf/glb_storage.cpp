#include "prt/gltf/glb_storage.h"

#include <algorithm>
#include <array>
#include <utility>

#include "prt/base/checksum.h"
#include "prt/gltf/accessor.h"
#include "prt/gltf/glb_writer.h"

namespace prt::gltf {
namespace {

// What the JSON takes more for an encoded view, about.
constexpr std::size_t kDescriptionBytes = 150;

std::vector<std::byte> makeView(const ViewLayout& view) {
    std::vector<std::byte> bytes(view.byteLength);
    writeView(view, bytes);
    return bytes;
}

/// The encoding that a view can have: of vertex attributes and of indices, the accessors of which
/// are the views of the same numbers.
std::optional<MeshoptView> findEncoding(const GlbLayout& layout, std::size_t index) {
    const ViewTarget target = layout.views[index].target;
    if (target == ViewTarget::none) return std::nullopt;
    const AccessorInfo& info = layout.accessors[index].info;
    MeshoptView encoding;
    if (target == ViewTarget::indices) encoding.mode = MeshoptMode::triangles;
    encoding.count = info.count;
    encoding.byteStride = static_cast<std::size_t>(info.componentCount) * componentBytes(info.type);
    return encoding;
}

/// The encoded bytes of a view's own, without their padding.
std::vector<std::byte> encodeView(const MeshoptView& encoding, std::span<const std::byte> bytes) {
    return encodeMeshopt(encoding, bytes.first(encoding.decodedBytes()));
}

/// Lines the views up.
void arrangeViews(const GlbLayout& layout, GlbStorage& storage) {
    const auto group = [&](std::size_t index) {
        if (index >= layout.accessors.size()) return 2;
        return storage.views[index].encoding ? 1 : 0;
    };
    std::stable_sort(storage.order.begin(), storage.order.end(),
                     [&](std::size_t a, std::size_t b) { return group(a) < group(b); });
    storage.byteLength = 0;
    for (const std::size_t index : storage.order) {
        storage.views[index].byteOffset = storage.byteLength;
        storage.byteLength += storage.views[index].byteLength;
    }
}

}  // namespace

bool GlbStorage::hasEncodedViews() const {
    return std::any_of(views.begin(), views.end(),
                       [](const StoredView& view) { return view.encoding.has_value(); });
}

GlbStorage planStorage(const GlbLayout& layout) {
    GlbStorage storage;
    for (std::size_t index = 0; index < layout.views.size(); ++index) {
        storage.order.push_back(index);
        storage.views.push_back({.byteLength = layout.views[index].byteLength,
                                 .checksum = formatChecksum(0),
                                 .valuesChecksum = formatChecksum(0)});
    }
    arrangeViews(layout, storage);
    return storage;
}

void measureViews(const GlbLayout& layout, bool encode, GlbStorage& storage) {
    for (std::size_t index = 0; index < layout.views.size(); ++index) {
        StoredView& view = storage.views[index];
        const std::vector<std::byte> bytes = makeView(layout.views[index]);
        view.checksum = view.valuesChecksum = formatChecksum(computeCrc32(bytes));
        const std::optional<MeshoptView> encoding =
            encode ? findEncoding(layout, index) : std::nullopt;
        if (!encoding) continue;
        const std::vector<std::byte> encoded = encodeView(*encoding, bytes);
        if (encoded.size() + kDescriptionBytes >= bytes.size()) continue;
        view.encoding = encoding;
        view.byteLength = encoded.size();
        view.checksum = formatChecksum(computeCrc32(encoded));
    }
    arrangeViews(layout, storage);
}

std::vector<std::byte> makeStoredView(const GlbLayout& layout, const GlbStorage& storage,
                                      std::size_t index) {
    std::vector<std::byte> bytes = makeView(layout.views[index]);
    const std::optional<MeshoptView>& encoding = storage.views[index].encoding;
    return encoding ? encodeView(*encoding, bytes) : bytes;
}

}  // namespace prt::gltf

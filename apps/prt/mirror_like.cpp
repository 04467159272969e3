#include "apps/prt/mirror_like.h"

#include <algorithm>

#include "prt/brdf/band_limit.h"
#include "prt/io/image_io.h"
#include "prt/relight/receiver_surface.h"

namespace prt::cli {
namespace {

bool hasTexturedRoughness(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const Material& material) {
        return material.metallicRoughnessTexture.has_value();
    });
}

std::string nameOf(const Scene& scene, std::size_t material) {
    const std::string& name = scene.materials[material].name;
    return name.empty() ? "material " + std::to_string(material) : name;
}

}  // namespace

std::optional<MirrorLike> findMirrorLike(Asset& asset) {
    const CompressedLayer* layer = asset.transfer.findLayer(Transport::glossy);
    const CompressedLayer* visibility = asset.transfer.findLayer(Transport::glossyShadowed);
    if (!layer) layer = visibility;
    if (!layer) return std::nullopt;

    MirrorLike found{.leastRoughness = leastRoughnessHeld(layer->incidentBandCount),
                     .isSplitOff = visibility != nullptr};
    if (hasTexturedRoughness(asset.scene)) decodeTextures(asset.scene);
    std::vector<bool> isSmooth(asset.scene.materials.size(), false);
    for (const ReceiverSurface& receiver : describeReceivers(asset.scene, asset.transfer))
        if (static_cast<double>(receiver.surface.roughness) < found.leastRoughness)
            isSmooth[receiver.material] = true;
    for (std::size_t material = 0; material < isSmooth.size(); ++material)
        if (isSmooth[material]) found.materials.push_back(nameOf(asset.scene, material));
    return found;
}

}  // namespace prt::cli

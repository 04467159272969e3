#include "apps/viewer/view_lobes.h"

#include <algorithm>

namespace prt::viewer {
namespace {

/// Of the object's size.
constexpr double kTransferRadius = 0.12;

/// Of the picture's height.
constexpr double kLightSide = 0.25;
constexpr double kLightMargin = 0.02;

/// A vertex by its number through the scene, which has it.
Vec3f positionOf(const Scene& scene, std::size_t vertex) {
    auto mesh = scene.meshes.begin();
    for (; vertex >= mesh->vertexCount(); ++mesh)
        vertex -= mesh->vertexCount();
    return mesh->positions[vertex];
}

}  // namespace

bool ViewLobes::Made::operator==(const Made& other) const {
    return !asset.owner_before(other.asset) && !other.asset.owner_before(asset) &&
           vertex == other.vertex && shown == other.shown && eye == other.eye;
}

void ViewLobes::drawLight(const Lighting& lighting, const Camera& camera, int height) {
    if (lighting.coefficients != lightCoefficients_) {
        light_.setFunction(lighting);
        lightCoefficients_ = lighting.coefficients;
    }
    const int margin = static_cast<int>(kLightMargin * height);
    light_.drawInCorner(camera, {},
                        {margin, margin, std::max(static_cast<int>(kLightSide * height), 1)});
}

void ViewLobes::drawTransfer(std::size_t paneIndex, const Pane& pane, const PickedVertex& picked,
                             std::span<const StandingObject> objects, const GpuTarget& scene,
                             std::span<const GpuObject> drawn, const Camera& camera,
                             const PixelColumns& columns) {
    const auto standing = std::ranges::find(objects, picked.object, &StandingObject::index);
    if (standing == objects.end()) return;
    ShownObject& object = *standing->object;
    const Asset& asset = object.asset();
    if (picked.vertex >= asset.scene.vertexCount()) return;

    const Affine3d& worldFromObject = standing->worldFromObject;
    const Vec3f eye(worldFromObject.linear.transposed() *
                    (Vec3d(camera.eye) - worldFromObject.translation));
    const cli::ShownTransport shown = chooseTransport(pane, asset.transfer);
    const Made made{object.sharedAsset(), picked.vertex, shown,
                    cli::isGlossy(shown) ? eye : Vec3f(0.0f)};
    if (made_[paneIndex] != made) {
        const std::optional<Lighting> transfer =
            object.expandVertex(paneIndex, shown, picked.vertex, eye);
        if (!transfer) return;
        transfers_[paneIndex].setFunction(*transfer, {.positive = kWarmLobe});
        made_[paneIndex] = made;
    }
    const Vec3d position(positionOf(asset.scene, picked.vertex));
    const double size = static_cast<double>(object.scene().bounds().radius());
    transfers_[paneIndex].drawInScene(scene, drawn, camera,
                                      {.center = transformPoint(worldFromObject, position),
                                       .largestRadius = std::max(size * kTransferRadius, 1e-9),
                                       .worldFromLobe = worldFromObject.linear},
                                      columns);
}

}  // namespace prt::viewer

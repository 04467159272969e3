#include "apps/viewer/picker.h"

#include <algorithm>
#include <limits>

#include "prt/render/pick.h"

namespace prt::viewer {

const RayScene& Picker::raysOf(const std::shared_ptr<const Asset>& asset) {
    const auto found = std::ranges::find(ready_, asset, &ReadyObject::asset);
    if (found != ready_.end()) return *found->rays;
    ready_.push_back({asset, std::make_unique<RayScene>(asset->scene)});
    return *ready_.back().rays;
}

std::optional<PickedVertex> Picker::pick(const Stage& stage, const ViewState& view,
                                         const PicturePoint& place, double aspectRatio) {
    constexpr int kHeight = 1 << 14;  // of a picture as fine as any screen
    const int width = std::max(1, static_cast<int>(kHeight * aspectRatio));
    const PicturePlace pixel{
        .width = width, .height = kHeight, .x = place.x * width, .y = place.y * kHeight};
    const Camera camera = makeCamera(stage.cameraPose(view, aspectRatio));
    std::optional<PickedVertex> nearest;
    float distance = std::numeric_limits<float>::infinity();
    std::vector<std::shared_ptr<const Asset>> shown;
    for (std::size_t i = 0; i < view.objects.size(); ++i) {
        const std::optional<Affine3d> worldFromObject = stage.worldFromObject(view, i);
        if (!worldFromObject) continue;
        shown.push_back(stage.objects().asset(i));
        const auto seen =
            pickVertex(shown.back()->scene, raysOf(shown.back()), camera, pixel, *worldFromObject);
        if (!seen || seen->distance >= distance) continue;
        distance = seen->distance;
        nearest = PickedVertex{.object = i, .vertex = seen->vertex};
    }
    std::erase_if(ready_, [&](const ReadyObject& object) {
        return std::ranges::find(shown, object.asset) == shown.end();
    });
    return nearest;
}

}  // namespace prt::viewer

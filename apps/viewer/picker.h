#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/viewer/stage.h"
#include "apps/viewer/view_state.h"
#include "prt/trace/ray_scene.h"

namespace prt::viewer {

/// A place in the picture, 0 … 1 from the left and from the top.
struct PicturePoint {
    double x = 0.0;
    double y = 0.0;
};

/// Finds what a person points at. An object is made ready for rays when it is asked for first, and
/// kept as long as the view shows it.
class Picker {
  public:
    /// @param aspectRatio  width over height of the picture
    /// @return             none where there is nothing but background
    std::optional<PickedVertex> pick(const Stage& stage, const ViewState& view,
                                     const PicturePoint& place, double aspectRatio);

  private:
    struct ReadyObject {
        std::shared_ptr<const Asset> asset;
        std::unique_ptr<RayScene> rays;
    };
    const RayScene& raysOf(const std::shared_ptr<const Asset>& asset);

    std::vector<ReadyObject> ready_;
};

}  // namespace prt::viewer

#pragma once

#include <memory>
#include <optional>

#include "apps/viewer/light_rig.h"
#include "apps/viewer/object_shelf.h"
#include "apps/viewer/view_state.h"
#include "prt/gpu/gpu_target.h"

namespace prt::viewer {

struct StageOptions {
    ImageLimits limits{};
    int threadCount = 0;  ///< 0: one a core
    /// Whether transfer is relit by OpenGL, or on the CPU; none: by OpenGL unless that runs on the
    /// CPU too.
    std::optional<bool> relightsOnCard{};
};

/// Draws views, in a window or without one. All of it on the thread of one OpenGL context.
class Stage {
  public:
    explicit Stage(const StageOptions& options);
    ~Stage();

    /// Takes over what has been read in the background, begins to read what the view names for the
    /// first time, and forgets what it names no longer. Returns at once.
    void update(const ViewState& view);
    /// The same, and waits until all is read.
    void finishLoading(const ViewState& view);

    const ObjectShelf& objects() const;
    const LightRig& lights() const;

    /// The view's own camera, or one that frames all objects.
    CameraPose cameraPose(const ViewState& view, double aspectRatio) const;

    /// What turns radiance into the picture that a person sees.
    DisplayOptions displayOptions(const ViewState& view) const;

    /// Linear radiance of the view as it was last updated, without lobes.
    const GpuTarget& draw(const ViewState& view, int width, int height);

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

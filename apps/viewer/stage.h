#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/light_rig.h"
#include "apps/viewer/object_shelf.h"
#include "apps/viewer/reference_tracer.h"
#include "apps/viewer/view_state.h"
#include "prt/gpu/gpu_target.h"
#include "prt/scene/scene.h"

namespace prt::viewer {

struct StageOptions {
    ImageLimits limits{};
    int threadCount = 0;  ///< 0: one a core
    /// Whether what has been baked is relit by OpenGL, or on the CPU; none: by OpenGL unless that
    /// runs on the CPU too.
    std::optional<bool> relightsOnCard{};
    /// draw() waits for prefiltered light, and for so many paths a pixel of a reference; none: it
    /// shows what there is.
    std::optional<int> awaitedPathsPerPixel{};
};

/// Samples of a pixel: of a picture at rest, and while something moves, for which a rasteriser on
/// the CPU has no time for more than one. In the context that is current.
inline constexpr int kRestingSampleCount = 4;
int movingSampleCount();

/// How far the work in the background has come that pictures are made of.
struct StageRevision {
    std::size_t lights = 0;
    std::size_t objects = 0;
    std::size_t mirrors = 0;
    std::shared_ptr<const Image> reference{};

    bool operator==(const StageRevision&) const = default;
};

/// Draws views, in a window or without one: all of it on the thread of one OpenGL context.
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
    /// Whether what has been baked is relit by OpenGL.
    bool relightsOnCard() const;

    /// @throws Error  malformed if no object of the view can be seen, or by none of its lights, for
    ///                the first of the reasons
    void requireSomethingToShow() const;
    /// Of all objects.
    std::size_t vertexCount() const;
    std::size_t triangleCount() const;
    /// What of the view cannot be shown, and why; one sentence each.
    std::vector<std::string> describeFaults() const;

    /// Where an object stands; none while it is not shown.
    std::optional<Affine3d> worldFromObject(const ViewState& view, std::size_t object) const;

    /// The view's own camera; or else the first that an asset shown alone has; or one that frames
    /// all objects.
    CameraPose cameraPose(const ViewState& view, double aspectRatio) const;

    /// The light of a pane, world axes: of the bands that are used, windowed, turned.
    ///
    /// @param mostBands  that the receiver has
    Lighting lightingOf(const ViewState& view, const Pane& pane, int mostBands) const;

    /// Draws the linear radiance of the view, of what has been read so far.
    ///
    /// @param sampleCount  a pixel
    /// @return             until the next call
    const GpuTarget& draw(const ViewState& view, int width, int height, int sampleCount);

    /// Shows what was drawn last over the viewport of the framebuffer that is bound, and lobes over
    /// it.
    void present(const ViewState& view);

    /// Another one whenever draw() may show the same view otherwise. Asked for after update().
    StageRevision revision() const;
    /// Whether work in the background will change it.
    bool isBusy() const;
    /// How far the reference of the view that was drawn last has come.
    const ReferencePicture& reference() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

#pragma once

#include <array>
#include <memory>
#include <optional>

#include "apps/viewer/staged_objects.h"
#include "prt/gpu/gpu_lobe.h"

namespace prt::viewer {

/// The lobes that are laid over a view: the light in a corner, and the transfer of the picked
/// vertex where that is.
class ViewLobes {
  public:
    /// @param lighting  world axes
    /// @param height    of the picture, pixels
    void drawLight(const Lighting& lighting, const Camera& camera, int height);

    /// Over columns of a picture that shows `objects`; nothing where the picked vertex is of none
    /// of them, or the pane's transport not of a layer.
    ///
    /// @param scene, drawn  what drawGpuView has made, and of what
    void drawTransfer(std::size_t paneIndex, const Pane& pane, const PickedVertex& picked,
                      std::span<const StandingObject> objects, const GpuTarget& scene,
                      std::span<const GpuObject> drawn, const Camera& camera,
                      const PixelColumns& columns);

  private:
    /// What a lobe was made of.
    struct Made {
        std::weak_ptr<const Asset> asset{};  ///< another may come to stand at its address
        std::size_t vertex = 0;
        cli::ShownTransport shown{};
        Vec3f eye{0.0f, 0.0f, 0.0f};

        bool operator==(const Made& other) const;
    };

    std::vector<Vec3d> lightCoefficients_;
    GpuLobe light_;
    std::array<std::optional<Made>, ShownObject::kPaneCount> made_;
    std::array<GpuLobe, ShownObject::kPaneCount> transfers_;
};

}  // namespace prt::viewer

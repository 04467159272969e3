#pragma once

#include <future>
#include <memory>
#include <optional>

#include "prt/gpu/gpu_mirrors.h"
#include "prt/light/environment.h"
#include "prt/render/mirror_shading.h"

namespace prt::viewer {

/// What mirror-like surfaces show of the light, prefiltered in the background.
class MirrorLight {
  public:
    /// Begins to prefilter another environment, once the one under way is done; takes over what is
    /// ready.
    void update(const std::shared_ptr<const Environment>& environment);
    /// The same, and waits until it is ready.
    void finish(const std::shared_ptr<const Environment>& environment);

    bool isBusy() const { return making_.valid(); }
    /// Another one whenever the mirrors are.
    std::size_t revision() const { return revision_; }
    /// Of the last environment that is ready; null before the first.
    GpuMirrors* mirrors() { return mirrors_ ? &*mirrors_ : nullptr; }

  private:
    void begin(const std::shared_ptr<const Environment>& environment);
    void takeOver();

    std::shared_ptr<const Environment> made_;  ///< or in the making
    std::future<MirrorEnvironment> making_;
    std::optional<GpuMirrors> mirrors_;
    std::size_t revision_ = 0;
};

}  // namespace prt::viewer

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/viewer/loading.h"
#include "apps/viewer/view_state.h"
#include "prt/io/image_io.h"
#include "prt/light/environment.h"
#include "prt/light/lighting.h"

namespace prt::viewer {

/// The lights of a view, read in the background and added up.
class LightRig {
  public:
    explicit LightRig(const ImageLimits& limits);
    ~LightRig();

    /// Takes over what has been read since, begins to read what is new, forgets what is gone.
    /// Returns at once.
    void update(std::span<const LightChoice> lights);
    /// The same, and waits until all is read.
    void finish(std::span<const LightChoice> lights);

    /// Of each light of the last update, in that order.
    std::span<const LoadingStatus> statuses() const;

    /// Another one whenever the sum is.
    std::size_t revision() const;

    /// Of lights that are on and have been read, of kMaxBandCount bands, world axes. While one is
    /// being read, it stays as it was rather than be the sum of fewer.
    const Lighting& sum() const;
    /// The same light itself, as a lat-long image: for backgrounds, mirrors and path tracing. A
    /// single image is as large as it came; the sum of several has the size of the largest, up to
    /// 2048×1024. Drawn when first asked for; stays until the next update.
    const Environment& environment() const;
    /// The same, for those who keep it longer; the same object as long as the sum is.
    std::shared_ptr<const Environment> sharedEnvironment() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

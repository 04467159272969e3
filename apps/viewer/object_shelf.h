#pragma once

#include <memory>
#include <span>

#include "apps/viewer/loading.h"
#include "apps/viewer/view_state.h"
#include "prt/asset/asset.h"
#include "prt/io/image_io.h"

namespace prt::viewer {

/// The assets of a view, read in the background; one that is named twice is read once.
class ObjectShelf {
  public:
    explicit ObjectShelf(const ImageLimits& limits);
    ~ObjectShelf();

    /// Takes over what has been read since, begins to read what is new, forgets what is gone.
    /// Returns at once.
    void update(std::span<const ObjectChoice> objects);
    /// The same, and waits until all is read.
    void finish(std::span<const ObjectChoice> objects);

    /// Of each object of the last update, in that order.
    std::span<const LoadingStatus> statuses() const;
    /// Textures decoded; null until it has been read. Two objects of one file share one.
    std::shared_ptr<const Asset> asset(std::size_t object) const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

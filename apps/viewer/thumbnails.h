#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "apps/viewer/loading.h"
#include "prt/image/image.h"
#include "prt/io/image_io.h"

namespace prt::viewer {

/// An image that may be a light.
struct Thumbnail {
    std::string source;  ///< its file, as a LIGHT argument
    LoadingStatus status{};
    std::shared_ptr<const Rgba8Image>
        picture{};  ///< lat-long, exposed as a light; null until ready
};

struct ThumbnailOptions {
    ImageLimits limits{};
    int height = 48;               ///< pixels; twice as wide
    std::size_t mostCount = 1000;  ///< of a folder, the first by name
};

/// Small pictures of the lights of a folder, made in the background one after the other.
class Thumbnails {
  public:
    explicit Thumbnails(const ThumbnailOptions& options = {});
    ~Thumbnails();

    /// Begins with another folder, or looks for new files in the same. Pictures of files that stay
    /// in the list are kept. An empty path closes it.
    void open(const std::filesystem::path& folder);

    /// Takes over what has been made since. Returns at once.
    void update();
    /// The same, and waits until all are made.
    void finish();

    /// Whether the folder could be listed; a sentence where it could not, or has too many images.
    const LoadingStatus& status() const;
    /// Its .exr .hdr .png .jpg .jpeg files, sorted by name.
    std::span<const Thumbnail> all() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

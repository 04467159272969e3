#include "apps/viewer/thumbnails.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/picture.h"
#include "apps/common/text.h"
#include "apps/viewer/background_loads.h"
#include "apps/viewer/lat_long_size.h"
#include "prt/io/environment_io.h"

namespace prt::viewer {
namespace {

namespace fs = std::filesystem;

using Loads = BackgroundLoads<Rgba8Image>;

/// The images of a folder, sorted by name. @throws Error  unreadable
std::vector<std::string> listImages(const fs::path& folder) {
    std::error_code failure;
    std::vector<std::string> images;
    for (auto entry = fs::directory_iterator(folder, failure);
         !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
        std::error_code unknown;
        if (cli::isImageName(entry->path()) && entry->is_regular_file(unknown))
            images.push_back(entry->path());
    }
    if (failure)
        throw Error(ErrorCode::unreadable, "cannot be listed: " + failure.message(), folder);
    std::sort(images.begin(), images.end());
    return images;
}

/// A small lat-long image of an environment; one that is not lat-long is looked up in a few places
/// a texel.
Image shrink(const Environment& environment, int height) {
    if (environment.map == SphereMap::latLong) return resizeLatLong(environment.radiance, height);
    constexpr int kPlaces = 4;  // along each side
    Image fine(2 * kPlaces * height, kPlaces * height);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            fine.at(x, y) = lookUpRadiance(
                environment,
                Vec3f(sphereTexel(SphereMap::latLong, fine.width, fine.height, x, y).direction));
    return resizeLatLong(fine, height);
}

Loads::Loaded drawThumbnail(const std::string& path, const ThumbnailOptions& options) {
    constexpr int kBandCount = 3;  // all that the exposure is chosen by
    const LoadedEnvironment light = loadEnvironment(path, {}, options.limits);
    const Environment small{SphereMap::latLong, shrink(light.environment, options.height)};
    const float stops = cli::chooseExposure(projectLighting(small, kBandCount));
    return {encodeForDisplay(small.radiance, {.exposureStops = stops}),
            cli::describeMending(light.mended).value_or("")};
}

}  // namespace

struct Thumbnails::Content {
    explicit Content(const ThumbnailOptions& given)
        : options(given),
          loads([given](const std::string& path) { return drawThumbnail(path, given); }) {}

    void collect() {
        for (Thumbnail& thumbnail : thumbnails) {
            if (thumbnail.status.stage != LoadingStatus::Stage::waiting) continue;
            thumbnail.status = loads.at(thumbnail.source).status;
            thumbnail.picture = loads.at(thumbnail.source).value;
        }
    }

    const ThumbnailOptions options;
    Loads loads;
    LoadingStatus status{LoadingStatus::Stage::ready, {}};
    std::vector<std::string> names;
    std::vector<Thumbnail> thumbnails;
};

Thumbnails::Thumbnails(const ThumbnailOptions& options)
    : content_(std::make_unique<Content>(options)) {}

Thumbnails::~Thumbnails() = default;

void Thumbnails::open(const std::filesystem::path& folder) {
    Content& content = *content_;
    content.status = {LoadingStatus::Stage::ready, {}};
    content.names.clear();
    try {
        if (!folder.empty()) content.names = listImages(folder);
    } catch (const Error& error) {
        content.status = {LoadingStatus::Stage::failed, error.message()};
    }
    if (content.names.size() > content.options.mostCount) {
        content.status.message =
            fmt::format("{}: has {}, of which the first {} are shown", folder.string(),
                        cli::formatCount(content.names.size(), "image"),
                        cli::formatCount(content.options.mostCount));
        content.names.resize(content.options.mostCount);
    }
    content.thumbnails.clear();
    for (const std::string& name : content.names)
        content.thumbnails.push_back({name});
    update();
}

void Thumbnails::update() {
    content_->loads.update(content_->names);
    content_->collect();
}

void Thumbnails::finish() {
    content_->loads.finish(content_->names);
    content_->collect();
}

const LoadingStatus& Thumbnails::status() const {
    return content_->status;
}

std::span<const Thumbnail> Thumbnails::all() const {
    return content_->thumbnails;
}

}  // namespace prt::viewer

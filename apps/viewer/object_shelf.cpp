#include "apps/viewer/object_shelf.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/relit_asset.h"
#include "apps/viewer/background_loads.h"

namespace prt::viewer {

struct ObjectShelf::Content {
    explicit Content(const ImageLimits& limits)
        : loads([limits](const std::string& path) -> BackgroundLoads<Asset>::Loaded {
              Asset asset = cli::readShownAsset(path, limits);
              const std::string mended = fmt::format("{}", fmt::join(asset.scene.warnings, "; "));
              return {std::move(asset), mended};
          }) {}

    void name(std::span<const ObjectChoice> objects) {
        names.clear();
        for (const ObjectChoice& object : objects)
            names.push_back(object.asset);
    }

    void collect() {
        statuses.clear();
        assets.clear();
        for (const std::string& name : names) {
            statuses.push_back(loads.at(name).status);
            assets.push_back(loads.at(name).value);
        }
    }

    BackgroundLoads<Asset> loads;
    std::vector<std::string> names;
    std::vector<LoadingStatus> statuses;
    std::vector<std::shared_ptr<const Asset>> assets;
};

ObjectShelf::ObjectShelf(const ImageLimits& limits) : content_(std::make_unique<Content>(limits)) {}

ObjectShelf::~ObjectShelf() = default;

void ObjectShelf::update(std::span<const ObjectChoice> objects) {
    content_->name(objects);
    content_->loads.update(content_->names);
    content_->collect();
}

void ObjectShelf::finish(std::span<const ObjectChoice> objects) {
    content_->name(objects);
    content_->loads.finish(content_->names);
    content_->collect();
}

std::span<const LoadingStatus> ObjectShelf::statuses() const {
    return content_->statuses;
}

std::shared_ptr<const Asset> ObjectShelf::asset(std::size_t object) const {
    return content_->assets.at(object);
}

}  // namespace prt::viewer

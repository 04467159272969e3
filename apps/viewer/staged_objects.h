#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/object_shelf.h"
#include "apps/viewer/shown_object.h"
#include "apps/viewer/view_state.h"

namespace prt::viewer {

/// An object that stands in the picture.
struct StandingObject {
    std::size_t index = 0;  ///< into ViewState::objects
    ShownObject* object = nullptr;
    Affine3d worldFromObject{};
};

/// The objects of a view on the graphics card.
class StagedObjects {
  public:
    explicit StagedObjects(const RelightingOptions& options) : options_(options) {}

    /// Puts there what has been read, and takes away what the view names no longer.
    ///
    /// @param shelf  updated for the same objects
    void update(std::span<const ObjectChoice> objects, const ObjectShelf& shelf);

    /// Another one whenever others are there.
    std::size_t revision() const { return revision_; }

    /// Those that the view shows, where they stand.
    std::vector<StandingObject> place(const ViewState& view) const;

    /// All that are there, shown or not.
    std::vector<const ShownObject*> all() const;
    /// Why others are not: the card has no room for them.
    std::vector<std::string> failures() const;

  private:
    struct Entry {
        std::shared_ptr<const Asset> asset{};
        std::unique_ptr<ShownObject> shown{};
        std::optional<std::string> failure{};
    };
    void putOnCard(Entry& entry, const std::string& path) const;

    RelightingOptions options_;
    std::vector<Entry> entries_;  ///< one an object of the view
    std::size_t revision_ = 0;
};

/// The smallest box about them all.
Bounds boundObjects(std::span<const StandingObject> objects);

}  // namespace prt::viewer

#include "apps/viewer/staged_objects.h"

#include <algorithm>
#include <utility>

#include "apps/common/parse.h"
#include "apps/viewer/placement.h"
#include "prt/base/error.h"

namespace prt::viewer {

void StagedObjects::update(std::span<const ObjectChoice> objects, const ObjectShelf& shelf) {
    std::vector<Entry> next(objects.size());
    bool isSame = next.size() == entries_.size();
    for (std::size_t i = 0; i < next.size(); ++i) {
        next[i].asset = shelf.asset(i);
        isSame = isSame && next[i].asset == entries_[i].asset;
    }
    if (isSame) return;
    for (std::size_t i = 0; i < next.size(); ++i) {
        if (!next[i].asset) continue;
        const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
            return entry.asset == next[i].asset && (entry.shown || entry.failure);
        });
        if (known != entries_.end())
            next[i] = std::exchange(*known, {});
        else
            putOnCard(next[i], objects[i].asset);
    }
    entries_ = std::move(next);
    ++revision_;
}

void StagedObjects::putOnCard(Entry& entry, const std::string& path) const {
    try {
        entry.shown = std::make_unique<ShownObject>(entry.asset, path, options_);
    } catch (const Error& error) {
        entry.failure = path + ": " + error.message();
    }
}

std::vector<StandingObject> StagedObjects::place(const ViewState& view) const {
    std::vector<StandingObject> standing;
    std::vector<Bounds> bounds;
    std::vector<Mat3d> rotations;
    for (std::size_t i = 0; i < std::min(entries_.size(), view.objects.size()); ++i) {
        if (!entries_[i].shown || !view.objects[i].isShown) continue;
        standing.push_back({.index = i, .object = entries_[i].shown.get()});
        bounds.push_back(entries_[i].shown->scene().bounds());
        rotations.push_back(cli::rotationFromDegrees(view.objects[i].rotationDegrees));
    }
    const std::vector<Affine3d> places = placeObjects(bounds, rotations);
    for (std::size_t k = 0; k < standing.size(); ++k)
        standing[k].worldFromObject = places[k];
    return standing;
}

std::vector<const ShownObject*> StagedObjects::all() const {
    std::vector<const ShownObject*> shown;
    for (const Entry& entry : entries_)
        if (entry.shown) shown.push_back(entry.shown.get());
    return shown;
}

std::vector<std::string> StagedObjects::failures() const {
    std::vector<std::string> failures;
    for (const Entry& entry : entries_)
        if (entry.failure) failures.push_back(*entry.failure);
    return failures;
}

Bounds boundObjects(std::span<const StandingObject> objects) {
    if (objects.empty()) return {};
    const auto boundOf = [](const StandingObject& standing) {
        return moveBounds(standing.worldFromObject, standing.object->scene().bounds());
    };
    Bounds all = boundOf(objects.front());
    for (const StandingObject& standing : objects.subspan(1))
        all = uniteBounds(all, boundOf(standing));
    return all;
}

}  // namespace prt::viewer

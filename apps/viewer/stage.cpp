#include "apps/viewer/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "apps/common/parse.h"
#include "apps/common/picture.h"
#include "apps/common/ringing.h"
#include "apps/viewer/placement.h"
#include "apps/viewer/shown_object.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"
#include "prt/gpu/gpu_background.h"
#include "prt/gpu/gpu_display.h"
#include "prt/gpu/gpu_view.h"
#include "prt/light/deringing.h"
#include "prt/scene/framing.h"

namespace prt::viewer {
namespace {

/// A pane and the columns of the picture that it fills.
struct PlacedPane {
    std::size_t index = 0;
    const Pane* pane = nullptr;
    PixelColumns columns{};
};

std::vector<PlacedPane> placePanes(const ViewState& view, int width) {
    if (!view.right) return {{0, &view.left, {}}};
    const int split = static_cast<int>(std::lround(view.splitPosition * width));
    return {{0, &view.left, {0, split}}, {1, &*view.right, {split, width}}};
}

/// An object of the view on the card, or why it is not there.
struct StagedObject {
    std::shared_ptr<const Asset> asset{};
    std::unique_ptr<ShownObject> shown{};
    std::optional<std::string> failure{};
};

}  // namespace

struct Stage::Content {
    StageOptions options;
    RelightingOptions relighting;
    ObjectShelf shelf;
    LightRig rig;
    GpuDisplay display;
    std::vector<StagedObject> staged;
    std::optional<GpuTarget> target;
    int sampleCount = 0;
    std::optional<GpuBackground> background;
    std::size_t backgroundRevision = 0;
    float brightness = 0.0f;  ///< of the lights, in stops, for automatic exposure
    std::size_t brightnessRevision = 0;
    /// The factors of the window "auto", for so many bands of the light as it is.
    mutable std::map<int, std::vector<double>> deringing;
    mutable std::size_t deringingRevision = 0;

    explicit Content(const StageOptions& given)
        : options(given),
          relighting{.threadCount = given.threadCount,
                     .onCard = given.relightsOnCard.value_or(!isSoftwareRasteriser())},
          shelf(given.limits),
          rig(given.limits) {}

    /// Puts what has been read onto the card.
    void stage(const ViewState& view) {
        std::vector<StagedObject> next(view.objects.size());
        for (std::size_t i = 0; i < next.size(); ++i) {
            next[i].asset = shelf.asset(i);
            if (!next[i].asset) continue;
            const auto same = std::find_if(staged.begin(), staged.end(), [&](StagedObject& old) {
                return old.asset == next[i].asset && (old.shown || old.failure);
            });
            if (same != staged.end())
                std::swap(next[i], *same);
            else
                putOnCard(next[i], view.objects[i].asset);
        }
        staged = std::move(next);
    }

    void putOnCard(StagedObject& object, const std::string& path) const {
        try {
            object.shown = std::make_unique<ShownObject>(object.asset, path, relighting);
        } catch (const Error& error) {
            object.failure = path + ": " + error.message();
        }
    }

    /// What can be drawn of the view: numbers of objects.
    std::vector<std::size_t> findDrawn(const ViewState& view) const {
        std::vector<std::size_t> drawn;
        for (std::size_t i = 0; i < std::min(staged.size(), view.objects.size()); ++i)
            if (staged[i].shown && view.objects[i].isShown) drawn.push_back(i);
        return drawn;
    }

    std::vector<Affine3d> placeDrawn(const ViewState& view,
                                     std::span<const std::size_t> drawn) const {
        std::vector<Bounds> bounds;
        std::vector<Mat3d> rotations;
        for (const std::size_t i : drawn) {
            bounds.push_back(staged[i].shown->scene().bounds());
            rotations.push_back(cli::rotationFromDegrees(view.objects[i].rotationDegrees));
        }
        return placeObjects(bounds, rotations);
    }

    Bounds boundDrawn(const ViewState& view) const {
        const std::vector<std::size_t> drawn = findDrawn(view);
        if (drawn.empty()) return {};
        const std::vector<Affine3d> places = placeDrawn(view, drawn);
        Bounds all = moveBounds(places[0], staged[drawn[0]].shown->scene().bounds());
        for (std::size_t k = 1; k < drawn.size(); ++k)
            all = uniteBounds(all, moveBounds(places[k], staged[drawn[k]].shown->scene().bounds()));
        return all;
    }

    const std::vector<double>& findDeringing(const Lighting& lighting) const {
        if (deringingRevision != rig.revision()) deringing.clear();
        deringingRevision = rig.revision();
        const auto [found, isNew] = deringing.try_emplace(lighting.bandCount);
        if (isNew) found->second = deringingFactors(lighting);
        return found->second;
    }

    void prepareTarget(int width, int height, int samples) {
        const bool fits = target && target->width() == width && target->height() == height &&
                          sampleCount == samples;
        if (fits) return;
        target.reset();
        target.emplace(width, height, samples);
        sampleCount = samples;
    }

    void prepareBackground() {
        if (background && backgroundRevision == rig.revision()) return;
        background.emplace(rig.environment());
        backgroundRevision = rig.revision();
    }

    void measureBrightness() {
        if (brightnessRevision == rig.revision()) return;
        brightness = cli::chooseExposure(rig.sum());
        brightnessRevision = rig.revision();
    }
};

Stage::Stage(const StageOptions& options) : content_(std::make_unique<Content>(options)) {}
Stage::~Stage() = default;

void Stage::update(const ViewState& view) {
    content_->shelf.update(view.objects);
    content_->rig.update(view.lights);
    content_->stage(view);
    content_->measureBrightness();
}

void Stage::finishLoading(const ViewState& view) {
    content_->shelf.finish(view.objects);
    content_->rig.finish(view.lights);
    update(view);
}

const ObjectShelf& Stage::objects() const {
    return content_->shelf;
}

const LightRig& Stage::lights() const {
    return content_->rig;
}

bool Stage::showsAnything() const {
    return std::any_of(content_->staged.begin(), content_->staged.end(),
                       [](const StagedObject& object) { return object.shown != nullptr; });
}

bool Stage::relightsOnCard() const {
    return content_->relighting.onCard;
}

std::size_t Stage::vertexCount() const {
    std::size_t count = 0;
    for (const StagedObject& object : content_->staged)
        if (object.shown) count += object.asset->scene.vertexCount();
    return count;
}

std::size_t Stage::triangleCount() const {
    std::size_t count = 0;
    for (const StagedObject& object : content_->staged)
        if (object.shown) count += object.asset->scene.triangleCount();
    return count;
}

std::vector<std::string> Stage::describeFaults() const {
    std::vector<std::string> faults;
    const auto collect = [&](std::span<const LoadingStatus> statuses) {
        for (const LoadingStatus& status : statuses)
            if (status.stage == LoadingStatus::Stage::failed) faults.push_back(status.message);
    };
    collect(content_->shelf.statuses());
    collect(content_->rig.statuses());
    for (const StagedObject& object : content_->staged)
        if (object.failure) faults.push_back(*object.failure);
    return faults;
}

std::optional<Affine3d> Stage::worldFromObject(const ViewState& view, std::size_t object) const {
    const std::vector<std::size_t> drawn = content_->findDrawn(view);
    const auto found = std::find(drawn.begin(), drawn.end(), object);
    if (found == drawn.end()) return std::nullopt;
    return content_->placeDrawn(view, drawn)[static_cast<std::size_t>(found - drawn.begin())];
}

CameraPose Stage::cameraPose(const ViewState& view, double aspectRatio) const {
    if (view.camera) return *view.camera;
    const Bounds bounds = content_->boundDrawn(view);
    Camera camera = frameBounds(bounds, static_cast<float>(aspectRatio));
    if (content_->staged.size() == 1 && content_->staged[0].asset &&
        !content_->staged[0].asset->scene.cameras.empty())
        camera = content_->staged[0].asset->scene.cameras.front();
    const double distance = Vec3d(bounds.center() - camera.eye).dot(Vec3d(camera.forward));
    return poseFromCamera(camera, std::max(distance, static_cast<double>(bounds.radius()) * 0.1));
}

Lighting Stage::lightingOf(const ViewState& view, const Pane& pane, int mostBands) const {
    if (pane.content == PaneContent::coefficient)
        return makeBasisLighting(mostBands,
                                 std::min(pane.coefficient, shCoefficientCount(mostBands) - 1));
    const Lighting used = truncate(content_->rig.sum(), std::clamp(pane.bandCount, 1, mostBands));
    const Lighting calm =
        cli::lowerRinging(used, view.window, [&] { return content_->findDeringing(used); });
    return rotate(calm, cli::rotationFromDegrees(view.lightRotationDegrees));
}

const GpuTarget& Stage::draw(const ViewState& view, int width, int height, int sampleCount) {
    Content& content = *content_;
    content.prepareTarget(width, height, sampleCount);
    if (view.showBackground) content.prepareBackground();
    const Camera camera = makeCamera(cameraPose(view, static_cast<double>(width) / height));
    const std::vector<std::size_t> drawn = content.findDrawn(view);
    const std::vector<Affine3d> places = content.placeDrawn(view, drawn);
    for (const auto& [index, pane, columns] : placePanes(view, width)) {
        std::vector<GpuObject> objects;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            ShownObject& object = *content.staged[drawn[k]].shown;
            const Mat3d objectFromWorld = places[k].linear.transposed();
            Lighting lighting = lightingOf(view, *pane, object.asset().transfer.bandCount);
            if (pane->content != PaneContent::coefficient)
                lighting = rotate(lighting, objectFromWorld);
            const Vec3d eye = objectFromWorld * (Vec3d(camera.eye) - places[k].translation);
            objects.push_back(
                {&object.scene(), &object.relight(index, *pane, lighting, Vec3f(eye)), places[k]});
        }
        drawGpuView(objects, camera, *content.target,
                    {.background = view.showBackground && pane->content == PaneContent::relit
                                       ? &*content.background
                                       : nullptr,
                     .worldFromBackground = cli::rotationFromDegrees(view.lightRotationDegrees),
                     .columns = columns,
                     .wireFrame = view.wireFrame});
    }
    return *content.target;
}

void Stage::present(const ViewState& view) const {
    const Content& content = *content_;
    if (!content.target) return;
    for (const auto& [index, pane, columns] : placePanes(view, content.target->width())) {
        DisplayOptions display = view.display;
        if (view.autoExposure) display.exposureStops += content.brightness;
        // False colours are shown as they are.
        if (pane->content == PaneContent::coefficient)
            display = {.exposureStops = 0.0f, .toneCurve = ToneCurve::none};
        content.display.draw(*content.target, display, columns);
    }
}

}  // namespace prt::viewer

#include "apps/viewer/stage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "apps/common/parse.h"
#include "apps/common/picture.h"
#include "apps/common/ringing.h"
#include "apps/viewer/mirror_light.h"
#include "apps/viewer/staged_objects.h"
#include "apps/viewer/view_lobes.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"
#include "prt/gpu/gpu_background.h"
#include "prt/gpu/gpu_display.h"
#include "prt/gpu/gpu_view.h"
#include "prt/light/deringing.h"
#include "prt/scene/framing.h"

namespace prt::viewer {
namespace {

/// As bright on the screen as it is dark.
constexpr float kMiddleGrey = 0.18f;

/// A side of the picture: a pane, the columns that it fills, and what was drawn there.
struct Side {
    std::size_t index = 0;
    Pane pane{};
    PixelColumns columns{};
    std::vector<GpuObject> drawn{};
};

std::vector<Side> placePanes(const ViewState& view, int width) {
    if (!view.right) return {{.index = 0, .pane = view.left}};
    // Written so that what is no number is clamped, too.
    const double position = std::min(std::max(0.0, view.splitPosition), 1.0);
    const int split = static_cast<int>(std::lround(position * width));
    return {{.index = 0, .pane = view.left, .columns = {0, split}},
            {.index = 1, .pane = *view.right, .columns = {split, width}}};
}

Mat3d worldFromLight(const ViewState& view) {
    return cli::rotationFromDegrees(view.lightRotationDegrees);
}

/// Something made of the lights, until they are others.
template <class Value>
class OfLights {
  public:
    template <class Make>
    Value& get(const LightRig& rig, const Make& make) {
        if (!value_ || revision_ != rig.revision()) {
            value_.reset();
            value_.emplace(make());
            revision_ = rig.revision();
        }
        return *value_;
    }

  private:
    std::optional<Value> value_;
    std::size_t revision_ = 0;
};

}  // namespace

struct Stage::Content {
    StageOptions options;
    RelightingOptions relighting;
    ObjectShelf shelf;
    LightRig rig;
    StagedObjects staged;
    MirrorLight mirrors;
    ReferenceTracer tracer;
    ReferencePicture reference;
    ViewLobes lobes;
    GpuDisplay screen;
    OfLights<GpuBackground> background;
    mutable OfLights<float> brightness;  ///< stops that show a white sphere well
    /// The factors of the window "auto", for so many bands.
    mutable OfLights<std::map<int, std::vector<double>>> deringing;

    // What was drawn last.
    std::optional<GpuTarget> target;
    int sampleCount = 0;
    Camera camera;
    std::vector<StandingObject> standing;
    std::vector<Side> sides;
    bool showsMirrors = false;
    bool tracesReference = false;

    explicit Content(const StageOptions& given)
        : options(given),
          relighting{.threadCount = given.threadCount,
                     .onCard = given.relightsOnCard.value_or(!isSoftwareRasteriser())},
          shelf(given.limits),
          rig(given.limits),
          staged(relighting),
          tracer(tracerOptions(given)) {}

    /// What is awaited is all that is traced, so that a picture has the same bits whenever it is
    /// asked for.
    static ReferenceTracerOptions tracerOptions(const StageOptions& given) {
        ReferenceTracerOptions tracing{.threadCount = given.threadCount};
        if (given.awaitedPathsPerPixel) tracing.mostPathsPerPixel = *given.awaitedPathsPerPixel;
        return tracing;
    }

    bool waits() const { return options.awaitedPathsPerPixel.has_value(); }

    const std::vector<double>& findDeringing(const Lighting& lighting) const {
        auto& known = deringing.get(rig, [] { return std::map<int, std::vector<double>>(); });
        const auto [found, isNew] = known.try_emplace(lighting.bandCount);
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

    /// The objects of a pane, relit.
    std::vector<GpuObject> relightObjects(const Stage& stage, const ViewState& view,
                                          const Side& side) {
        std::vector<GpuObject> objects;
        for (const auto& [index, object, worldFromObject] : standing) {
            const Mat3d objectFromWorld = worldFromObject.linear.transposed();
            Lighting lighting =
                stage.lightingOf(view, side.pane, object->asset().transfer.bandCount);
            if (side.pane.content != PaneContent::coefficient)
                lighting = rotate(lighting, objectFromWorld);
            const Vec3f eye(objectFromWorld * (Vec3d(camera.eye) - worldFromObject.translation));
            objects.push_back({&object->scene(),
                               &object->relight(side.index, side.pane, lighting, eye),
                               worldFromObject});
        }
        return objects;
    }

    GpuMirrors* prepareMirrors(const ViewState& view, std::span<const GpuObject> objects) {
        const bool areSeen = std::ranges::any_of(
            objects, [](const GpuObject& object) { return object.radiance->hasMirrors(); });
        if (!areSeen) return nullptr;
        showsMirrors = true;
        if (waits())
            mirrors.finish(rig.sharedEnvironment());
        else
            mirrors.update(rig.sharedEnvironment());
        if (mirrors.mirrors()) mirrors.mirrors()->turn(worldFromLight(view));
        return mirrors.mirrors();
    }

    void drawRelit(const Stage& stage, const ViewState& view, Side& side) {
        side.drawn = relightObjects(stage, view, side);
        const bool isLit = side.pane.content == PaneContent::relit;
        const GpuBackground* behind = nullptr;
        if (view.showBackground && isLit)
            behind = &background.get(rig, [&] { return GpuBackground(rig.environment()); });
        drawGpuView(
            side.drawn, camera, *target,
            {.background = behind,
             .worldFromBackground = worldFromLight(view),
             .mirrors = isLit ? prepareMirrors(view, side.drawn) : nullptr,
             .columns = side.columns,
             .wireFrame = view.wireFrame,
             .wireRadiance = kMiddleGrey * std::exp2(-displayOptions(view, side).exposureStops)});
    }

    ReferenceRequest makeRequest(const Stage& stage, const ViewState& view,
                                 const Side& side) const {
        ReferenceRequest request{.environment = rig.sharedEnvironment(),
                                 .worldFromEnvironment = worldFromLight(view),
                                 .showBackground = view.showBackground,
                                 .camera = camera,
                                 .width = target->width(),
                                 .height = target->height()};
        for (const StandingObject& object : standing)
            request.objects.push_back({object.object->sharedAsset(), object.worldFromObject});
        const Asset& first = standing.front().object->asset();
        request.model = chooseReferenceModel(first, chooseTransport(side.pane, first.transfer));
        if (side.pane.bandCount < kMaxBandCount)
            request.lighting = stage.lightingOf(view, side.pane, kMaxBandCount);
        return request;
    }

    void drawReference(const Stage& stage, const ViewState& view, const Side& side) {
        // One is traced at a time: where both sides show it, that of the left.
        if (!std::exchange(tracesReference, true)) tracer.trace(makeRequest(stage, view, side));
        reference = waits() ? tracer.finish(*options.awaitedPathsPerPixel) : tracer.picture();
        if (reference.radiance)
            target->writeRadiance(*reference.radiance, side.columns);
        else
            drawGpuView({}, camera, *target, {.columns = side.columns});
    }

    /// How a side is shown: false colours are as they are.
    DisplayOptions displayOptions(const ViewState& view, const Side& side) const {
        if (side.pane.content == PaneContent::coefficient)
            return {.exposureStops = 0.0f, .toneCurve = ToneCurve::none};
        DisplayOptions display = view.display;
        if (view.autoExposure)
            display.exposureStops +=
                brightness.get(rig, [&] { return cli::chooseExposure(rig.sum()); });
        return display;
    }
};

int movingSampleCount() {
    return isSoftwareRasteriser() ? 1 : kRestingSampleCount;
}

Stage::Stage(const StageOptions& options) : content_(std::make_unique<Content>(options)) {}
Stage::~Stage() = default;

void Stage::update(const ViewState& view) {
    Content& content = *content_;
    content.shelf.update(view.objects);
    content.rig.update(view.lights);
    content.staged.update(view.objects, content.shelf);
    if (content.showsMirrors && !content.waits())
        content.mirrors.update(content.rig.sharedEnvironment());
    if (content.tracesReference && !content.waits()) content.reference = content.tracer.picture();
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

bool Stage::relightsOnCard() const {
    return content_->relighting.onCard;
}

void Stage::requireSomethingToShow() const {
    const std::span<const LoadingStatus> lights = content_->rig.statuses();
    const bool isLit =
        lights.empty() || !std::ranges::all_of(lights, [](const LoadingStatus& light) {
            return light.stage == LoadingStatus::Stage::failed;
        });
    if (isLit && !content_->staged.all().empty()) return;
    const std::vector<std::string> faults = describeFaults();
    throw Error(ErrorCode::malformed, faults.empty() ? "there is nothing to show" : faults.front());
}

std::size_t Stage::vertexCount() const {
    std::size_t count = 0;
    for (const ShownObject* object : content_->staged.all())
        count += object->asset().scene.vertexCount();
    return count;
}

std::size_t Stage::triangleCount() const {
    std::size_t count = 0;
    for (const ShownObject* object : content_->staged.all())
        count += object->asset().scene.triangleCount();
    return count;
}

std::vector<std::string> Stage::describeFaults() const {
    std::vector<std::string> faults = content_->staged.failures();
    const auto collect = [&](std::span<const LoadingStatus> statuses) {
        for (const LoadingStatus& status : statuses)
            if (status.stage == LoadingStatus::Stage::failed) faults.push_back(status.message);
    };
    collect(content_->shelf.statuses());
    collect(content_->rig.statuses());
    if (content_->tracesReference && !content_->reference.failure.empty())
        faults.push_back(content_->reference.failure);
    return faults;
}

std::optional<Affine3d> Stage::worldFromObject(const ViewState& view, std::size_t object) const {
    const std::vector<StandingObject> standing = content_->staged.place(view);
    const auto found = std::ranges::find(standing, object, &StandingObject::index);
    return found == standing.end() ? std::nullopt : std::optional(found->worldFromObject);
}

CameraPose Stage::cameraPose(const ViewState& view, double aspectRatio) const {
    if (view.camera) return *view.camera;
    const std::vector<StandingObject> standing = content_->staged.place(view);
    const Bounds bounds = boundObjects(standing);
    Camera camera = frameBounds(bounds, static_cast<float>(aspectRatio));
    if (view.objects.size() == 1 && standing.size() == 1 &&
        !standing[0].object->asset().scene.cameras.empty())
        camera = standing[0].object->asset().scene.cameras.front();
    const auto distance = static_cast<double>((bounds.center() - camera.eye).dot(camera.forward));
    return poseFromCamera(camera, std::max(distance, 0.1 * static_cast<double>(bounds.radius())));
}

Lighting Stage::lightingOf(const ViewState& view, const Pane& pane, int mostBands) const {
    if (pane.content == PaneContent::coefficient)
        return makeBasisLighting(
            mostBands, std::clamp(pane.coefficient, 0, shCoefficientCount(mostBands) - 1));
    const Lighting used = truncate(content_->rig.sum(), std::clamp(pane.bandCount, 1, mostBands));
    const Lighting calm =
        cli::lowerRinging(used, view.window, [&] { return content_->findDeringing(used); });
    return rotate(calm, worldFromLight(view));
}

const GpuTarget& Stage::draw(const ViewState& view, int width, int height, int sampleCount) {
    Content& content = *content_;
    content.prepareTarget(width, height, sampleCount);
    content.camera = makeCamera(cameraPose(view, static_cast<double>(width) / height));
    content.standing = content.staged.place(view);
    content.sides = placePanes(view, width);
    content.showsMirrors = false;
    content.tracesReference = false;
    for (Side& side : content.sides) {
        if (side.pane.content == PaneContent::reference && !content.standing.empty())
            content.drawReference(*this, view, side);
        else
            content.drawRelit(*this, view, side);
    }
    if (!content.tracesReference) {
        content.tracer.stop();
        content.reference = {};
    }
    return *content.target;
}

void Stage::present(const ViewState& view) {
    Content& content = *content_;
    if (!content.target) return;
    for (const Side& side : content.sides) {
        content.screen.draw(*content.target, content.displayOptions(view, side), side.columns);
        if (view.picked && view.showTransferLobe && !side.drawn.empty())
            content.lobes.drawTransfer(side.index, side.pane, *view.picked, content.standing,
                                       *content.target, side.drawn, content.camera, side.columns);
    }
    if (view.showLightLobe)
        content.lobes.drawLight(lightingOf(view, content.sides[0].pane, kMaxBandCount),
                                content.camera, content.target->height());
}

StageRevision Stage::revision() const {
    const Content& content = *content_;
    StageRevision revision{.lights = content.rig.revision(), .objects = content.staged.revision()};
    if (content.showsMirrors) revision.mirrors = content.mirrors.revision();
    if (content.tracesReference) revision.reference = content.reference.radiance;
    return revision;
}

bool Stage::isBusy() const {
    const Content& content = *content_;
    return countWaiting(content.shelf.statuses()) + countWaiting(content.rig.statuses()) > 0 ||
           (content.showsMirrors && content.mirrors.isBusy()) ||
           (content.tracesReference && content.reference.failure.empty() &&
            content.reference.pathsPerPixel <
                content.tracerOptions(content.options).mostPathsPerPixel);
}

const ReferencePicture& Stage::reference() const {
    return content_->reference;
}

}  // namespace prt::viewer

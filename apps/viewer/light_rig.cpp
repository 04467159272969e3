#include "apps/viewer/light_rig.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/light_argument.h"
#include "apps/common/parse.h"
#include "apps/viewer/background_loads.h"
#include "apps/viewer/lat_long_size.h"
#include "prt/light/resampling.h"

namespace prt::viewer {
namespace {

/// Of the picture of a light that is no image: a texel is a third of a degree wide.
constexpr int kDrawnHeight = 512;

/// Several lights come to the size of the largest, but to no more than this.
constexpr int kMostSummedHeight = 1024;

/// A light as it was read.
struct ReadLight {
    Lighting lighting;
    Environment environment;  ///< the light itself, lat-long
};

BackgroundLoads<ReadLight>::Loaded readLight(const std::string& source, const ImageLimits& limits) {
    cli::LightSource light = cli::loadLight(source, kMaxBandCount, {}, limits);
    Environment environment = light.environment
                                  ? resampleAsLatLong(std::move(*light.environment))
                                  : cli::drawLight(light, {}, SphereMap::latLong, kDrawnHeight);
    return {{std::move(light.lighting), std::move(environment)},
            cli::describeMending(light.mended).value_or("")};
}

/// Adds a lat-long image of the same size, turned about +y by rotationY, times a factor. Columns go
/// round, and what falls between two is shared by both, so that each row keeps its flux.
void addTurned(const Image& source, double azimuthDegrees, float factor, Image& sum) {
    const int width = source.width;
    const double turn = -azimuthDegrees / 360.0;
    const double shift = (turn - std::floor(turn)) * width;
    const int whole = static_cast<int>(shift);
    const float part = static_cast<float>(shift - whole);
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3f radiance = source.at(x, y) * factor;
            const int to = (x + whole) % width;
            sum.at(to, y) += radiance * (1.0f - part);
            if (part > 0.0f) sum.at((to + 1) % width, y) += radiance * part;
        }
}

/// A light that is on and has been read.
struct Part {
    std::shared_ptr<const ReadLight> light;
    double stops = 0.0;
    double azimuthDegrees = 0.0;

    bool operator==(const Part&) const = default;
};

Lighting sumLighting(std::span<const Part> parts) {
    Lighting sum(kMaxBandCount);
    for (const Part& part : parts) {
        const Lighting turned = scale(
            rotate(part.light->lighting, cli::rotationFromDegrees({0.0, part.azimuthDegrees, 0.0})),
            std::exp2(part.stops));
        // Coefficients from a file may have fewer bands; those that they lack are 0.
        for (std::size_t i = 0; i < turned.coefficients.size(); ++i)
            sum.coefficients[i] += turned.coefficients[i];
    }
    return sum;
}

}  // namespace

struct LightRig::Content {
    explicit Content(const ImageLimits& limits)
        : loads([limits](const std::string& source) { return readLight(source, limits); }) {}

    void name(std::span<const LightChoice> lights) {
        names.clear();
        for (const LightChoice& light : lights)
            names.push_back(light.source);
    }

    void collect(std::span<const LightChoice> lights);
    const Image& resized(const std::shared_ptr<const ReadLight>& light, int height);
    Environment drawSum();
    const std::shared_ptr<const Environment>& share();

    BackgroundLoads<ReadLight> loads;
    std::vector<std::string> names;
    std::vector<LoadingStatus> statuses;
    std::vector<Part> parts;
    std::size_t revision = 0;
    Lighting lighting = Lighting(kMaxBandCount);
    std::shared_ptr<const Environment> environment;  ///< null until it is asked for
    /// Images of the parts in the size of the last sum, those that have another.
    std::map<std::shared_ptr<const ReadLight>, Image> resizedParts;
};

void LightRig::Content::collect(std::span<const LightChoice> lights) {
    statuses.clear();
    std::vector<Part> found;
    bool isComplete = true;
    for (const LightChoice& light : lights) {
        const auto& entry = loads.at(light.source);
        statuses.push_back(entry.status);
        if (light.isOn && entry.status.stage == LoadingStatus::Stage::waiting) isComplete = false;
        if (light.isOn && entry.value)
            found.push_back({entry.value, light.stops, light.azimuthDegrees});
    }
    // What takes the place of a light is not preceded by darkness.
    if (found == parts || (!isComplete && found.size() < parts.size())) return;
    parts = std::move(found);
    ++revision;
    lighting = sumLighting(parts);
    environment.reset();
    std::erase_if(resizedParts, [&](const auto& one) {
        return std::none_of(parts.begin(), parts.end(),
                            [&](const Part& part) { return part.light == one.first; });
    });
}

const Image& LightRig::Content::resized(const std::shared_ptr<const ReadLight>& light, int height) {
    if (light->environment.radiance.height == height) return light->environment.radiance;
    Image& kept = resizedParts[light];
    if (kept.height != height) kept = resizeLatLong(light->environment.radiance, height);
    return kept;
}

Environment LightRig::Content::drawSum() {
    int height = 1;
    for (const Part& part : parts)
        height = std::max(height, part.light->environment.radiance.height);
    if (parts.size() > 1) height = std::min(height, kMostSummedHeight);
    Environment sum{SphereMap::latLong, Image(2 * height, height)};
    for (const Part& part : parts)
        addTurned(resized(part.light, height), part.azimuthDegrees,
                  static_cast<float>(std::exp2(part.stops)), sum.radiance);
    return sum;
}

const std::shared_ptr<const Environment>& LightRig::Content::share() {
    if (environment) return environment;
    // A single image that is neither turned nor scaled is shown as it is, not as a copy.
    if (parts.size() == 1 && parts[0].stops == 0.0 && parts[0].azimuthDegrees == 0.0)
        environment = {parts[0].light, &parts[0].light->environment};
    else
        environment = std::make_shared<const Environment>(drawSum());
    return environment;
}

LightRig::LightRig(const ImageLimits& limits) : content_(std::make_unique<Content>(limits)) {}

LightRig::~LightRig() = default;

void LightRig::update(std::span<const LightChoice> lights) {
    content_->name(lights);
    content_->loads.update(content_->names);
    content_->collect(lights);
}

void LightRig::finish(std::span<const LightChoice> lights) {
    content_->name(lights);
    content_->loads.finish(content_->names);
    content_->collect(lights);
}

std::span<const LoadingStatus> LightRig::statuses() const {
    return content_->statuses;
}

std::size_t LightRig::revision() const {
    return content_->revision;
}

const Lighting& LightRig::sum() const {
    return content_->lighting;
}

const Environment& LightRig::environment() const {
    return *content_->share();
}

std::shared_ptr<const Environment> LightRig::sharedEnvironment() const {
    return content_->share();
}

}  // namespace prt::viewer

#include "apps/prt/light_argument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/io/environment_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/resampling.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUniformPrefix = "uniform:";
constexpr std::string_view kSunPrefix = "sun:";

[[noreturn]] void throwMalformed(const std::string& argument, const std::string& expected) {
    throw Error(ErrorCode::invalidOption, "is not " + expected, argument, "see prt light --help");
}

Lighting parseUniform(const std::string& argument, int bandCount) {
    const std::string_view text = std::string_view(argument).substr(kUniformPrefix.size());
    std::optional<Vec3d> radiance = parseTriple(text);
    if (const std::optional<double> grey = parseNumber(text)) radiance = Vec3d(*grey);
    if (!radiance || std::min({radiance->x, radiance->y, radiance->z}) < 0.0)
        throwMalformed(argument, "uniform:r,g,b or uniform:v with radiances of at least 0");
    return uniformLighting(*radiance, bandCount);
}

/// Azimuth runs as u of a lat-long image does (C4).
Sun parseSun(const std::string& argument) {
    const std::optional<Vec3d> degrees =
        parseTriple(std::string_view(argument).substr(kSunPrefix.size()));
    if (!degrees || std::abs(degrees->y) > 90.0 || degrees->z < 0.0 || degrees->z > 360.0)
        throwMalformed(argument,
                       "sun:azimuth,elevation,angle in degrees with elevation in [-90, 90] and "
                       "angle in [0, 360]");
    const Vec3d radians = *degrees * (std::numbers::pi / 180.0);
    const Vec3d direction(std::cos(radians.y) * std::cos(radians.x), std::sin(radians.y),
                          std::cos(radians.y) * std::sin(radians.x));
    return {direction, 0.5 * radians.z};
}

Lighting readCoefficients(const std::string& path, int bandCount) {
    constexpr std::uintmax_t kMaxJsonBytes = 16 << 20;
    const std::vector<std::byte> bytes = readFile(path, kMaxJsonBytes);
    const Lighting lighting = lightingFromJson(
        std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), path);
    return truncate(lighting, std::min(bandCount, lighting.bandCount));
}

LightSource readEnvironment(const std::string& path, int bandCount, std::optional<SphereMap> map,
                            const ImageLimits& limits) {
    const bool looksLikePrefix = path.find(':') != std::string::npos && !fs::exists(path);
    if (looksLikePrefix)
        throwMalformed(path, "a file, uniform:r,g,b or sun:azimuth,elevation,angle");
    LoadedEnvironment loaded = loadEnvironment(path, map, limits);
    return {projectLighting(loaded.environment, bandCount),
            std::move(loaded.environment),
            loaded.mended,
            {}};
}

}  // namespace

std::string sphereMapNames() {
    constexpr std::array kMaps = {SphereMap::latLong,       SphereMap::angularMap,
                                  SphereMap::verticalCross, SphereMap::horizontalCross,
                                  SphereMap::verticalStrip, SphereMap::horizontalStrip,
                                  SphereMap::octahedral};
    std::vector<std::string_view> names;
    for (const SphereMap map : kMaps)
        names.push_back(sphereMapName(map));
    return fmt::format("{}", fmt::join(names, "|"));
}

LightSource loadLight(const std::string& argument, int bandCount, std::optional<SphereMap> map,
                      const ImageLimits& limits) {
    const bool isUniform = argument.starts_with(kUniformPrefix);
    const bool isSun = argument.starts_with(kSunPrefix);
    const bool isJson = fs::path(argument).extension() == ".json";
    if (map && (isUniform || isSun || isJson || fs::is_directory(argument)))
        throw Error(ErrorCode::invalidOption, "has no layout to choose", argument,
                    "--map is for one image");
    if (isUniform) return {.lighting = parseUniform(argument, bandCount)};
    if (isSun) {
        const Sun sun = parseSun(argument);
        return {.lighting = sunLighting(sun.direction, sun.halfAngleRadians, bandCount),
                .sun = sun};
    }
    if (isJson) return {.lighting = readCoefficients(argument, bandCount)};
    return readEnvironment(argument, bandCount, map, limits);
}

std::optional<std::string> describeMending(const SanitiseReport& mended) {
    std::vector<std::string> parts;
    if (mended.nanCount > 0) parts.push_back(fmt::format("{} with NaN became 0", mended.nanCount));
    if (mended.infiniteCount > 0)
        parts.push_back(
            fmt::format("{} with infinity became the largest finite value", mended.infiniteCount));
    if (mended.negativeCount > 0)
        parts.push_back(
            fmt::format("{} with a negative channel became 0 there", mended.negativeCount));
    if (parts.empty()) return std::nullopt;
    return fmt::format("texels were mended: {}", fmt::join(parts, ", "));
}

std::unique_ptr<DistantLight> makeExactLight(const LightSource& light, const Mat3d& rotation) {
    if (light.environment) return makeEnvironmentLight(*light.environment, rotation);
    if (light.sun)
        return makeSunLight(rotation * light.sun->direction, light.sun->halfAngleRadians);
    return makeBandLimitedLight(rotate(light.lighting, rotation));
}

Environment makeBackground(const LightSource& light, const Mat3d& rotation) {
    constexpr int kReconstructionWidth = 512;
    if (!light.environment)
        return {SphereMap::latLong,
                reconstructLatLong(rotate(light.lighting, rotation), kReconstructionWidth)};
    if (rotation == Mat3d()) return *light.environment;
    const int height = std::clamp(light.environment->radiance.height, 256, 2048);
    return rotate(*light.environment, rotation, SphereMap::latLong, 2 * height, height);
}

}  // namespace prt::cli

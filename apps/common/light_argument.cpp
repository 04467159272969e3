#include "apps/common/light_argument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/common/parse.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/io/environment_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/clear_sky.h"
#include "prt/light/resampling.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUniformPrefix = "uniform:";
constexpr std::string_view kSunPrefix = "sun:";
constexpr std::string_view kSkyPrefix = "sky:";
constexpr std::string_view kDaylightPrefix = "daylight:";

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
Vec3d directionFromDegrees(double azimuth, double elevation) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    return {std::cos(elevation * kDegree) * std::cos(azimuth * kDegree),
            std::sin(elevation * kDegree),
            std::cos(elevation * kDegree) * std::sin(azimuth * kDegree)};
}

Sun parseSun(const std::string& argument) {
    const std::optional<Vec3d> degrees =
        parseTriple(std::string_view(argument).substr(kSunPrefix.size()));
    if (!degrees || std::abs(degrees->y) > 90.0 || degrees->z < 0.0 || degrees->z > 360.0)
        throwMalformed(argument,
                       "sun:azimuth,elevation,angle in degrees with elevation in [-90, 90] and "
                       "angle in [0, 360]");
    return {directionFromDegrees(degrees->x, degrees->y), degrees->z * std::numbers::pi / 360.0};
}

ClearSky parseSky(const std::string& argument, std::string_view prefix) {
    constexpr const char* kUsualTurbidity = ",3";
    std::string numbers = argument.substr(prefix.size());
    if (std::count(numbers.begin(), numbers.end(), ',') == 1) numbers += kUsualTurbidity;
    const std::optional<Vec3d> values = parseTriple(numbers);
    if (!values || values->y < 0.0 || values->y > 90.0 || values->z < ClearSky::kMinTurbidity ||
        values->z > ClearSky::kMaxTurbidity)
        throwMalformed(argument, std::string(prefix) +
                                     "azimuth,elevation[,turbidity] with degrees, elevation in [0, "
                                     "90] and turbidity in [2, 10]");
    return ClearSky(directionFromDegrees(values->x, values->y), values->z);
}

LightSource makeSky(const ClearSky& sky, bool withSun, int bandCount) {
    // A texel of the larger picture is smaller than the sun.
    const int width = withSun ? 2048 : 512;
    return {.lighting = withSun ? daylightLighting(sky, bandCount) : skyLighting(sky, bandCount),
            .environment = drawSky(sky, width, withSun)};
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
        throwMalformed(path, "a file, or one of uniform: sun: sky: daylight: with its numbers");
    LoadedEnvironment loaded = loadEnvironment(path, map, limits);
    return {projectLighting(loaded.environment, bandCount),
            std::move(loaded.environment),
            loaded.mended,
            {}};
}

}  // namespace

bool isImageName(const std::string& path) {
    constexpr std::array<std::string_view, 5> kSuffixes = {".exr", ".hdr", ".png", ".jpg", ".jpeg"};
    return std::ranges::find(kSuffixes, lowerSuffix(path)) != kSuffixes.end();
}

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

std::string nameLight(const std::string& argument) {
    if (!fs::exists(argument)) return argument;
    return fs::weakly_canonical(argument).stem().string();
}

LightSource loadLight(const std::string& argument, int bandCount, std::optional<SphereMap> map,
                      const ImageLimits& limits) {
    const bool isUniform = argument.starts_with(kUniformPrefix);
    const bool isSun = argument.starts_with(kSunPrefix);
    const bool isSky = argument.starts_with(kSkyPrefix);
    const bool isDaylight = argument.starts_with(kDaylightPrefix);
    const bool isJson = fs::path(argument).extension() == ".json";
    if (map && (isUniform || isSun || isSky || isDaylight || isJson || fs::is_directory(argument)))
        throw Error(ErrorCode::invalidOption, "has no layout to choose", argument,
                    "--map is for one image");
    if (isUniform) return {.lighting = parseUniform(argument, bandCount)};
    if (isSun) {
        const Sun sun = parseSun(argument);
        return {.lighting = sunLighting(sun.direction, sun.halfAngleRadians, bandCount),
                .sun = sun};
    }
    if (isSky) return makeSky(parseSky(argument, kSkyPrefix), false, bandCount);
    if (isDaylight) return makeSky(parseSky(argument, kDaylightPrefix), true, bandCount);
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

Environment makeBackground(const LightSource& light) {
    constexpr int kReconstructionWidth = 512;
    if (light.environment) return *light.environment;
    return {SphereMap::latLong, reconstructLatLong(light.lighting, kReconstructionWidth)};
}

Environment makeMirroredLight(const LightSource& light) {
    constexpr int kHeight = 512;  // a texel is a third of a degree wide
    return light.sun ? drawLight(light, {}, SphereMap::latLong, kHeight) : makeBackground(light);
}

Environment drawLight(const LightSource& light, const Mat3d& rotation, SphereMap map,
                      int cellSize) {
    const auto [width, height] = sphereMapSize(map, cellSize);
    if (light.environment) return rotate(*light.environment, rotation, map, width, height);

    Environment drawn{map, Image(width, height)};
    if (light.sun) {
        // ∫ L dω = √4π L_00.
        const Vec3d flux = light.lighting.coefficients[0] * (2.0 / std::numbers::inv_sqrtpi);
        addDisc(drawn, rotation * light.sun->direction, light.sun->halfAngleRadians, flux);
        return drawn;
    }
    const Lighting turned = rotate(light.lighting, rotation);
    if (map == SphereMap::latLong) return {map, reconstructLatLong(turned, width)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const SphereTexel texel = sphereTexel(map, width, height, x, y);
            if (texel.solidAngle > 0.0)
                drawn.radiance.at(x, y) = Vec3f(reconstruct(turned, texel.direction));
        }
    return drawn;
}

}  // namespace prt::cli

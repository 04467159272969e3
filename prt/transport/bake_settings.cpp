#include "prt/transport/bake_settings.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "prt/base/error.h"
#include "prt/base/fingerprint.h"
#include "prt/trace/ray_scene.h"

namespace prt {
namespace {

constexpr const char* kInfinite = "inf";

std::string fingerprintGeometry(const Scene& scene) {
    Fingerprint fingerprint;
    for (const Mesh& mesh : scene.meshes) {
        fingerprint.add(static_cast<std::uint64_t>(mesh.material));
        fingerprint.add(mesh.positions);
        fingerprint.add(mesh.normals);
        for (const std::vector<Vec2f>& uvSet : mesh.uvSets)
            fingerprint.add(uvSet);
        fingerprint.add(mesh.colors);
        fingerprint.add(mesh.indices);
    }
    return fingerprint.hex();
}

void addTexture(const std::optional<TextureUse>& texture, Fingerprint& fingerprint) {
    fingerprint.add(texture.has_value());
    if (!texture) return;
    fingerprint.add(static_cast<std::uint64_t>(texture->image));
    fingerprint.add(texture->uvSet);
    fingerprint.add(texture->wrapU);
    fingerprint.add(texture->wrapV);
    fingerprint.add(texture->filter);
}

/// What the bake reads of materials: names and emission change none of its bits.
std::string fingerprintMaterials(const Scene& scene, bool isGlossy) {
    Fingerprint fingerprint;
    for (const Material& material : scene.materials) {
        for (int channel = 0; channel < 4; ++channel)
            fingerprint.add(material.baseColorFactor[channel]);
        addTexture(material.baseColorTexture, fingerprint);
        fingerprint.add(material.alphaMode);
        fingerprint.add(material.alphaCutoff);
        fingerprint.add(material.doubleSided);
        if (!isGlossy) continue;
        fingerprint.add(material.metallicFactor);
        fingerprint.add(material.roughnessFactor);
        addTexture(material.metallicRoughnessTexture, fingerprint);
    }
    return fingerprint.hex();
}

std::string fingerprintTextures(const Scene& scene) {
    Fingerprint fingerprint;
    for (const TextureImage& image : scene.images) {
        fingerprint.add(image.pixels.width);
        fingerprint.add(image.pixels.height);
        fingerprint.add(image.pixels.pixels);
    }
    return fingerprint.hex();
}

template <class Number>
Number readNumber(std::span<const Setting> settings, std::string_view name) {
    const std::string& text = findSetting(settings, name);
    Number number = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc() || result.ptr != end)
        throw Error(ErrorCode::malformed, "has a setting that is no number: " + std::string(name));
    return number;
}

template <class Choice, class Parse>
Choice readChoice(std::span<const Setting> settings, std::string_view name, Parse parse) {
    const std::optional<Choice> choice = parse(findSetting(settings, name));
    if (!choice)
        throw Error(ErrorCode::malformed,
                    "has a setting that this program does not know: " + std::string(name));
    return *choice;
}

}  // namespace

std::vector<Setting> bakeSettings(const Scene& scene, const BakeOptions& options, Isa isa) {
    const bool infinite = options.bounceCount == kInfiniteBounces;
    std::vector<Setting> settings = {
        {"transport", std::string(transportName(options.transport))},
        {"bands", std::to_string(options.bandCount)},
        {"samples", std::to_string(options.sampleCount)},
        {"bounces", infinite ? kInfinite : std::to_string(options.bounceCount)},
        {"seed", std::to_string(options.seed)},
        {"isa", std::string(isaName(isa))},
        {"tracer", rayTracerName()},
    };
    if (isGlossy(options.transport))
        settings.push_back({"incident-bands", std::to_string(options.incidentBandCount)});
    const std::vector<Setting>& more = options.checkpoint.callerSettings;
    settings.insert(settings.end(), more.begin(), more.end());
    settings.push_back({"geometry", fingerprintGeometry(scene)});
    settings.push_back({"materials", fingerprintMaterials(scene, isGlossy(options.transport))});
    settings.push_back({"textures", fingerprintTextures(scene)});
    return settings;
}

void applyBakeSettings(std::span<const Setting> settings, BakeOptions& options) {
    options.transport = readChoice<Transport>(settings, "transport", parseTransport);
    options.bandCount = readNumber<int>(settings, "bands");
    if (isGlossy(options.transport))
        options.incidentBandCount = readNumber<int>(settings, "incident-bands");
    options.sampleCount = readNumber<int>(settings, "samples");
    options.bounceCount = findSetting(settings, "bounces") == kInfinite
                              ? kInfiniteBounces
                              : readNumber<int>(settings, "bounces");
    options.seed = readNumber<std::uint64_t>(settings, "seed");
    options.isa = readChoice<Isa>(settings, "isa", parseIsa);
}

const std::string& findSetting(std::span<const Setting> settings, std::string_view name) {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& setting) { return setting.name == name; });
    if (found == settings.end())
        throw Error(ErrorCode::malformed, "lacks a setting: " + std::string(name));
    return found->value;
}

}  // namespace prt

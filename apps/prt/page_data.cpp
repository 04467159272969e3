#include "apps/prt/page_data.h"

#include <Imath/half.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/page_template.h"
#include "prt/base/assert.h"
#include "prt/io/environment_io.h"

namespace prt::cli {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the page reads little endian");

/// Four digits for three bytes, the last ones padded by zeros and marked by "=" [RFC 4648, 4].
void appendBase64(std::string& text, std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < count; ++k)
            bits |= std::to_integer<std::uint32_t>(bytes[i + k]) << (16 - 8 * k);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[(bits >> (18 - 6 * k)) & 63] : '=';
    }
}

std::vector<std::uint16_t> convertToHalves(const Image& picture) {
    constexpr float kMaxHalf = 65504.0f;  // (2 - 2^-10) 2^15
    std::vector<std::uint16_t> halves;
    halves.reserve(3 * picture.pixels.size());
    for (const Vec3f& radiance : picture.pixels)
        for (int channel = 0; channel < 3; ++channel)
            halves.push_back(imath_float_to_half(std::clamp(radiance[channel], 0.0f, kMaxHalf)));
    return halves;
}

Json describe(const Vec3f& vector) {
    return {withDigitsOf(vector.x), withDigitsOf(vector.y), withDigitsOf(vector.z)};
}

Json describe(const Camera& camera) {
    constexpr float kDegrees = 180.0f / std::numbers::pi_v<float>;
    return {{"eye", describe(camera.eye)},
            {"forward", describe(camera.forward)},
            {"verticalFovDegrees", withDigitsOf(camera.verticalFovRadians * kDegrees)}};
}

/// JSON in which no text can end the script element around it.
std::string formatForScript(const Json& json) {
    std::string text;
    for (const char letter : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        if (letter == '<')
            text += "\\u003c";
        else
            text += letter;
    return text;
}

void appendBytes(std::string& page, const std::string& id, std::span<const std::byte> bytes) {
    page += fmt::format("<script type=\"text/plain\" id=\"{}\">", id);
    appendBase64(page, bytes);
    page += "</script>\n";
}

}  // namespace

std::string fillPage(std::string_view pageTemplate, std::span<const PageAsset> assets,
                     std::span<const PageLight> lights) {
    const std::size_t mark = pageTemplate.find(kPageDataMark);
    PRT_ASSERT(mark != std::string_view::npos, "the template has a place for assets and lights");
    std::string page(pageTemplate.substr(0, mark));

    Json data{{"assets", Json::array()}, {"lights", Json::array()}};
    for (const PageAsset& asset : assets)
        data["assets"].push_back({{"name", asset.name}, {"camera", describe(asset.camera)}});
    for (const PageLight& light : lights)
        data["lights"].push_back(
            {{"name", light.name},
             {"lighting", Json::parse(lightingToJson(light.lighting))},
             {"picture", {{"width", light.picture.width}, {"height", light.picture.height}}}});
    page += fmt::format("<script type=\"application/json\" id=\"prt-data\">{}</script>\n",
                        formatForScript(data));

    for (std::size_t i = 0; i < assets.size(); ++i)
        appendBytes(page, fmt::format("prt-asset-{}", i), assets[i].file);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::vector<std::uint16_t> halves = convertToHalves(lights[i].picture);
        appendBytes(page, fmt::format("prt-light-{}", i), std::as_bytes(std::span(halves)));
    }
    page += pageTemplate.substr(mark + kPageDataMark.size());
    return page;
}

std::vector<std::string> tellApart(std::vector<std::string> names) {
    for (auto name = names.begin(); name != names.end(); ++name) {
        const std::string own = *name;
        for (int number = 2; std::find(names.begin(), name, *name) != name; ++number)
            *name = fmt::format("{} {}", own, number);
    }
    return names;
}

}  // namespace prt::cli

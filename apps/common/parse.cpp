#include "apps/common/parse.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "prt/base/error.h"

namespace prt::cli {
namespace {

template <class Number>
std::optional<Number> parseWhole(std::string_view text) {
    Number number = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    return number;
}

std::optional<int> parsePixelCount(std::string_view text) {
    constexpr int kMaxSide = 16384;
    const std::optional<int> count = parseWhole<int>(text);
    return count && *count >= 1 && *count <= kMaxSide ? count : std::nullopt;
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
    const std::optional<double> number = parseWhole<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::uint64_t> parseWholeNumber(std::string_view text) {
    return parseWhole<std::uint64_t>(text);
}

std::optional<Vec3d> parseTriple(std::string_view text) {
    const std::size_t first = text.find(',');
    const std::size_t second = text.find(',', first == std::string_view::npos ? first : first + 1);
    if (second == std::string_view::npos) return std::nullopt;
    const auto x = parseNumber(text.substr(0, first));
    const auto y = parseNumber(text.substr(first + 1, second - first - 1));
    const auto z = parseNumber(text.substr(second + 1));
    if (!x || !y || !z) return std::nullopt;
    return Vec3d(*x, *y, *z);
}

std::optional<PictureSize> parsePictureSize(std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const std::optional<int> width = parsePixelCount(text.substr(0, cross));
    const std::optional<int> height = parsePixelCount(text.substr(cross + 1));
    if (!width || !height) return std::nullopt;
    return PictureSize{*width, *height};
}

std::optional<int> parseBounceCount(std::string_view text) {
    constexpr int kMaxBounceCount = 1000;
    if (text == "inf") return kEveryBounce;
    const std::optional<double> count = parseNumber(text);
    if (!count || *count < 0.0 || *count > kMaxBounceCount || *count != std::floor(*count))
        return std::nullopt;
    return static_cast<int>(*count);
}

Mat3d rotationFromDegrees(const Vec3d& degrees) {
    const Vec3d radians = degrees * (std::numbers::pi / 180.0);
    return rotationZ(radians.z) * rotationY(radians.y) * rotationX(radians.x);
}

Vec3d degreesFromRotation(const Mat3d& rotation) {
    constexpr double kLeastCosine = 1e-7;  // below it, x and z cannot be told apart
    const double cosine = std::hypot(rotation[0][0], rotation[1][0]);
    Vec3d radians(0.0, std::atan2(-rotation[2][0], cosine), 0.0);
    if (cosine > kLeastCosine) {
        radians.x = std::atan2(rotation[2][1], rotation[2][2]);
        radians.z = std::atan2(rotation[1][0], rotation[0][0]);
    } else {
        radians.x = std::atan2(-rotation[1][2], rotation[1][1]);
    }
    return radians * (180.0 / std::numbers::pi);
}

std::string lowerSuffix(const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    for (char& letter : suffix)
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return suffix;
}

void requireSuffix(const std::string& path, std::string_view suffixes) {
    const std::string suffix = lowerSuffix(path);
    const std::string padded = " " + std::string(suffixes) + " ";
    if (!suffix.empty() && padded.find(" " + suffix + " ") != std::string::npos) return;
    throw Error(ErrorCode::invalidOption, "does not end in " + std::string(suffixes), path,
                "the suffix chooses the file's format");
}

}  // namespace prt::cli

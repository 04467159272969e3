#include "apps/common/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace prt::cli {
namespace {

struct Scaled {
    std::string digits;  // three, or all of a whole number
    const char* prefix;
};

Scaled scaleByThousands(double quantity) {
    constexpr std::array<const char*, 5> kPrefixes = {"", "k", "M", "G", "T"};
    std::size_t prefix = 0;
    while (quantity >= 999.5 && prefix + 1 < kPrefixes.size()) {
        quantity /= 1000.0;
        ++prefix;
    }
    const bool isWhole = prefix == 0 && quantity == std::floor(quantity);
    const int decimals = isWhole || quantity >= 99.95 ? 0 : quantity >= 9.995 ? 1 : 2;
    return {fmt::format("{:.{}f}", quantity, decimals), kPrefixes[prefix]};
}

}  // namespace

std::string formatCount(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t fromRight = 3; fromRight < digits.size(); fromRight += 4)
        digits.insert(digits.size() - fromRight, 1, ',');
    return digits;
}

std::string formatCount(std::uint64_t count, std::string_view thing) {
    std::string text = formatCount(count) + " " + std::string(thing);
    if (count == 1) return text;
    if (text.ends_with("ex")) return text.replace(text.size() - 2, 2, "ices");
    return text + (text.ends_with("sh") ? "es" : "s");
}

std::string formatQuantity(double quantity, std::string_view unit) {
    const Scaled scaled = scaleByThousands(quantity);
    return scaled.digits + (*scaled.prefix ? " " : "") + scaled.prefix + " " + std::string(unit);
}

std::string formatBytes(std::uint64_t bytes) {
    const Scaled scaled = scaleByThousands(static_cast<double>(bytes));
    return scaled.digits + " " + scaled.prefix + "B";
}

std::string formatPercent(double part) {
    const double percent = 100.0 * part;
    return fmt::format("{:.{}f} %", percent, percent < 0.995 ? 2 : percent < 9.95 ? 1 : 0);
}

std::string formatDecibels(double decibels) {
    return std::isfinite(decibels) ? fmt::format("{:.1f} dB", decibels) : "equal";
}

std::string formatDuration(double seconds) {
    const auto whole = static_cast<std::uint64_t>(std::ceil(std::max(seconds, 0.0)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

double withDigitsOf(float number) {
    const std::string digits = fmt::format("{}", number);
    auto value = static_cast<double>(number);
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

}  // namespace prt::cli

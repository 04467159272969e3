#include "prt/brdf/view_angle.h"

#include <algorithm>
#include <numbers>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr double kLowestView = 1e-3;

}  // namespace

TablePlace placeBetween(float x, std::size_t count) {
    PRT_ASSERT(count >= 2, "there is something to be linear between");
    const float position = x * static_cast<float>(count - 1);
    const auto first = std::min(static_cast<std::size_t>(position), count - 2);
    return {first, position - static_cast<float>(first)};
}

TablePlace placeView(float cosine, std::size_t viewCount) {
    const float elevation = std::asin(std::clamp(cosine, 0.0f, 1.0f));
    const float rest = std::min(elevation * (2.0f * std::numbers::inv_pi_v<float>), 1.0f);
    return placeBetween(1.0f - std::sqrt(rest), viewCount);
}

Vec3d tableView(std::size_t index, std::size_t viewCount) {
    PRT_ASSERT(index < viewCount && viewCount >= 2, "the table has this view");
    const double rest = 1.0 - static_cast<double>(index) / static_cast<double>(viewCount - 1);
    const double z = std::max(kLowestView, std::sin(0.5 * std::numbers::pi * rest * rest));
    return {std::sqrt(1.0 - z * z), 0.0, z};
}

}  // namespace prt

#include "prt/brdf/gltf_view_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/brdf/brdf_matrix.h"

namespace prt {
namespace {

// Lobes are not defined at the horizon itself.
constexpr double kLowestView = 1e-3;

/// A place between two entries.
struct Between {
    std::size_t first = 0;
    float share = 0.0f;  ///< of the second
};

/// @param x  in [0, 1]
Between locate(float x, std::size_t count) {
    const float position = x * static_cast<float>(count - 1);
    const auto first = std::min(static_cast<std::size_t>(position), count - 2);
    return {first, position - static_cast<float>(first)};
}

/// Where a view stands among those of the table, from 0 along the normal to 1 at the horizon: even
/// in the angle at first, where coefficients go with its sine, and ever finer towards the horizon.
float viewPosition(float cosine) {
    const float angle = std::acos(std::clamp(cosine, 0.0f, 1.0f));
    return 1.0f - std::sqrt(std::max(0.0f, 1.0f - angle * (2.0f * std::numbers::inv_pi_v<float>)));
}

/// The other way.
Vec3d tableView(std::size_t index, std::size_t count) {
    const double rest = 1.0 - static_cast<double>(index) / static_cast<double>(count - 1);
    const double z = std::max(kLowestView, std::sin(0.5 * std::numbers::pi * rest * rest));
    return {std::sqrt(1.0 - z * z), 0.0, z};
}

}  // namespace

GltfViewTable::GltfViewTable(const GltfViewTableOptions& options)
    : bandCount_(options.bandCount),
      levelCount_(static_cast<std::size_t>(options.levelCount)),
      viewCount_(static_cast<std::size_t>(options.viewCount)),
      elementCount_(static_cast<std::size_t>(bandCount_ * (bandCount_ + 1) / 2)) {
    PRT_ASSERT(bandCount_ >= 1 && options.levelCount >= 2 && options.viewCount >= 2,
               "there is something to be linear between");
    elements_.reserve(levelCount_ * viewCount_ * elementCount_);
    for (std::size_t level = 0; level < levelCount_; ++level) {
        const double roughness = static_cast<double>(level) / static_cast<double>(levelCount_ - 1);
        // The three ride on three channels: the third is diffuse and dark.
        const Brdf brdf{
            .lobes = {LayeredLambertLobe{Vec3d(0.0, 0.0, 1.0)},
                      GgxLobe{.f0 = Vec3d(0.0, 1.0, 0.0), .alpha = roughness * roughness}}};
        for (std::size_t view = 0; view < viewCount_; ++view) {
            const Vec3d direction = tableView(view, viewCount_);
            const auto all = projectBrdfView(brdf, direction, bandCount_, options.quadrature);
            for (int l = 0; l < bandCount_; ++l)
                for (int m = 0; m <= l; ++m) {
                    const auto i = static_cast<std::size_t>(shIndex(l, m));
                    elements_.push_back({static_cast<float>(all[0][i]),
                                         static_cast<float>(all[1][i]),
                                         static_cast<float>(all[2][i] - all[0][i])});
                }
        }
    }
}

const GltfViewTable::Element* GltfViewTable::elementsAt(std::size_t level, std::size_t view) const {
    return &elements_[(level * viewCount_ + view) * elementCount_];
}

void GltfViewTable::addResponse(const Vec3f& baseColor, const MetallicRoughness& surface,
                                const Vec3f& view, std::span<float> response) const {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(response.size() == 3 * coefficientCount, "n² numbers a channel");
    const Between level = locate(std::clamp(surface.roughness, 0.0f, 1.0f), levelCount_);
    const Between angle = locate(viewPosition(view.z), viewCount_);
    const std::array<const Element*, 4> corners = {
        elementsAt(level.first, angle.first), elementsAt(level.first, angle.first + 1),
        elementsAt(level.first + 1, angle.first), elementsAt(level.first + 1, angle.first + 1)};
    const std::array<float, 4> weights = {
        (1.0f - level.share) * (1.0f - angle.share), (1.0f - level.share) * angle.share,
        level.share * (1.0f - angle.share), level.share * angle.share};

    // Turn by the view's azimuth φ: (l, m) and (l, −m) take cos mφ and sin mφ of (l, m).
    const GltfLobes lobes = splitGltfMaterial(baseColor, surface);
    const float radius = std::hypot(view.x, view.y);
    const float stepCosine = radius > 0.0f ? view.x / radius : 1.0f;
    const float stepSine = radius > 0.0f ? view.y / radius : 0.0f;
    float cosine = 1.0f;
    float sine = 0.0f;
    for (int m = 0; m < bandCount_; ++m) {
        for (int l = m; l < bandCount_; ++l) {
            const auto index = static_cast<std::size_t>(l * (l + 1) / 2 + m);
            Element element;
            for (std::size_t k = 0; k < 4; ++k) {
                element.dark += weights[k] * corners[k][index].dark;
                element.bright += weights[k] * corners[k][index].bright;
                element.diffuse += weights[k] * corners[k][index].diffuse;
            }
            for (int channel = 0; channel < 3; ++channel) {
                const auto f0 = static_cast<float>(lobes.specular.f0[channel]);
                const float value =
                    element.dark + f0 * (element.bright - element.dark) +
                    static_cast<float>(lobes.diffuse.albedo[channel]) * element.diffuse;
                float* const out =
                    response.data() + static_cast<std::size_t>(channel) * coefficientCount;
                out[shIndex(l, m)] += value * cosine;
                if (m > 0) out[shIndex(l, -m)] += value * sine;
            }
        }
        const float nextCosine = cosine * stepCosine - sine * stepSine;
        sine = cosine * stepSine + sine * stepCosine;
        cosine = nextCosine;
    }
}

}  // namespace prt

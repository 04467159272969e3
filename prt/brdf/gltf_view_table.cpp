#include "prt/brdf/gltf_view_table.h"

#include <algorithm>
#include <array>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/view_angle.h"

namespace prt {
GltfViewTable::GltfViewTable(const GltfViewTableOptions& options)
    : bandCount_(options.bandCount),
      levelCount_(static_cast<std::size_t>(options.levelCount)),
      viewCount_(static_cast<std::size_t>(options.viewCount)),
      elementCount_(uprightCount(bandCount_)) {
    PRT_ASSERT(bandCount_ >= 1 && options.levelCount >= 2 && options.viewCount >= 2,
               "there is something to be linear between");
    const HorizonFit fit(bandCount_, options.horizonWeight);
    const auto project = [&](const BrdfLobe& lobe, std::size_t view) {
        auto channels = projectUprightView({.lobes = {lobe}}, tableView(view, viewCount_),
                                           bandCount_, options.quadrature);
        for (std::vector<double>& coefficients : channels)
            fit.apply(coefficients);
        return channels;
    };
    std::vector<std::vector<double>> diffuse;  // one a view
    for (std::size_t view = 0; view < viewCount_; ++view)
        diffuse.push_back(project(LayeredLambertLobe{Vec3d(1.0)}, view)[0]);
    elements_.reserve(levelCount_ * viewCount_ * elementCount_);
    for (std::size_t level = 0; level < levelCount_; ++level) {
        const double roughness = static_cast<double>(level) / static_cast<double>(levelCount_ - 1);
        for (std::size_t view = 0; view < viewCount_; ++view) {
            // The two ride on two channels.
            const auto [dark, bright, unused] =
                project(GgxLobe{.f0 = Vec3d(0.0, 1.0, 0.0), .alpha = roughness * roughness}, view);
            for (int l = 0; l < bandCount_; ++l)
                for (int m = 0; m <= l; ++m) {
                    const auto i = static_cast<std::size_t>(shIndex(l, m));
                    elements_.push_back({static_cast<float>(dark[i]), static_cast<float>(bright[i]),
                                         static_cast<float>(diffuse[view][i])});
                }
        }
    }
}

std::span<const GltfViewTable::Element> GltfViewTable::row(std::size_t level,
                                                           std::size_t view) const {
    PRT_ASSERT(level < levelCount_ && view < viewCount_, "the table has this level and view");
    return std::span(elements_).subspan((level * viewCount_ + view) * elementCount_, elementCount_);
}

void GltfViewTable::addResponse(const Vec3f& baseColor, const MetallicRoughness& surface,
                                const Vec3f& view, std::span<float> response) const {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(response.size() == 3 * coefficientCount, "n² numbers a channel");
    const TablePlace level = placeBetween(std::clamp(surface.roughness, 0.0f, 1.0f), levelCount_);
    const TablePlace angle = placeView(view.z, viewCount_);
    const std::array<std::span<const Element>, 4> corners = {
        row(level.first, angle.first), row(level.first, angle.first + 1),
        row(level.first + 1, angle.first), row(level.first + 1, angle.first + 1)};
    const std::array<float, 4> weights = {
        (1.0f - level.share) * (1.0f - angle.share), (1.0f - level.share) * angle.share,
        level.share * (1.0f - angle.share), level.share * angle.share};

    const GltfLobes lobes = splitGltfMaterial(baseColor, surface);
    visitTurned(view, bandCount_, [&](int l, int m, float cosine, float sine) {
        const std::size_t index = uprightIndex(l, m);
        Element element;
        for (std::size_t k = 0; k < 4; ++k) {
            element.dark += weights[k] * corners[k][index].dark;
            element.bright += weights[k] * corners[k][index].bright;
            element.diffuse += weights[k] * corners[k][index].diffuse;
        }
        for (int channel = 0; channel < 3; ++channel) {
            const auto f0 = static_cast<float>(lobes.specular.f0[channel]);
            const float value = element.dark + f0 * (element.bright - element.dark) +
                                static_cast<float>(lobes.diffuse.albedo[channel]) * element.diffuse;
            float* const out =
                response.data() + static_cast<std::size_t>(channel) * coefficientCount;
            out[shIndex(l, m)] += value * cosine;
            if (m > 0) out[shIndex(l, -m)] += value * sine;
        }
    });
}

}  // namespace prt

#include "prt/brdf/specular_albedo.h"

#include <algorithm>

#include "prt/base/assert.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/view_angle.h"

namespace prt {

SpecularAlbedoTable::SpecularAlbedoTable(const SpecularAlbedoOptions& options)
    : levelCount_(static_cast<std::size_t>(options.levelCount)),
      viewCount_(static_cast<std::size_t>(options.viewCount)) {
    constexpr double kPerY0 = 3.5449077018110321;  // 1/y_00 = sqrt(4 pi)
    PRT_ASSERT(options.levelCount >= 2 && options.viewCount >= 2,
               "there is something to be linear between");
    for (std::size_t level = 0; level < levelCount_; ++level) {
        const double roughness = static_cast<double>(level) / static_cast<double>(levelCount_ - 1);
        // The two ride on two channels.
        const Brdf brdf{
            .lobes = {GgxLobe{.f0 = Vec3d(0.0, 1.0, 0.0), .alpha = roughness * roughness}}};
        for (std::size_t view = 0; view < viewCount_; ++view) {
            const auto both =
                projectUprightView(brdf, tableView(view, viewCount_), 1, options.quadrature);
            entries_.push_back(
                {static_cast<float>(kPerY0 * both[0][0]), static_cast<float>(kPerY0 * both[1][0])});
        }
    }
}

Vec3f SpecularAlbedoTable::evaluate(const Vec3f& f0, float roughness, float cosine) const {
    const TablePlace level = placeBetween(std::clamp(roughness, 0.0f, 1.0f), levelCount_);
    const TablePlace view = placeView(cosine, viewCount_);
    const Entry* smooth = &entries_[level.first * viewCount_ + view.first];
    const Entry* rough = smooth + viewCount_;
    const auto blend = [&](float Entry::*member) {
        const float low = smooth[0].*member * (1.0f - view.share) + smooth[1].*member * view.share;
        const float high = rough[0].*member * (1.0f - view.share) + rough[1].*member * view.share;
        return low * (1.0f - level.share) + high * level.share;
    };
    const float dark = blend(&Entry::dark);
    return Vec3f(dark) + f0 * (blend(&Entry::bright) - dark);
}

}  // namespace prt

#include "prt/brdf/brdf_view_table.h"

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/view_angle.h"

namespace prt {

BrdfViewTable::BrdfViewTable(const Brdf& brdf, const BrdfViewTableOptions& options)
    : bandCount_(options.bandCount), viewCount_(static_cast<std::size_t>(options.viewCount)) {
    PRT_ASSERT(bandCount_ >= 1 && options.viewCount >= 2,
               "there is something to be linear between");
    const HorizonFit fit(bandCount_, options.horizonWeight);
    rows_.reserve(viewCount_ * 3 * uprightCount(bandCount_));
    for (std::size_t view = 0; view < viewCount_; ++view) {
        auto all =
            projectUprightView(brdf, tableView(view, viewCount_), bandCount_, options.quadrature);
        for (std::vector<double>& coefficients : all) {
            fit.apply(coefficients);
            for (int l = 0; l < bandCount_; ++l)
                for (int m = 0; m <= l; ++m)
                    rows_.push_back(
                        static_cast<float>(coefficients[static_cast<std::size_t>(shIndex(l, m))]));
        }
    }
}

std::span<const float> BrdfViewTable::row(std::size_t view) const {
    PRT_ASSERT(view < viewCount_, "the table has this view");
    const std::size_t rowSize = 3 * uprightCount(bandCount_);
    return std::span(rows_).subspan(view * rowSize, rowSize);
}

void BrdfViewTable::addResponse(const Vec3f& view, std::span<float> response) const {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(response.size() == 3 * coefficientCount, "n² numbers a channel");
    const TablePlace angle = placeView(view.z, viewCount_);
    const std::span<const float> above = row(angle.first);
    const std::span<const float> below = row(angle.first + 1);
    visitTurned(view, bandCount_, [&](int l, int m, float cosine, float sine) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const std::size_t index = channel * uprightCount(bandCount_) + uprightIndex(l, m);
            const float value = above[index] + (below[index] - above[index]) * angle.share;
            float* const out = response.data() + channel * coefficientCount;
            out[shIndex(l, m)] += value * cosine;
            if (m > 0) out[shIndex(l, -m)] += value * sine;
        }
    });
}

}  // namespace prt

#include "apps/prt/lobe_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/horizon_fit.h"

namespace prt::cli {
namespace {

constexpr int kDiscSize = 384;
constexpr int kMargin = 16;
constexpr float kBackground = 0.2f;

/// Calls visit(pixel of the left disc, ω_i) for the pixels of a disc.
template <class Visit>
void visitDisc(const Visit& visit) {
    for (int y = 0; y < kDiscSize; ++y)
        for (int x = 0; x < kDiscSize; ++x) {
            const double u = (2.0 * x + 1.0) / kDiscSize - 1.0;
            const double v = 1.0 - (2.0 * y + 1.0) / kDiscSize;
            const double rest = 1.0 - u * u - v * v;
            if (rest > 0.0) visit(kMargin + x, kMargin + y, Vec3d(u, v, std::sqrt(rest)));
        }
}

}  // namespace

Image drawLobe(const Brdf& brdf, int bandCount) {
    const Vec3d view = Vec3d(1.0, 0.0, 1.0).normalized();
    auto coefficients = projectBrdfView(brdf, view, bandCount);
    const HorizonFit fit(bandCount);
    for (std::vector<double>& channel : coefficients)
        fit.apply(channel);

    Image image(2 * kDiscSize + 3 * kMargin, kDiscSize + 2 * kMargin);
    std::fill(image.pixels.begin(), image.pixels.end(), Vec3f(kBackground));
    double largest = 0.0;
    visitDisc([&](int, int, const Vec3d& incident) {
        const Vec3d g = evaluateBrdf(brdf, incident, view) * incident.z;
        largest = std::max({largest, g.x, g.y, g.z});
    });
    const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
    visitDisc([&](int x, int y, const Vec3d& incident) {
        image.at(x, y) = Vec3f(evaluateBrdf(brdf, incident, view) * (incident.z * scale));
        Vec3d held;
        for (int channel = 0; channel < 3; ++channel)
            held[channel] =
                std::max(0.0, scale * reconstructSh(coefficients[static_cast<std::size_t>(channel)],
                                                    bandCount, incident));
        image.at(x + kDiscSize + kMargin, y) = Vec3f(held);
    });
    return image;
}

}  // namespace prt::cli

// Bibliography
//   [Rusinkiewicz98]  A new change of variables for efficient BRDF representation
#include "prt/brdf/tabulate_brdf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "prt/brdf/microfacets.h"

namespace prt {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// ω_i of a half vector at azimuth 0 and of difference angles, which are seen from it
/// [Rusinkiewicz98].
Vec3d incidentAt(const Vec3d& half, double thetaDifference, double phiDifference) {
    const double along = std::sin(thetaDifference) * std::cos(phiDifference);
    const double across = std::sin(thetaDifference) * std::sin(phiDifference);
    return half * std::cos(thetaDifference) + Vec3d(half.z * along, across, -half.x * along);
}

}  // namespace

MeasuredBrdf tabulateBrdf(const Brdf& brdf) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    std::vector<float> values(3 * MeasuredBrdf::kCellCount, 0.0f);
    for (std::size_t cell = 0; cell < MeasuredBrdf::kCellCount; ++cell) {
        const std::size_t row = cell / MeasuredBrdf::kAzimuthCount;
        const auto middleOf = [](std::size_t step) { return static_cast<double>(step) + 0.5; };
        const double thetaHalf =
            MeasuredBrdf::halfAngleAt(middleOf(row / MeasuredBrdf::kDifferenceAngleCount));
        const Vec3d half(std::sin(thetaHalf), 0.0, std::cos(thetaHalf));
        const Vec3d incident =
            incidentAt(half, kDegree * middleOf(row % MeasuredBrdf::kDifferenceAngleCount),
                       kDegree * middleOf(cell % MeasuredBrdf::kAzimuthCount));
        const Vec3d view = mirrorAbout(half, incident);
        if (incident.z <= 0.0 || view.z <= 0.0) continue;
        const Vec3d value = evaluateBrdf(brdf, incident, view);
        for (std::size_t channel = 0; channel < 3; ++channel)
            values[channel * MeasuredBrdf::kCellCount + cell] =
                static_cast<float>(std::min(value[static_cast<int>(channel)], kLargest));
    }
    return MeasuredBrdf(std::move(values));
}

}  // namespace prt

#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/brdf/measured_brdf.h"

namespace prt::test {

/// The table that measuring a BRDF at the middle of each cell would give, [channel][θ_h][θ_d][φ_d].
///
/// @param brdf  f_r(ω_i, ω_o), RGB; asked only where both are above the horizon
template <class Evaluate>
std::vector<float> measureTable(const Evaluate& brdf) {
    constexpr std::size_t kHalf = MeasuredBrdf::kHalfAngleCount,
                          kDifference = MeasuredBrdf::kDifferenceAngleCount,
                          kAzimuth = MeasuredBrdf::kAzimuthCount;
    constexpr double kDegree = std::numbers::pi / 180.0;
    std::vector<float> table(3 * MeasuredBrdf::kCellCount, 0.0f);
    for (std::size_t i = 0; i < kHalf; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kHalf);
        const double thetaHalf = 90.0 * kDegree * share * share;
        const Vec3d half(std::sin(thetaHalf), 0.0, std::cos(thetaHalf));
        for (std::size_t j = 0; j < kDifference; ++j)
            for (std::size_t k = 0; k < kAzimuth; ++k) {
                // ω_i about +z, then turned by θ_h about y, as the half vector is.
                const double theta = (static_cast<double>(j) + 0.5) * kDegree;
                const double phi = (static_cast<double>(k) + 0.5) * kDegree;
                const double x = std::sin(theta) * std::cos(phi), z = std::cos(theta);
                const Vec3d incident(half.z * x + half.x * z, std::sin(theta) * std::sin(phi),
                                     half.z * z - half.x * x);
                const Vec3d view = half * (2.0 * half.dot(incident)) - incident;
                if (incident.z <= 0.0 || view.z <= 0.0) continue;
                const Vec3d value = brdf(incident, view);
                for (std::size_t channel = 0; channel < 3; ++channel)
                    table[((channel * kHalf + i) * kDifference + j) * kAzimuth + k] =
                        static_cast<float>(value[static_cast<int>(channel)]);
            }
    }
    return table;
}

}  // namespace prt::test

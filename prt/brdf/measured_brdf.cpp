// Bibliography
//   [Matusik03]       A data-driven reflectance model
//   [Rusinkiewicz98]  A new change of variables for efficient BRDF representation
#include "prt/brdf/measured_brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/brdf/microfacets.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

/// Half the samples follow the cosine.
constexpr double kCosineShare = 0.5;

std::size_t stepOf(double position, std::size_t count) {
    return std::min(static_cast<std::size_t>(std::max(position, 0.0)), count - 1);
}

std::size_t halfAngleStep(const Vec3d& half) {
    const double thetaHalf = std::atan2(std::hypot(half.x, half.y), half.z);
    const auto count = static_cast<double>(MeasuredBrdf::kHalfAngleCount);
    return stepOf(count * std::sqrt(thetaHalf / (0.5 * kPi)), MeasuredBrdf::kHalfAngleCount);
}

/// The solid angle of directions from θ₀ to θ₁ off the normal, without the cancellation that the
/// difference of cosines has near it.
double bandSolidAngle(double theta0, double theta1) {
    return 4.0 * kPi * std::sin(0.5 * (theta0 + theta1)) * std::sin(0.5 * (theta1 - theta0));
}

std::size_t cellOf(const Vec3d& incident, const Vec3d& half) {
    const double radius = std::hypot(half.x, half.y);
    const double cosPhi = radius > 0.0 ? half.x / radius : 1.0;
    const double sinPhi = radius > 0.0 ? half.y / radius : 0.0;
    // ω_i in the frame in which the half vector is the pole.
    const double x = half.z * (cosPhi * incident.x + sinPhi * incident.y) - radius * incident.z;
    const double y = cosPhi * incident.y - sinPhi * incident.x;
    const double thetaDifference = std::atan2(std::hypot(x, y), incident.dot(half));
    double phiDifference = std::atan2(y, x);
    if (phiDifference < 0.0) phiDifference += kPi;
    const std::size_t row =
        halfAngleStep(half) * MeasuredBrdf::kDifferenceAngleCount +
        stepOf(thetaDifference * 180.0 / kPi, MeasuredBrdf::kDifferenceAngleCount);
    return row * MeasuredBrdf::kAzimuthCount +
           stepOf(phiDifference * 180.0 / kPi, MeasuredBrdf::kAzimuthCount);
}

}  // namespace

MeasuredBrdf::MeasuredBrdf(std::vector<float> values) : values_(std::move(values)) {
    PRT_ASSERT(values_.size() == 3 * kCellCount, "there is a value a cell and channel");
    // Half vectors are worth the mean of the table over θ_d and φ_d, which weigh the cos θ_d that
    // mirroring spreads directions by, times the cosine.
    std::vector<double> weights(kHalfAngleCount, 0.0);
    constexpr std::size_t kStepCells = kDifferenceAngleCount * kAzimuthCount;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const std::size_t cell = i % kCellCount;
        const auto thetaDifference = static_cast<double>(cell % kStepCells / kAzimuthCount) + 0.5;
        weights[cell / kStepCells] +=
            static_cast<double>(values_[i]) * std::cos(thetaDifference * kPi / 180.0);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < kHalfAngleCount; ++i) {
        const auto step = static_cast<double>(i);
        weights[i] *= std::cos(halfAngleAt(step + 0.5)) *
                      bandSolidAngle(halfAngleAt(step), halfAngleAt(step + 1.0));
        sum += weights[i];
    }
    // A black table is drawn as a mirror of the view.
    if (sum <= 0.0) weights[0] = sum = 1.0;
    halfAngleSums_.assign(1, 0.0);
    for (std::size_t i = 0; i < kHalfAngleCount; ++i) {
        const auto step = static_cast<double>(i);
        const double probability = weights[i] / sum;
        halfAngleSums_.push_back(halfAngleSums_.back() + probability);
        halfAngleDensities_.push_back(probability /
                                      bandSolidAngle(halfAngleAt(step), halfAngleAt(step + 1.0)));
    }
}

double MeasuredBrdf::halfAngleAt(double i) {
    const double share = i / static_cast<double>(kHalfAngleCount);
    return 0.5 * kPi * share * share;
}

Vec3d MeasuredBrdf::evaluate(const Vec3d& incident, const Vec3d& view) const {
    const std::size_t cell = cellOf(incident, halfVector(incident, view));
    return Vec3d(Vec3f(values_[cell], values_[kCellCount + cell], values_[2 * kCellCount + cell]));
}

Vec3d MeasuredBrdf::sample(const Vec3d& view, double u, double v) const {
    const double phi = 2.0 * kPi * v;
    if (u < kCosineShare) {
        const double sinSquared = u / kCosineShare;
        const double radius = std::sqrt(sinSquared);
        return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0 - sinSquared)};
    }
    // Find the step of θ_h, and spread what is left of u evenly over its solid angle.
    const double share = (u - kCosineShare) / (1.0 - kCosineShare) * halfAngleSums_.back();
    const auto above = std::upper_bound(halfAngleSums_.begin() + 1, halfAngleSums_.end(), share);
    const auto step =
        std::min(static_cast<std::size_t>(above - halfAngleSums_.begin() - 1), kHalfAngleCount - 1);
    const double probability = halfAngleSums_[step + 1] - halfAngleSums_[step];
    const double within = probability > 0.0
                              ? std::clamp((share - halfAngleSums_[step]) / probability, 0.0, 1.0)
                              : 0.0;
    // sin²(θ_h / 2) is linear in solid angle.
    const double low = std::sin(0.5 * halfAngleAt(static_cast<double>(step)));
    const double high = std::sin(0.5 * halfAngleAt(static_cast<double>(step) + 1.0));
    const double haversine = std::lerp(low * low, high * high, within);
    const double radius = 2.0 * std::sqrt(haversine * (1.0 - haversine));
    return mirrorAbout({radius * std::cos(phi), radius * std::sin(phi), 1.0 - 2.0 * haversine},
                       view);
}

double MeasuredBrdf::density(const Vec3d& incident, const Vec3d& view) const {
    const double byCosine = std::max(incident.z, 0.0) * std::numbers::inv_pi;
    const Vec3d half = halfVector(incident, view);
    const double cosDifference = half.dot(view);
    if (half.z <= 0.0 || cosDifference <= 0.0) return kCosineShare * byCosine;
    const double byTable = halfAngleDensities_[halfAngleStep(half)] / (4.0 * cosDifference);
    return kCosineShare * byCosine + (1.0 - kCosineShare) * byTable;
}

}  // namespace prt

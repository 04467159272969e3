#pragma once

#include <cstddef>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// An isotropic BRDF measured in steps of the half angle and the difference angle [Matusik03;
/// Rusinkiewicz98]: 90 of θ_h, which grow as the square (θ_h = 90° (i/90)²), 90 of 1° of θ_d and
/// 180 of 1° of φ_d, which by reciprocity ends at 180°.
///
/// Constant within each cell, as the program that comes with the database reads it.
class MeasuredBrdf {
  public:
    static constexpr std::size_t kHalfAngleCount = 90;
    static constexpr std::size_t kDifferenceAngleCount = 90;
    static constexpr std::size_t kAzimuthCount = 180;
    static constexpr std::size_t kCellCount =
        kHalfAngleCount * kDifferenceAngleCount * kAzimuthCount;

    /// @param values  [channel][θ_h][θ_d][φ_d], per steradian: 3 kCellCount numbers, each finite
    ///                and not negative
    explicit MeasuredBrdf(std::vector<float> values);

    const std::vector<float>& values() const { return values_; }

    /// f_r(ω_i, ω_o); both unit, local frame, above the horizon.
    Vec3d evaluate(const Vec3d& incident, const Vec3d& view) const;

    /// Draws ω_i: half of them by the cosine, half by the mean of the table over each step of θ_h.
    ///
    /// @param u, v  in [0, 1)
    Vec3d sample(const Vec3d& view, double u, double v) const;

    /// Its density per steradian.
    double density(const Vec3d& incident, const Vec3d& view) const;

    /// Where step i of θ_h begins, in radians: i = kHalfAngleCount is 90°.
    static double halfAngleAt(double i);

  private:
    std::vector<float> values_;
    std::vector<double> halfAngleSums_;       // probability of the steps before each one
    std::vector<double> halfAngleDensities_;  // of half vectors in a step, per steradian
};

}  // namespace prt

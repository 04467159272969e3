#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// A zonal function about an axis of its own.
struct ZonalLobe {
    Vec3d axis{0.0, 0.0, 1.0};  ///< unit
    std::vector<double> zonal;  ///< n coefficients, one a band; the second is not negative
};

struct ZonalFitOptions {
    int lobeCount = 1;
    int startCount = 32;  ///< searches from axes at random, for each count of lobes
    std::uint64_t seed = 1;
};

struct ZonalFit {
    std::vector<ZonalLobe> lobes;
    double relativeError = 0.0;  ///< ‖c − Σ lobes‖ / ‖c‖; 0 where c is 0
};

/// Sums lobes, each turned to its axis (rotateZonal).
///
/// @param coefficients  n² numbers, written
void expandZonalLobes(std::span<const ZonalLobe> lobes, std::span<double> coefficients);

/// Approximates a function by a few zonal lobes, so that it can be rotated for next to nothing:
/// minimises the squared error over axes and zonal coefficients [Sloan05].
///
/// For given axes the coefficients follow band by band from k linear equations with the matrix
/// P_l(a_i·a_j); the axes by Levenberg and Marquardt's method, from the best fit with a lobe less
/// and the direction that takes most of what it leaves, and from axes at random. So a lobe more is
/// never worse, and the same input and seed give the same bits (C10). A sum of lobes comes back to
/// rounding where a search ends in the right valley: with up to three lobes at random of 4 to 10
/// bands all did, with four of 5 bands two thirds.
///
/// The mean is always exact; so is the first degree from three lobes on, unless their axes lie in a
/// plane.
///
/// @param coefficients  n² numbers
ZonalFit fitZonalLobes(std::span<const double> coefficients, const ZonalFitOptions& options = {});

}  // namespace prt

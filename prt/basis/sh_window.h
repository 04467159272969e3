#pragma once

#include <span>
#include <vector>

namespace prt {

/// Factors by which the bands of a signal are lowered against ringing [Sloan08].
enum class ShWindow {
    none,     ///< 1
    hann,     ///< ½ (1 + cos(π l/n))
    lanczos,  ///< sin(π l/n) / (π l/n)
};

/// One factor a band; the first is always 1.
std::vector<double> windowFactors(ShWindow window, int bandCount);

/// The Laplacian window 1 / (1 + λ l²(l+1)²), which minimises squared error plus λ times squared
/// curvature [Sloan08].
std::vector<double> laplacianFactors(double lambda, int bandCount);

/// A function at one point after the Laplacian window, Σ_l b_l / (1 + λ l²(l+1)²).
///
/// @param bands  b_l, what each band of the function adds at that point
double smoothAtPoint(std::span<const double> bands, double lambda);

/// The first λ, going up, under which a function is not negative at one point. It may be negative
/// again above: the window is no average with positive weights.
///
/// Looks in steps of an eighth, so that it passes over nothing but a touch.
///
/// @param bands  b_l; where the first, the mean of the function, is not positive, no λ is enough
/// @param from   λ in [0, 1e300] to start from, returned if it is enough
/// @return       at most 1e300, which leaves nothing but the mean
double findLeastLambda(std::span<const double> bands, double from);

}  // namespace prt

#pragma once

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

}  // namespace prt

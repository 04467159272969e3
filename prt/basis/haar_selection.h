#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// One entry of a sparse vector of red, green and blue coefficients.
struct SparseCoefficient {
    std::uint32_t index = 0;
    Vec3f value{0.0f, 0.0f, 0.0f};
};

/// Keeps the N coefficients that matter most: a non-linear approximation [Ng03]. How much one
/// matters is the same for its three channels, so that hue holds:
///
///   w_i² (r_i² + g_i² + b_i²)
///
/// Without weights, w = 1, this is the approximation of least squared error in an orthonormal
/// basis. Ng's other choices are the areas of the functions (haarAreas), which favours the coarse
/// ones that smooth transport responds to, and the transport itself: w_i² = Σ_x T_i(x)² over all
/// receivers.
///
/// @param coefficients  finite
/// @param count         N
/// @param weights       w_i ≥ 0, one a coefficient; or none, which are all 1
/// @return              N entries by ascending index, fewer if fewer are not 0; of equals the ones
///                      of smaller index
std::vector<SparseCoefficient> selectLargest(std::span<const Vec3f> coefficients, std::size_t count,
                                             std::span<const float> weights = {});

/// The area of the square in which each Haar function is not 0, 4^−l of the whole: weights for
/// selectLargest.
///
/// @param side         S, a power of two
/// @param squareCount  how many times to repeat the S² areas: 6 for a cube
std::vector<float> haarAreas(int side, int squareCount);

/// The relative error ‖f − f_N‖ / ‖f‖ that selectLargest leaves for each of several N, from one
/// sort: in an orthonormal basis the root of the squares left out over the sum of all squares.
///
/// @param counts  in any order
/// @return        one error a count, falling to exactly 0 with rising N; all 0 if f is 0
std::vector<double> selectionErrors(std::span<const Vec3f> coefficients,
                                    std::span<const std::size_t> counts,
                                    std::span<const float> weights = {});

}  // namespace prt

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// Weights of the errors of transfer that make them the errors which are seen under a light: what
/// is seen is Σ_i T_i L_i, not T.
///
/// Of the light, only how its energy is spread over the bands is taken: for an error e of one
/// transfer vector, and the light turned at random,
///
///   mean of (Σ_i e_i L_i)²  =  Σ_i w_i² e_i²,   w_i² = Σ_m L_lm² / (2l + 1),  l the degree of i
///
/// so the weighted squared error is the expected squared error of the radiance. Of three channels,
/// each has the weights of its own light; one channel has the mean of their squares.
///
/// Weights less than 10⁻³ of the largest become that, so that bands without light keep a shape.
///
/// @param light         n² coefficients or fewer bands, not all 0
/// @param bandCount     n of the transfer, n ≥ 1
/// @param channelCount  of the transfer, 1 or 3
/// @return              [channel][coefficient]
std::vector<float> lightErrorWeights(std::span<const Vec3d> light, int bandCount, int channelCount);

/// The same for the rows of a layer, whose length tells the bands; none without light, as VectorSet
/// has errors that all weigh alike.
///
/// Of matrices, M_ij has the weight of j, so that the weighted squared error is that of the
/// incident radiance, Σ_i l_i².
///
/// @param incidentBandCount  as that of a TransferLayer: 0 of vectors
/// @return                   [channel][coefficient], or [channel][i][j]
std::vector<float> weighRows(std::span<const Vec3d> light, std::size_t rowLength, int channelCount,
                             int incidentBandCount);

}  // namespace prt

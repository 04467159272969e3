#pragma once

#include <array>
#include <span>
#include <vector>

#include "prt/brdf/lobe_quadrature.h"

namespace prt {

/// A BRDF between spherical harmonics, one channel:
///
///   B_ij = ∫∫ f_r(ω_i, ω_o) max(cos θ_i, 0) y_i(ω_i) y_j(ω_o) dω_i dω_o               [Kautz02]
///
/// over both upper hemispheres, local frame, so that Σ_ij L_i B_ij y_j(ω_o) is what incident
/// radiance L reflects towards ω_o (C12). Isotropy and mirror symmetry leave only elements of equal
/// m, the same for m and −m: of 25 × 25 there are 55 different ones, which stand here.
struct BrdfMatrix {
    int incidentBandCount = 0;  ///< n_in
    int viewBandCount = 0;      ///< n_out
    /// m = 0, 1, … one block after the other; each has a row of n_out − m for each of n_in − m
    /// degrees from m.
    std::vector<double> values;
};

/// A matrix of zeros.
BrdfMatrix makeBrdfMatrix(int incidentBandCount, int viewBandCount);

/// Where the element of two degrees and |m| stands, |m| ≤ both.
std::size_t brdfMatrixIndex(const BrdfMatrix& matrix, int incidentDegree, int viewDegree, int m);

/// All elements, [incident][view]: n_in² rows of n_out² numbers.
std::vector<double> expandBrdfMatrix(const BrdfMatrix& matrix);

/// a + (b − a) · share, of matrices of the same size.
BrdfMatrix lerpBrdfMatrices(const BrdfMatrix& a, const BrdfMatrix& b, double share);

/// The coefficients over views of what is reflected, Σ_i L_i B_ij.
///
/// @param incident  n_in² numbers
/// @param exit      n_out² numbers, written
void applyBrdfMatrix(const BrdfMatrix& matrix, std::span<const double> incident,
                     std::span<double> exit);

/// Adds what the views about one angle to the normal contribute to the integral.
///
/// @param perView  f_i of the node's view, n_in² numbers (projectBrdfView)
void addBrdfView(const ViewNode& node, std::span<const double> perView, BrdfMatrix& matrix);

struct BrdfProjectionOptions {
    int incidentBandCount = 5;
    int viewBandCount = 5;
    LobeQuadratureOptions quadrature = {};
};

/// The matrix of each channel. Of a measured BRDF that is not mirror symmetric this is the mean of
/// itself and its mirror image.
std::array<BrdfMatrix, 3> projectBrdf(const Brdf& brdf, const BrdfProjectionOptions& options = {});

/// The same for one view, without bands there: f_i = ∫ f_r(ω_i, ω_o) max(cos θ_i, 0) y_i(ω_i) dω_i,
/// so that Σ_i L_i f_i is what is reflected [Kautz02].
///
/// @param view  ω_o, unit, above the horizon
/// @return      n² numbers for each channel
std::array<std::vector<double>, 3> projectBrdfView(const Brdf& brdf, const Vec3d& view,
                                                   int bandCount,
                                                   const LobeQuadratureOptions& options = {});

/// The same in half the time for a view at azimuth 0, where coefficients of m < 0 vanish. Of a
/// measured BRDF that is not mirror symmetric this is the mean of itself and its mirror image.
std::array<std::vector<double>, 3> projectUprightView(const Brdf& brdf, const Vec3d& view,
                                                      int bandCount,
                                                      const LobeQuadratureOptions& options = {});

}  // namespace prt

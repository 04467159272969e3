#pragma once

#include <span>

#include "prt/image/image.h"
#include "prt/light/lighting.h"

namespace prt {

/// A polygon of constant radiance as the receiver sees it, either side of it, in closed form.
///
///   L_lm = L ∫_P y_lm dω = L / (l(l+1)) Σ_edges ∫ N·∇y_lm ds
///
/// y_lm being eigenfunctions of the Laplacian, Green's theorem on the sphere leaves integrals along
/// the edges; N is the inward normal of an edge's great circle. About N as the pole y_lm are
/// trigonometric along the edge, so every edge is a turned set of elementary integrals. [Wang18]
/// comes to the same sums by recurrences. Exact to rounding, about 1e-15 L times the band count.
///
/// @param corners   three or more, in order, from the receiver; not at it, and no edge through it;
///                  in one plane, or else the shape is that of the corners' directions
/// @param radiance  L
Lighting polygonLighting(std::span<const Vec3d> corners, const Vec3d& radiance, int bandCount);

/// A parallelogram that shows a picture: a window, a screen, a painted ceiling. Texels are patches
/// of constant radiance, each cut as finely as its distance and the bands ask for and integrated by
/// Gauss-Legendre quadrature, to a relative 1e-6.
///
/// @param corner       the picture's upper left corner, from the receiver
/// @param right, down  its edges from there, along rows and columns
/// @param radiance     of the picture
Lighting parallelogramLighting(const Vec3d& corner, const Vec3d& right, const Vec3d& down,
                               const Image& radiance, int bandCount);

}  // namespace prt

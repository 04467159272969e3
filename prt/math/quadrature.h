#pragma once

#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// A point of a quadrature rule on [−1, 1] and its weight; the weights of a rule sum to 2.
struct QuadratureNode {
    double position = 0.0;
    double weight = 0.0;
};

/// The Gauss-Legendre rule, exact for polynomials of degree 2·nodeCount − 1. Positions ascend.
///
/// @param nodeCount  at least 1
std::vector<QuadratureNode> gaussLegendre(int nodeCount);

/// A direction of a quadrature rule on the sphere and its weight; the weights of a rule sum to 4π.
struct SphereNode {
    Vec3d direction;  ///< unit
    double weight = 0.0;
};

/// A rule on the sphere, Gauss-Legendre in z times equal steps in azimuth, exact for polynomials in
/// x, y, z of the degree. Products of two functions of n SH bands need degree 2(n − 1).
std::vector<SphereNode> sphereQuadrature(int degree);

}  // namespace prt

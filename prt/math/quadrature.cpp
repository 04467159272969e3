#include "prt/math/quadrature.h"

#include <cmath>
#include <numbers>

#include "prt/base/assert.h"

namespace prt {
namespace {

struct LegendreValue {
    double value;
    double derivative;
};

/// P_n and its derivative inside (−1, 1).
LegendreValue evaluateLegendre(int n, double x) {
    double last = 0.0, value = 1.0;
    for (int l = 1; l <= n; ++l) {
        const double next = ((2 * l - 1) * x * value - (l - 1) * last) / l;
        last = value;
        value = next;
    }
    return {value, n * (last - x * value) / (1.0 - x * x)};
}

}  // namespace

std::vector<QuadratureNode> gaussLegendre(int nodeCount) {
    PRT_ASSERT(nodeCount >= 1, "a quadrature rule has a node");
    std::vector<QuadratureNode> nodes(static_cast<std::size_t>(nodeCount));
    for (int i = 0; i < nodeCount; ++i) {
        // Start Newton's iteration from Tricomi's estimate of the root,
        // from which a few steps suffice.
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (nodeCount + 0.5));
        LegendreValue legendre = evaluateLegendre(nodeCount, x);
        constexpr int kStepCount = 8;
        for (int step = 0; step < kStepCount; ++step) {
            x -= legendre.value / legendre.derivative;
            legendre = evaluateLegendre(nodeCount, x);
        }
        const double slope = legendre.derivative;
        nodes[static_cast<std::size_t>(i)] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
    }
    return nodes;
}

std::vector<SphereNode> sphereQuadrature(int degree) {
    PRT_ASSERT(degree >= 0, "a polynomial has a degree");
    const int azimuthCount = degree + 1;
    std::vector<SphereNode> nodes;
    for (const QuadratureNode& height : gaussLegendre(degree / 2 + 1)) {
        const double z = height.position;
        const double radius = std::sqrt(1.0 - z * z);
        for (int k = 0; k < azimuthCount; ++k) {
            const double phi = 2.0 * std::numbers::pi * (k + 0.5) / azimuthCount;
            nodes.push_back({Vec3d(radius * std::cos(phi), radius * std::sin(phi), z),
                             height.weight * 2.0 * std::numbers::pi / azimuthCount});
        }
    }
    return nodes;
}

}  // namespace prt

#include "prt/brdf/lobe_quadrature.h"

#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/brdf/microfacets.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

/// Through the lobe's own warp of the unit square. With u = sin²(πt/2) the angles of every warp are
/// smooth in t, at both of its ends.
///
/// @param turn   v of the warp from which azimuths are counted
/// @param share  of all azimuths, that stand for the rest too
std::vector<LobeNode> warpedNodes(const BrdfLobe& lobe, const Vec3d& view,
                                  const LobeQuadratureOptions& options, double turn, double share) {
    const int azimuthCount = static_cast<int>(share * options.azimuthNodeCount);
    std::vector<LobeNode> nodes;
    for (const QuadratureNode& polar : gaussLegendre(options.polarNodeCount)) {
        const double t = 0.5 * (1.0 + polar.position);
        const double u = std::pow(std::sin(0.5 * kPi * t), 2);
        const double weight = 0.25 * kPi * std::sin(kPi * t) * polar.weight / azimuthCount;
        for (int k = 0; k < azimuthCount; ++k) {
            const double v = turn + (k + 0.5) / options.azimuthNodeCount;
            const Vec3d incident = sampleLobe(lobe, view, u, v - std::floor(v)).normalized();
            const double density = lobeDensity(lobe, incident, view);
            if (incident.z > 0.0 && density > 0.0) nodes.push_back({incident, weight / density});
        }
    }
    return nodes;
}

/// The middles of the steps of θ_h, at each of as many azimuths as the table has degrees.
std::vector<LobeNode> halfVectorNodes(const Vec3d& view) {
    constexpr int kAzimuthCount = 180;
    std::vector<LobeNode> nodes;
    for (std::size_t i = 0; i < MeasuredBrdf::kHalfAngleCount; ++i) {
        const auto step = static_cast<double>(i);
        const double theta = MeasuredBrdf::halfAngleAt(step + 0.5);
        const double bandSolidAngle = 2.0 * kPi *
                                      (std::cos(MeasuredBrdf::halfAngleAt(step)) -
                                       std::cos(MeasuredBrdf::halfAngleAt(step + 1.0)));
        for (int k = 0; k < kAzimuthCount; ++k) {
            const double phi = 2.0 * kPi * (k + 0.5) / kAzimuthCount;
            const Vec3d half(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                             std::cos(theta));
            const double cosDifference = half.dot(view);
            const Vec3d incident = mirrorAbout(half, view).normalized();
            if (cosDifference <= 0.0 || incident.z <= 0.0) continue;
            nodes.push_back({incident, 4.0 * cosDifference * bandSolidAngle / kAzimuthCount});
        }
    }
    return nodes;
}

std::vector<LobeNode> nodesOf(const BrdfLobe& lobe, const Vec3d& view,
                              const LobeQuadratureOptions& options, double turn, double share) {
    PRT_ASSERT(options.polarNodeCount >= 1, "there is a node");
    PRT_ASSERT(options.azimuthNodeCount >= 2 && options.azimuthNodeCount % 2 == 0,
               "azimuths mirror one another");
    if (std::holds_alternative<std::monostate>(lobe)) return {};
    if (std::holds_alternative<MeasuredLobe>(lobe)) return halfVectorNodes(view);
    return warpedNodes(lobe, view, options, turn, share);
}

}  // namespace

std::vector<LobeNode> lobeNodes(const BrdfLobe& lobe, const Vec3d& view,
                                const LobeQuadratureOptions& options) {
    return nodesOf(lobe, view, options, 0.0, 1.0);
}

std::vector<LobeNode> uprightLobeNodes(const BrdfLobe& lobe, const Vec3d& view,
                                       const LobeQuadratureOptions& options) {
    PRT_ASSERT(view.y == 0.0, "the view's azimuth is 0");
    // Warps about the view or its mirror image have a tangent along y (frameAbout), others along x.
    const bool startsAcross =
        std::holds_alternative<PhongLobe>(lobe) || std::holds_alternative<GgxLobe>(lobe);
    return nodesOf(lobe, view, options, startsAcross ? 0.75 : 0.0, 0.5);
}

std::vector<ViewNode> viewNodes(const LobeQuadratureOptions& options) {
    PRT_ASSERT(options.viewNodeCount >= 1, "there is a node");
    std::vector<ViewNode> nodes;
    for (const QuadratureNode& polar : gaussLegendre(options.viewNodeCount)) {
        const double theta = 0.25 * kPi * (1.0 + polar.position);
        nodes.push_back({Vec3d(std::sin(theta), 0.0, std::cos(theta)),
                         0.5 * kPi * kPi * std::sin(theta) * polar.weight});
    }
    return nodes;
}

}  // namespace prt

#pragma once

#include <span>
#include <vector>

#include "prt/brdf/brdf.h"

namespace prt {

/// How finely integrals over a lobe are taken. Nodes lie where sampling would put them, so a narrow
/// lobe needs no more than a broad one.
struct LobeQuadratureOptions {
    int polarNodeCount = 80;
    int azimuthNodeCount = 32;  ///< even: half the nodes mirror the other half
    int viewNodeCount = 24;     ///< of the angle between the view and the normal
};

/// A direction ω_i above the horizon that stands for the solid angle about it.
struct LobeNode {
    Vec3d incident;
    double solidAngle = 0.0;
};

/// Nodes of ∫ g(ω_i) dω_i over the upper hemisphere, for a g that is the lobe seen from `view`
/// times something smooth: the equally spaced and Gauss-Legendre points of the map by which the
/// lobe is sampled, or the cells of the half vector in which it was measured.
std::vector<LobeNode> lobeNodes(const BrdfLobe& lobe, const Vec3d& view,
                                const LobeQuadratureOptions& options);

/// Fewer nodes for a view at azimuth 0 and a g that is the same on both sides of y = 0: one of each
/// two that mirror one another stands for both. Of a measured lobe, which may differ there, all.
std::vector<LobeNode> uprightLobeNodes(const BrdfLobe& lobe, const Vec3d& view,
                                       const LobeQuadratureOptions& options);

/// A view at azimuth 0 that stands for all views about its angle to the normal; the solid angles
/// sum to 2π.
struct ViewNode {
    Vec3d view;
    double solidAngle = 0.0;
};
std::vector<ViewNode> viewNodes(const LobeQuadratureOptions& options);

}  // namespace prt

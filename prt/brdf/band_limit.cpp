#include "prt/brdf/band_limit.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// ∫ g² dω_i for a view at azimuth 0. A product of two lobes is taken at the nodes of the later,
/// narrower one.
double squaredNorm(const Brdf& brdf, const Vec3d& view, const LobeQuadratureOptions& options) {
    double sum = 0.0;
    for (std::size_t k = 0; k < brdf.lobes.size(); ++k)
        for (const LobeNode& node : uprightLobeNodes(brdf.lobes[k], view, options)) {
            Vec3d broader(0.0);
            for (std::size_t j = 0; j < k; ++j)
                broader += evaluateLobe(brdf.lobes[j], node.incident, view);
            const Vec3d value = evaluateLobe(brdf.lobes[k], node.incident, view);
            sum += node.solidAngle * node.incident.z * node.incident.z *
                   value.dot(value + broader * 2.0);
        }
    return sum;
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// How much less than ∫ g² the squared difference above the horizon is, 2 f·f̃ − f̃ᵀ H f̃, where H
/// is known from what f̃ solves.
double heldAboveHorizon(std::span<const double> projected, std::span<const double> fitted) {
    constexpr double kWeight = kHorizonFitWeight;
    const double both = dot(projected, fitted);
    return 2.0 * both - (both - kWeight * dot(fitted, fitted)) / (1.0 - kWeight);
}

double relativeRest(double held, double whole) {
    return whole > 0.0 ? std::sqrt(std::max(0.0, 1.0 - held / whole)) : 0.0;
}

}  // namespace

BandLimitError measureBandLimitError(const Brdf& brdf, const BrdfProjectionOptions& options) {
    double whole = 0.0, heldOfIncident = 0.0, heldOfBoth = 0.0;
    const HorizonFit fit(options.incidentBandCount);
    std::array<BrdfMatrix, 3> matrices;
    matrices.fill(makeBrdfMatrix(options.incidentBandCount, options.viewBandCount));
    for (const ViewNode& node : viewNodes(options.quadrature)) {
        const auto perView =
            projectUprightView(brdf, node.view, options.incidentBandCount, options.quadrature);
        whole += node.solidAngle * squaredNorm(brdf, node.view, options.quadrature);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<double> fitted = perView[channel];
            fit.apply(fitted);
            heldOfIncident += node.solidAngle * heldAboveHorizon(perView[channel], fitted);
            addBrdfView(node, perView[channel], matrices[channel]);
        }
    }
    // By Parseval.
    for (const BrdfMatrix& matrix : matrices) {
        const std::vector<double> expanded = expandBrdfMatrix(matrix);
        heldOfBoth += dot(expanded, expanded);
    }
    return {.incident = relativeRest(heldOfIncident, whole),
            .matrix = relativeRest(heldOfBoth, whole)};
}

std::optional<double> findLeastRoughnessHeld(int bandCount, double maxError,
                                             const LobeQuadratureOptions& quadrature) {
    PRT_ASSERT(maxError > 0.0, "no number of bands is without error");
    const BrdfProjectionOptions options{
        .incidentBandCount = bandCount, .viewBandCount = 1, .quadrature = quadrature};
    const auto isHeld = [&](double roughness) {
        const Brdf lobe{.lobes = {GgxLobe{.f0 = Vec3d(1.0), .alpha = roughness * roughness}}};
        return measureBandLimitError(lobe, options).incident <= maxError;
    };
    if (!isHeld(1.0)) return std::nullopt;
    double tooSmooth = 0.0, roughEnough = 1.0;
    constexpr double kResolution = 1e-3;  // far below what a picture shows
    while (roughEnough - tooSmooth > kResolution) {
        const double middle = 0.5 * (tooSmooth + roughEnough);
        (isHeld(middle) ? roughEnough : tooSmooth) = middle;
    }
    return roughEnough;
}

double leastRoughnessHeld(int bandCount) {
    // So few nodes, six times as fast, move it by no more than kResolution.
    constexpr LobeQuadratureOptions kCoarse{
        .polarNodeCount = 32, .azimuthNodeCount = 24, .viewNodeCount = 16};
    return findLeastRoughnessHeld(bandCount, kMostLobeError, kCoarse).value_or(1.0);
}

}  // namespace prt

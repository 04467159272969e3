#include "prt/brdf/gltf_brdf_table.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"

namespace prt {
namespace {

GltfBrdfTable::SpecularPair projectPair(double roughness, const BrdfProjectionOptions& options) {
    // The two values of F0 ride on two channels.
    const GgxLobe lobe{.f0 = Vec3d(0.0, 1.0, 0.0), .alpha = roughness * roughness};
    auto channels = projectBrdf({.lobes = {lobe}}, options);
    return {.dark = std::move(channels[0]), .bright = std::move(channels[1])};
}

/// Lagrange's weights of the cubic through points at 0, 1, 2 and 3.
std::array<double, 4> cubicWeights(double x) {
    return {-(x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0, x * (x - 2.0) * (x - 3.0) / 2.0,
            -x * (x - 1.0) * (x - 3.0) / 2.0, x * (x - 1.0) * (x - 2.0) / 6.0};
}

void addScaled(const BrdfMatrix& matrix, double factor, BrdfMatrix& sum) {
    for (std::size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += factor * matrix.values[i];
}

}  // namespace

GltfBrdfTable::GltfBrdfTable(const BrdfProjectionOptions& options, int levelCount) {
    PRT_ASSERT(levelCount >= 4, "a cubic has four points");
    diffuse_ = projectBrdf({.lobes = {LayeredLambertLobe{Vec3d(1.0)}}}, options)[0];
    for (int level = 0; level < levelCount; ++level)
        levels_.push_back(projectPair(static_cast<double>(level) / (levelCount - 1), options));
}

GltfBrdfTable::SpecularPair GltfBrdfTable::specular(double roughness) const {
    PRT_ASSERT(roughness >= 0.0 && roughness <= 1.0, "roughness lies in [0, 1]");
    const double position = roughness * static_cast<double>(levels_.size() - 1);
    const auto first = static_cast<std::size_t>(
        std::clamp(std::floor(position) - 1.0, 0.0, static_cast<double>(levels_.size() - 4)));
    const std::array<double, 4> weights = cubicWeights(position - static_cast<double>(first));
    const BrdfMatrix zero = makeBrdfMatrix(diffuse_.incidentBandCount, diffuse_.viewBandCount);
    SpecularPair pair{.dark = zero, .bright = zero};
    for (std::size_t k = 0; k < weights.size(); ++k) {
        addScaled(levels_[first + k].dark, weights[k], pair.dark);
        addScaled(levels_[first + k].bright, weights[k], pair.bright);
    }
    return pair;
}

std::array<BrdfMatrix, 3> GltfBrdfTable::project(const Vec3f& baseColor,
                                                 const MetallicRoughness& surface) const {
    const GltfLobes lobes = splitGltfMaterial(baseColor, surface);
    const SpecularPair pair = specular(std::sqrt(lobes.specular.alpha));
    std::array<BrdfMatrix, 3> matrices;
    for (int channel = 0; channel < 3; ++channel) {
        BrdfMatrix& matrix = matrices[static_cast<std::size_t>(channel)];
        matrix = lerpBrdfMatrices(pair.dark, pair.bright, lobes.specular.f0[channel]);
        addScaled(diffuse_, lobes.diffuse.albedo[channel], matrix);
    }
    return matrices;
}

}  // namespace prt

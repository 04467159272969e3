// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
#include "prt/light/irradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/basis/zonal.h"
#include "prt/image/tone_curve.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

// The constants of [Ramamoorthi01], each A_l times one of the polynomials' factors.
constexpr double kC1 = 0.42904276540489172;  // sqrt(15 pi) / 16
constexpr double kC2 = 0.51166335397324424;  // sqrt(pi / 3) / 2
constexpr double kC3 = 0.74312386830112707;  // 3 sqrt(5 pi) / 16
constexpr double kC4 = 0.88622692545275801;  // sqrt(pi) / 2
constexpr double kC5 = 0.24770795610037569;  // sqrt(5 pi) / 16

/// Irradiance in luminance, one number a coefficient.
std::vector<double> irradianceLuminance(const Lighting& lighting) {
    std::vector<double> coefficients;
    for (const Vec3d& coefficient : convolveWithCosine(lighting).coefficients)
        coefficients.push_back(luminance(coefficient));
    return coefficients;
}

/// Adds one direction of the given weight to the error of each count of bands.
///
/// @param bands  irradiance of each band, there
void accumulateErrors(std::span<const double> bands, double irradiance, double weight,
                      std::span<IrradianceError> errors) {
    for (std::size_t l = 0; l < errors.size(); ++l) {
        irradiance -= bands[l];
        errors[l].mean += weight * std::abs(irradiance);
        errors[l].rms += weight * irradiance * irradiance;
        errors[l].largest = std::max(errors[l].largest, std::abs(irradiance));
    }
}

}  // namespace

Lighting convolveWithCosine(const Lighting& lighting) {
    std::vector<double> factors;
    for (int l = 0; l < lighting.bandCount; ++l)
        factors.push_back(clampedCosineFactor(l));
    return applyWindow(lighting, factors);
}

Vec3d evaluateIrradiance(const Lighting& lighting, const Vec3d& normal) {
    return reconstruct(convolveWithCosine(lighting), normal);
}

IrradianceMatrix makeIrradianceMatrix(const Lighting& lighting) {
    const auto radiance = [&](int l, int m) {
        return l < lighting.bandCount
                   ? lighting.coefficients[static_cast<std::size_t>(shIndex(l, m))]
                   : Vec3d(0.0);
    };
    IrradianceMatrix matrix;
    matrix[0] = {radiance(2, 2) * kC1, radiance(2, -2) * kC1, radiance(2, 1) * -kC1,
                 radiance(1, 1) * -kC2};
    matrix[1] = {matrix[0][1], radiance(2, 2) * -kC1, radiance(2, -1) * -kC1,
                 radiance(1, -1) * -kC2};
    matrix[2] = {matrix[0][2], matrix[1][2], radiance(2, 0) * kC3, radiance(1, 0) * kC2};
    matrix[3] = {matrix[0][3], matrix[1][3], matrix[2][3],
                 radiance(0, 0) * kC4 - radiance(2, 0) * kC5};
    return matrix;
}

Vec3d evaluateIrradiance(const IrradianceMatrix& matrix, const Vec3d& normal) {
    const std::array<double, 4> vector = {normal.x, normal.y, normal.z, 1.0};
    Vec3d irradiance(0.0);
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column)
            irradiance += matrix[row][column] * (vector[row] * vector[column]);
    }
    return irradiance;
}

std::vector<IrradianceError> measureIrradianceErrors(const Lighting& lighting, int maxBandCount) {
    PRT_ASSERT(maxBandCount >= 1 && maxBandCount <= lighting.bandCount,
               "the bands that are judged are there");
    std::vector<IrradianceError> errors(static_cast<std::size_t>(maxBandCount));
    const std::vector<double> coefficients = irradianceLuminance(lighting);
    std::vector<double> values(coefficients.size());
    std::vector<double> bands(static_cast<std::size_t>(lighting.bandCount));
    double largestIrradiance = 0.0;

    // Exact for the squares of any light of up to 64 bands, and close enough together for the
    // largest value.
    constexpr int kLeastDegree = 126;
    for (const SphereNode& node :
         sphereQuadrature(std::max(kLeastDegree, 2 * lighting.bandCount))) {
        evaluateSh(node.direction, lighting.bandCount, values);
        sumShBands(coefficients, values, bands);
        const double irradiance = std::accumulate(bands.begin(), bands.end(), 0.0);
        largestIrradiance = std::max(largestIrradiance, irradiance);
        accumulateErrors(bands, irradiance, 0.25 * std::numbers::inv_pi * node.weight, errors);
    }

    const double scale = largestIrradiance > 0.0 ? 1.0 / largestIrradiance : 0.0;
    for (std::size_t l = 0; l < errors.size(); ++l) {
        errors[l].bandCount = static_cast<int>(l) + 1;
        errors[l].mean *= scale;
        errors[l].rms = std::sqrt(errors[l].rms) * scale;
        errors[l].largest *= scale;
    }
    return errors;
}

std::vector<IrradianceError> worstIrradianceErrors(int maxBandCount) {
    PRT_ASSERT(maxBandCount >= 1, "there is at least one band");
    constexpr int kHeightCount = 20000;  // even, so that no cell has the cosine's kink inside
    const auto bandCount = static_cast<std::size_t>(maxBandCount);
    const std::vector<double> cosine = clampedCosineZonal(maxBandCount);
    std::vector<double> values(static_cast<std::size_t>(shCoefficientCount(maxBandCount)));
    std::vector<IrradianceError> errors(bandCount);
    for (int k = 0; k <= kHeightCount; ++k) {
        const double height = 2.0 * k / kHeightCount - 1.0;
        evaluateSh(Vec3d(std::sqrt(1.0 - height * height), 0.0, height), maxBandCount, values);
        std::vector<double> bands(bandCount);
        for (std::size_t l = 0; l < bandCount; ++l)
            bands[l] =
                cosine[l] * values[static_cast<std::size_t>(shIndex(static_cast<int>(l), 0))];
        const double weight = (k == 0 || k == kHeightCount ? 0.5 : 1.0) / kHeightCount;
        accumulateErrors(bands, std::max(height, 0.0), weight, errors);
    }
    for (std::size_t l = 0; l < bandCount; ++l) {
        errors[l].bandCount = static_cast<int>(l) + 1;
        errors[l].rms = std::sqrt(errors[l].rms);
    }
    return errors;
}

}  // namespace prt

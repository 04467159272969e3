#include "prt/light/lat_long_projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "prt/light/lat_long_kernel.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

/// Column x has its centre at φ = π − (x + ½) 2π/width.
AzimuthFunctions makeAzimuthFunctions(std::size_t width, int bandCount) {
    AzimuthFunctions functions;
    functions.orderCount = bandCount;
    functions.foldedSize = foldedRowSize(width);
    functions.blockCount = (functions.foldedSize + DoubleBlock::kSize - 1) / DoubleBlock::kSize;
    functions.cosines.resize(static_cast<std::size_t>(bandCount) * functions.blockCount);
    functions.sines.resize(functions.cosines.size());
    const double texelAngle = 2.0 * std::numbers::pi / static_cast<double>(width);
    std::vector<double> amplitudes = {texelAngle};
    for (int m = 1; m < bandCount; ++m)
        amplitudes.push_back(2.0 / m * std::sin(0.5 * m * texelAngle));

    for (std::size_t x = 0; x < functions.foldedSize; ++x) {
        const double phi = std::numbers::pi - texelAngle * (static_cast<double>(x) + 0.5);
        const double cosPhi = std::cos(phi), sinPhi = std::sin(phi);
        const bool isOwnMirror = 2 * x + 1 == width || 4 * x + 2 == width;
        double cosine = isOwnMirror ? 0.5 : 1.0, sine = 0.0;
        for (std::size_t m = 0; m < amplitudes.size(); ++m) {
            const std::size_t block = m * functions.blockCount + x / DoubleBlock::kSize;
            functions.cosines[block].lanes[x % DoubleBlock::kSize] = amplitudes[m] * cosine;
            functions.sines[block].lanes[x % DoubleBlock::kSize] = amplitudes[m] * sine;
            const double nextCosine = cosPhi * cosine - sinPhi * sine;
            sine = cosPhi * sine + sinPhi * cosine;
            cosine = nextCosine;
        }
    }
    return functions;
}

/// The rule that integrates waves of up to n periods over the height of a row to rounding: their
/// Chebyshev coefficients fall as (nr/2)^k/k! for a half height of r, and the rule of N nodes is
/// exact up to k = 2N − 1.
std::vector<QuadratureNode> makePolarRule(int height, int bandCount) {
    constexpr double kRounding = 1e-17;
    const double ratio = 0.25 * std::numbers::pi * bandCount / height;
    int nodeCount = 0;
    double coefficient = 1.0;
    while (coefficient > kRounding || 2 * nodeCount < ratio) {
        ++nodeCount;
        coefficient *= ratio / (2 * nodeCount - 1) * ratio / (2 * nodeCount);
    }
    return gaussLegendre(nodeCount);
}

/// Integrals of y_lm(θ, 0) sin θ over the height of a row, θ from +y; n² numbers, of which those
/// with m ≥ 0 count.
void integratePolarFunctions(int height, int y, int bandCount, std::span<const QuadratureNode> rule,
                             std::span<double> values, std::span<double> integrals) {
    std::fill(integrals.begin(), integrals.end(), 0.0);
    for (const QuadratureNode& node : rule) {
        const double theta = std::numbers::pi / height * (y + 0.5 + 0.5 * node.position);
        const double sine = std::sin(theta);
        evaluateSh(Vec3d(sine, 0.0, std::cos(theta)), bandCount, values);
        const double weight = 0.5 * std::numbers::pi / height * node.weight * sine;
        for (std::size_t i = 0; i < values.size(); ++i)
            integrals[i] += weight * values[i];
    }
}

/// Adds a row and the one that mirrors it in the equator, whose polar functions are (−1)^(l+m)
/// times the same.
void addRows(std::span<const AzimuthSum> north, std::span<const AzimuthSum> south,
             std::span<const double> polarIntegrals, Lighting& lighting) {
    for (int m = 0; m < lighting.bandCount; ++m) {
        const AzimuthSum& above = north[static_cast<std::size_t>(m)];
        const AzimuthSum& below = south[static_cast<std::size_t>(m)];
        const AzimuthSum parts[2] = {{above.cosine + below.cosine, above.sine + below.sine},
                                     {above.cosine - below.cosine, above.sine - below.sine}};
        for (int l = m; l < lighting.bandCount; ++l) {
            const AzimuthSum& part = parts[(l + m) % 2];
            const auto plus = static_cast<std::size_t>(shIndex(l, m));
            const auto minus = static_cast<std::size_t>(shIndex(l, -m));
            lighting.coefficients[plus] += part.cosine * polarIntegrals[plus];
            if (m > 0) lighting.coefficients[minus] += part.sine * polarIntegrals[plus];
        }
    }
}

}  // namespace

Lighting projectLatLong(const Image& image, int bandCount) {
    const auto width = static_cast<std::size_t>(image.width);
    const AzimuthFunctions functions = makeAzimuthFunctions(width, bandCount);
    const std::vector<QuadratureNode> polarRule = makePolarRule(image.height, bandCount);
    std::vector<DoubleBlock> scratch(12 * functions.blockCount);
    const auto integrate = [&](int y, std::span<AzimuthSum> sums) {
        const std::span<const Vec3f> pixels(image.pixels);
        integrateRow(pixels.subspan(static_cast<std::size_t>(y) * width, width), functions, scratch,
                     sums);
    };

    Lighting aboutY(bandCount);
    std::vector<AzimuthSum> north(static_cast<std::size_t>(bandCount)), south(north.size());
    std::vector<double> values(aboutY.coefficients.size()), polarIntegrals(values.size());
    for (int y = 0; 2 * y < image.height; ++y) {
        const int mirrored = image.height - 1 - y;
        integrate(y, north);
        if (mirrored != y)
            integrate(mirrored, south);
        else
            std::fill(south.begin(), south.end(), AzimuthSum{Vec3d(0.0), Vec3d(0.0)});
        integratePolarFunctions(image.height, y, bandCount, polarRule, values, polarIntegrals);
        addRows(north, south, polarIntegrals, aboutY);
    }
    return rotate(aboutY, rotationX(-0.5 * std::numbers::pi));
}

}  // namespace prt

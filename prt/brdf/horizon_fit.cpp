// Bibliography
//   [Lam06]    Noise-resistant fitting for spherical harmonics
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/brdf/horizon_fit.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

/// (1 − ε) H + ε 1, the blocks [l − m][l' − m] of each m ≥ 0. H has no other elements, and the same
/// ones for −m.
std::vector<std::vector<double>> makeBlocks(int bandCount, double weight) {
    std::vector<std::vector<double>> blocks;
    for (int m = 0; m < bandCount; ++m) {
        const auto size = static_cast<std::size_t>(bandCount - m);
        blocks.emplace_back(size * size, 0.0);
        for (std::size_t i = 0; i < size; ++i)
            blocks.back()[i * size + i] = weight;
    }
    std::vector<double> basis(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    for (const QuadratureNode& node : gaussLegendre(bandCount)) {
        const double z = 0.5 * (1.0 + node.position);
        evaluateSh(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), bandCount, basis);
        for (int m = 0; m < bandCount; ++m) {
            // The mean of cos² mφ over all azimuths is ½.
            const double share =
                (1.0 - weight) * (m == 0 ? 1.0 : 0.5) * std::numbers::pi * node.weight;
            const auto size = static_cast<std::size_t>(bandCount - m);
            for (std::size_t i = 0; i < size * size; ++i)
                blocks[static_cast<std::size_t>(m)][i] +=
                    share *
                    basis[static_cast<std::size_t>(shIndex(m + static_cast<int>(i / size), m))] *
                    basis[static_cast<std::size_t>(shIndex(m + static_cast<int>(i % size), m))];
        }
    }
    return blocks;
}

/// Turns a positive definite matrix into its lower triangular factor of Cholesky.
void factorise(std::span<double> matrix, std::size_t size) {
    for (std::size_t column = 0; column < size; ++column)
        for (std::size_t row = column; row < size; ++row) {
            double rest = matrix[row * size + column];
            for (std::size_t k = 0; k < column; ++k)
                rest -= matrix[row * size + k] * matrix[column * size + k];
            matrix[row * size + column] =
                row == column ? std::sqrt(rest) : rest / matrix[column * size + column];
        }
}

/// Solves L Lᵀ x = b in place.
void solve(std::span<const double> factor, std::span<double> numbers) {
    const std::size_t size = numbers.size();
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            numbers[i] -= factor[i * size + k] * numbers[k];
        numbers[i] /= factor[i * size + i];
    }
    for (std::size_t i = size; i-- > 0;) {
        for (std::size_t k = i + 1; k < size; ++k)
            numbers[i] -= factor[k * size + i] * numbers[k];
        numbers[i] /= factor[i * size + i];
    }
}

}  // namespace

HorizonFit::HorizonFit(int bandCount, double weight) : bandCount_(bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(weight > 0.0 && weight <= 1.0, "the hemisphere below counts, and not for more");
    factors_ = makeBlocks(bandCount, weight);
    for (std::size_t m = 0; m < factors_.size(); ++m)
        factorise(factors_[m], factors_.size() - m);
}

void HorizonFit::apply(std::span<double> coefficients) const {
    PRT_ASSERT(static_cast<int>(coefficients.size()) == shCoefficientCount(bandCount_),
               "n² coefficients");
    for (int order = 1 - bandCount_; order < bandCount_; ++order) {
        const int m = std::abs(order);
        std::vector<double> ofOrder;
        for (int l = m; l < bandCount_; ++l)
            ofOrder.push_back(coefficients[static_cast<std::size_t>(shIndex(l, order))]);
        solve(factors_[static_cast<std::size_t>(m)], ofOrder);
        for (int l = m; l < bandCount_; ++l)
            coefficients[static_cast<std::size_t>(shIndex(l, order))] =
                ofOrder[static_cast<std::size_t>(l - m)];
    }
}

}  // namespace prt

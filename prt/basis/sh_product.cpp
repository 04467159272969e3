// Bibliography
//   [Sloan08]  Stupid spherical harmonics tricks: products and their matrices
#include "prt/basis/sh_product.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "prt/base/assert.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

// Rounding leaves integrals that are zero below 1e-15, and the smallest of the others, with ten
// bands, is above 1e-4.
constexpr double kZeroIntegral = 1e-10;

/// Whether three degrees can meet: they make a triangle, and their sum is even.
bool canMeet(int a, int b, int c) {
    return (a + b + c) % 2 == 0 && c <= a + b && c >= std::abs(a - b);
}

/// The basis functions at the nodes of an exact rule, [function][node], and the nodes' weights.
struct SampledBasis {
    std::vector<std::vector<double>> values;
    std::vector<double> weights;

    explicit SampledBasis(int bandCount) {
        const std::vector<SphereNode> nodes = sphereQuadrature(3 * (bandCount - 1));
        const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
        values.assign(count, std::vector<double>(nodes.size()));
        std::vector<double> atNode(count);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            evaluateSh(nodes[node].direction, bandCount, atNode);
            for (std::size_t i = 0; i < count; ++i)
                values[i][node] = atNode[i];
            weights.push_back(nodes[node].weight);
        }
    }
};

}  // namespace

ShTripling::ShTripling(int bandCount) : bandCount_(bandCount) {
    PRT_ASSERT(bandCount >= 1 && bandCount <= kMaxBandCount, "a band count of the tables");
    const SampledBasis basis(bandCount);
    const int count = shCoefficientCount(bandCount);
    std::vector<double> pair(basis.weights.size());
    for (int i = 0; i < count; ++i)
        for (int j = i; j < count; ++j) {
            for (std::size_t node = 0; node < pair.size(); ++node)
                pair[node] = basis.weights[node] * basis.values[static_cast<std::size_t>(i)][node] *
                             basis.values[static_cast<std::size_t>(j)][node];
            for (int k = j; k < count; ++k) {
                if (!canMeet(shDegree(i), shDegree(j), shDegree(k))) continue;
                const std::vector<double>& third = basis.values[static_cast<std::size_t>(k)];
                double integral = 0.0;
                for (std::size_t node = 0; node < pair.size(); ++node)
                    integral += pair[node] * third[node];
                if (std::abs(integral) > kZeroIntegral)
                    triples_.push_back({static_cast<std::uint16_t>(i),
                                        static_cast<std::uint16_t>(j),
                                        static_cast<std::uint16_t>(k), integral});
            }
        }
}

void ShTripling::multiply(std::span<const double> a, std::span<const double> b,
                          std::span<double> product) const {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(a.size() == count && b.size() == count && product.size() == count,
               "n² coefficients each");
    std::fill(product.begin(), product.end(), 0.0);
    const auto both = [&](std::size_t p, std::size_t q) {
        return p == q ? a[p] * b[p] : a[p] * b[q] + a[q] * b[p];
    };
    // Each different order of a triple counts once.
    for (const auto& [i, j, k, integral] : triples_) {
        product[k] += integral * both(i, j);
        if (j != k) product[j] += integral * both(i, k);
        if (i != j) product[i] += integral * both(j, k);
    }
}

std::vector<double> ShTripling::makeProductMatrix(std::span<const double> a) const {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(a.size() == count, "n² coefficients");
    std::vector<double> matrix(count * count);
    const auto add = [&](std::size_t p, std::size_t q, double value) {
        matrix[p * count + q] += value;
        if (p != q) matrix[q * count + p] += value;
    };
    for (const auto& [i, j, k, integral] : triples_) {
        add(i, j, integral * a[k]);
        if (j != k) add(i, k, integral * a[j]);
        if (i != j) add(j, k, integral * a[i]);
    }
    return matrix;
}

}  // namespace prt

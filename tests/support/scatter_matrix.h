#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "prt/compress/vector_set.h"

namespace prt {

using Matrix = std::vector<std::vector<double>>;

/// The eigenvalues of a symmetric matrix, descending, by Jacobi's rotations.
inline std::vector<double> jacobiEigenvalues(Matrix a) {
    const std::size_t size = a.size();
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (std::size_t p = 0; p < size; ++p) {
            for (std::size_t q = p + 1; q < size; ++q) {
                const double angle = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
                const double c = std::cos(angle), s = std::sin(angle);
                for (std::size_t k = 0; k < size; ++k) {
                    const double left = a[k][p], right = a[k][q];
                    a[k][p] = c * left - s * right;
                    a[k][q] = s * left + c * right;
                }
                for (std::size_t k = 0; k < size; ++k) {
                    const double upper = a[p][k], lower = a[q][k];
                    a[p][k] = c * upper - s * lower;
                    a[q][k] = s * upper + c * lower;
                }
            }
        }
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i)
        values.push_back(a[i][i]);
    std::sort(values.rbegin(), values.rend());
    return values;
}

/// Σ (x − m)(x − m)ᵀ, each dimension times its weight.
inline Matrix scatterMatrix(const VectorSet& vectors) {
    const std::size_t d = vectors.dimension, n = vectors.count();
    std::vector<double> mean(d, 0.0);
    for (std::size_t i = 0; i < n * d; ++i)
        mean[i % d] += vectors.numbers[i] / static_cast<double>(n);
    Matrix matrix(d, std::vector<double>(d, 0.0));
    const auto offset = [&](std::size_t i, std::size_t j) {
        const double weight = vectors.errorWeights.empty() ? 1.0 : double{vectors.errorWeights[j]};
        return weight * (vectors.numbers[i * d + j] - mean[j]);
    };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < d; ++j) {
            for (std::size_t k = 0; k < d; ++k)
                matrix[j][k] += offset(i, j) * offset(i, k);
        }
    }
    return matrix;
}

}  // namespace prt

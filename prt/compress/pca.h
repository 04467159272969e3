#pragma once

#include <cstddef>
#include <vector>

#include "prt/compress/vector_set.h"

namespace prt {

struct PcaOptions {
    std::size_t componentCount = 12;  ///< beyond the mean
    double maxError = 0.0;  ///< fewer components, if this root mean square of w_j (x_j −
                            ///< x̂_j) over all numbers is kept; 0: all components
    int threadCount = 0;    ///< 0: one a core
};

/// Vectors as sums of a few that all of them share:  x ≈ m + Σ_p t_p b_p   [Jolliffe02; Kautz04].
struct Pca {
    std::size_t dimension = 0;
    std::vector<float> mean;        ///< m, [dimension]
    std::vector<float> components;  ///< b: [component][dimension], Σ_j w_j² b_pj b_qj = δ_pq
    std::vector<float> weights;     ///< t: [vector][component]
    std::vector<double> squares;    ///< Σ t² over the vectors, for each component, descending
    double totalSquares = 0.0;  ///< Σ w_j² (x_j − m_j)²: the squared error without components
    double squaredError = 0.0;  ///< Σ w_j² (x_j − x̂_j)², measured with the numbers above

    std::size_t componentCount() const { return squares.size(); }
};

/// Finds the components that leave the least error for their number: the squared error is what the
/// left out ones would explain. Sums are made in double; the same input gives the same bits for any
/// number of threads (C10).
///
/// There are fewer components than asked for where these reproduce all vectors to float.
///
/// @param vectors  at least one
Pca computePca(const VectorSet& vectors, const PcaOptions& options = {});

/// m + Σ_p t_p b_p of one vector. @param numbers  [dimension], written
void expandVector(const Pca& pca, std::size_t vector, std::span<float> numbers);

}  // namespace prt

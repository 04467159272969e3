#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/base/random.h"

namespace prt {

/// About normal: the sum of twelve uniform numbers, of variance 1.
inline double drawNormal(RandomStream& random) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
        sum += random.nextUnitDouble();
    return sum;
}

/// Vectors in clouds about `cloudCount` points, each cloud in an affine subspace of its own.
struct CloudOptions {
    std::size_t count = 1000;
    std::size_t dimension = 8;
    std::size_t cloudCount = 4;
    std::size_t subspaceDimension = 3;
    double spread = 10.0;  ///< of the points
    double noise = 0.0;    ///< in all dimensions
    std::uint64_t seed = 1;
};

/// [vector][dimension]; vector i is of cloud i modulo cloudCount.
inline std::vector<float> makeClouds(const CloudOptions& options) {
    RandomStream random(options.seed, 77);
    const std::size_t d = options.dimension, s = options.subspaceDimension;
    std::vector<double> points(options.cloudCount * d), axes(options.cloudCount * s * d);
    for (double& number : points)
        number = options.spread * drawNormal(random);
    for (double& number : axes)
        number = drawNormal(random);
    std::vector<float> vectors;
    for (std::size_t i = 0; i < options.count; ++i) {
        const std::size_t cloud = i % options.cloudCount;
        std::vector<double> amounts(s);
        for (double& amount : amounts)
            amount = drawNormal(random);
        for (std::size_t j = 0; j < d; ++j) {
            double number = points[cloud * d + j] + options.noise * drawNormal(random);
            for (std::size_t p = 0; p < s; ++p)
                number += amounts[p] * axes[(cloud * s + p) * d + j];
            vectors.push_back(static_cast<float>(number));
        }
    }
    return vectors;
}

/// Σ_j w_j² (x_j − y_j)², without weights Σ_j (x_j − y_j)².
inline double squaredDistance(std::span<const float> x, std::span<const double> y,
                              std::span<const float> errorWeights = {}) {
    double sum = 0.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
        const double weight = errorWeights.empty() ? 1.0 : double{errorWeights[j]};
        sum += weight * weight * (x[j] - y[j]) * (x[j] - y[j]);
    }
    return sum;
}

/// base + Σ_p weights_p components_p, in double.
inline std::vector<double> combine(std::span<const float> base, std::span<const float> components,
                                   std::span<const float> weights) {
    std::vector<double> sum(base.begin(), base.end());
    for (std::size_t p = 0; p < weights.size(); ++p) {
        for (std::size_t j = 0; j < sum.size(); ++j)
            sum[j] += double{weights[p]} * components[p * sum.size() + j];
    }
    return sum;
}

/// Σ_j w_j² a_j b_j.
inline double weightedDot(std::span<const float> a, std::span<const float> b,
                          std::span<const float> errorWeights = {}) {
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
        const double weight = errorWeights.empty() ? 1.0 : double{errorWeights[j]};
        sum += weight * weight * a[j] * b[j];
    }
    return sum;
}

}  // namespace prt

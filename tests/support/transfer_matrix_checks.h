#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/math/frame.h"
#include "prt/math/quadrature.h"

namespace prt::test {

/// Of a transfer matrix.
struct BandCounts {
    int incident = 5;
    int light = 5;

    std::size_t rowCount() const { return static_cast<std::size_t>(shCoefficientCount(incident)); }
    std::size_t columnCount() const { return static_cast<std::size_t>(shCoefficientCount(light)); }
};

/// R ω.
inline Vec3d intoLocalFrame(const Vec3d& direction, const Vec3f& normal) {
    const Frame<double> frame = frameFromNormal(Vec3d(normal).normalized());
    return {direction.dot(frame.tangent), direction.dot(frame.bitangent),
            direction.dot(frame.normal)};
}

/// Σ w y_i(R ω) y_j(ω) as [i][j], one direction after the other.
inline std::vector<double> sumMatrix(const std::vector<SphereNode>& visible,
                                     const BandCounts& bands, const Vec3f& normal) {
    std::vector<double> rows(bands.rowCount());
    std::vector<double> columns(bands.columnCount());
    std::vector<double> matrix(rows.size() * columns.size());
    for (const SphereNode& node : visible) {
        evaluateSh(intoLocalFrame(node.direction, normal), bands.incident, rows);
        evaluateSh(node.direction, bands.light, columns);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < columns.size(); ++j)
                matrix[i * columns.size() + j] += node.weight * rows[i] * columns[j];
    }
    return matrix;
}

/// A rule on the hemisphere about a normal, exact for polynomials of the degree.
inline std::vector<SphereNode> hemisphereQuadrature(const Vec3f& normal, int degree) {
    const Frame<double> frame = frameFromNormal(Vec3d(normal).normalized());
    std::vector<SphereNode> nodes;
    const int stepCount = degree + 1;
    for (const QuadratureNode& node : gaussLegendre(degree / 2 + 1))
        for (int step = 0; step < stepCount; ++step) {
            const double z = 0.5 * (node.position + 1.0);
            const double phi = 2.0 * std::numbers::pi * step / stepCount;
            const double radius = std::sqrt(1.0 - z * z);
            nodes.push_back(
                {frame.worldFromLocal({radius * std::cos(phi), radius * std::sin(phi), z}),
                 0.5 * node.weight * 2.0 * std::numbers::pi / stepCount});
        }
    return nodes;
}

/// What comes in from a direction of the local frame under a light.
inline double incidentRadiance(const std::vector<float>& matrix, const BandCounts& bands,
                               const std::vector<double>& light, const Vec3d& localDirection) {
    std::vector<double> incident(bands.rowCount());
    for (std::size_t i = 0; i < incident.size(); ++i)
        for (std::size_t j = 0; j < light.size(); ++j)
            incident[i] += static_cast<double>(matrix[i * light.size() + j]) * light[j];
    return reconstructSh(incident, bands.incident, localDirection);
}

/// Whether factor · A + shift has positive eigenvalues alone, by Cholesky's decomposition of its
/// lower half.
inline bool isPositiveDefinite(const std::vector<float>& symmetric, double factor, double shift) {
    const auto size = static_cast<std::size_t>(std::sqrt(static_cast<double>(symmetric.size())));
    std::vector<double> root(size * size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = factor * static_cast<double>(symmetric[i * size + j]);
            if (i == j) rest += shift;
            for (std::size_t k = 0; k < j; ++k)
                rest -= root[i * size + k] * root[j * size + k];
            if (i == j && rest <= 0.0) return false;
            root[i * size + j] = i == j ? std::sqrt(rest) : rest / root[j * size + j];
        }
    return true;
}

}  // namespace prt::test

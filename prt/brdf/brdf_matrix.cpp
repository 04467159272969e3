// Bibliography
//   [Kautz02]  Fast, arbitrary BRDF shading for low-frequency lighting using spherical harmonics
#include "prt/brdf/brdf_matrix.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

/// Calls visit(|m|, incident degree, view degree, index) for each stored element, in order.
template <class Visit>
void visitElements(int incidentBandCount, int viewBandCount, const Visit& visit) {
    std::size_t index = 0;
    for (int m = 0; m < std::min(incidentBandCount, viewBandCount); ++m)
        for (int incident = m; incident < incidentBandCount; ++incident)
            for (int view = m; view < viewBandCount; ++view)
                visit(m, incident, view, index++);
}

std::size_t indexOf(int l, int m) {
    return static_cast<std::size_t>(shIndex(l, m));
}

using ViewCoefficients = std::array<std::vector<double>, 3>;

ViewCoefficients makeViewCoefficients(int bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    ViewCoefficients coefficients;
    coefficients.fill(
        std::vector<double>(static_cast<std::size_t>(shCoefficientCount(bandCount)), 0.0));
    return coefficients;
}

void addNodes(const BrdfLobe& lobe, const Vec3d& view, const std::vector<LobeNode>& nodes,
              int bandCount, ViewCoefficients& coefficients) {
    std::vector<double> basis(coefficients[0].size());
    for (const LobeNode& node : nodes) {
        const Vec3d weighted =
            evaluateLobe(lobe, node.incident, view) * (node.incident.z * node.solidAngle);
        evaluateSh(node.incident, bandCount, basis);
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t i = 0; i < basis.size(); ++i)
                coefficients[channel][i] += weighted[static_cast<int>(channel)] * basis[i];
    }
}

}  // namespace

BrdfMatrix makeBrdfMatrix(int incidentBandCount, int viewBandCount) {
    PRT_ASSERT(incidentBandCount >= 1 && viewBandCount >= 1, "there is at least one band");
    BrdfMatrix matrix{
        .incidentBandCount = incidentBandCount, .viewBandCount = viewBandCount, .values = {}};
    visitElements(incidentBandCount, viewBandCount,
                  [&](int, int, int, std::size_t) { matrix.values.push_back(0.0); });
    return matrix;
}

std::size_t brdfMatrixIndex(const BrdfMatrix& matrix, int incidentDegree, int viewDegree, int m) {
    const int order = std::abs(m);
    PRT_ASSERT(order <= incidentDegree && incidentDegree < matrix.incidentBandCount,
               "the incident degree is one of the matrix");
    PRT_ASSERT(order <= viewDegree && viewDegree < matrix.viewBandCount,
               "the view's degree is one of the matrix");
    std::size_t start = 0;
    for (int block = 0; block < order; ++block)
        start += static_cast<std::size_t>(matrix.incidentBandCount - block) *
                 static_cast<std::size_t>(matrix.viewBandCount - block);
    return start +
           static_cast<std::size_t>(incidentDegree - order) *
               static_cast<std::size_t>(matrix.viewBandCount - order) +
           static_cast<std::size_t>(viewDegree - order);
}

std::vector<double> expandBrdfMatrix(const BrdfMatrix& matrix) {
    const auto rows = static_cast<std::size_t>(shCoefficientCount(matrix.incidentBandCount));
    const auto columns = static_cast<std::size_t>(shCoefficientCount(matrix.viewBandCount));
    std::vector<double> expanded(rows * columns, 0.0);
    visitElements(matrix.incidentBandCount, matrix.viewBandCount,
                  [&](int m, int incident, int view, std::size_t index) {
                      for (const int order : {-m, m})
                          expanded[indexOf(incident, order) * columns + indexOf(view, order)] =
                              matrix.values[index];
                  });
    return expanded;
}

BrdfMatrix lerpBrdfMatrices(const BrdfMatrix& a, const BrdfMatrix& b, double share) {
    PRT_ASSERT(a.values.size() == b.values.size() && a.incidentBandCount == b.incidentBandCount,
               "the matrices have the same size");
    BrdfMatrix mixed = a;
    for (std::size_t i = 0; i < mixed.values.size(); ++i)
        mixed.values[i] += (b.values[i] - a.values[i]) * share;
    return mixed;
}

void applyBrdfMatrix(const BrdfMatrix& matrix, std::span<const double> incident,
                     std::span<double> exit) {
    PRT_ASSERT(static_cast<int>(incident.size()) == shCoefficientCount(matrix.incidentBandCount) &&
                   static_cast<int>(exit.size()) == shCoefficientCount(matrix.viewBandCount),
               "there is a coefficient a row and a column");
    std::fill(exit.begin(), exit.end(), 0.0);
    visitElements(matrix.incidentBandCount, matrix.viewBandCount,
                  [&](int m, int from, int to, std::size_t index) {
                      exit[indexOf(to, m)] += matrix.values[index] * incident[indexOf(from, m)];
                      if (m > 0)
                          exit[indexOf(to, -m)] +=
                              matrix.values[index] * incident[indexOf(from, -m)];
                  });
}

std::array<std::vector<double>, 3> projectBrdfView(const Brdf& brdf, const Vec3d& view,
                                                   int bandCount,
                                                   const LobeQuadratureOptions& options) {
    PRT_ASSERT(view.z > 0.0, "the view is above the horizon");
    ViewCoefficients coefficients = makeViewCoefficients(bandCount);
    for (const BrdfLobe& lobe : brdf.lobes)
        addNodes(lobe, view, lobeNodes(lobe, view, options), bandCount, coefficients);
    return coefficients;
}

std::array<std::vector<double>, 3> projectUprightView(const Brdf& brdf, const Vec3d& view,
                                                      int bandCount,
                                                      const LobeQuadratureOptions& options) {
    PRT_ASSERT(view.z > 0.0, "the view is above the horizon");
    ViewCoefficients coefficients = makeViewCoefficients(bandCount);
    for (const BrdfLobe& lobe : brdf.lobes)
        addNodes(lobe, view, uprightLobeNodes(lobe, view, options), bandCount, coefficients);
    for (std::vector<double>& channel : coefficients)
        for (int l = 1; l < bandCount; ++l)
            std::fill_n(channel.begin() + shIndex(l, -l), l, 0.0);
    return coefficients;
}

void addBrdfView(const ViewNode& node, std::span<const double> perView, BrdfMatrix& matrix) {
    std::vector<double> basis(static_cast<std::size_t>(shCoefficientCount(matrix.viewBandCount)));
    evaluateSh(node.view, matrix.viewBandCount, basis);
    // Views at azimuth φ see the same turned by φ. With both factors turned, the mean of
    // y_lm y_l'm over φ is half of what it is at azimuth 0, where sines vanish; or all of it.
    visitElements(matrix.incidentBandCount, matrix.viewBandCount,
                  [&](int m, int incident, int view, std::size_t index) {
                      matrix.values[index] += (m == 0 ? 1.0 : 0.5) * node.solidAngle *
                                              perView[indexOf(incident, m)] *
                                              basis[indexOf(view, m)];
                  });
}

std::array<BrdfMatrix, 3> projectBrdf(const Brdf& brdf, const BrdfProjectionOptions& options) {
    std::array<BrdfMatrix, 3> matrices;
    matrices.fill(makeBrdfMatrix(options.incidentBandCount, options.viewBandCount));
    for (const ViewNode& node : viewNodes(options.quadrature)) {
        const auto perView =
            projectUprightView(brdf, node.view, options.incidentBandCount, options.quadrature);
        for (std::size_t channel = 0; channel < 3; ++channel)
            addBrdfView(node, perView[channel], matrices[channel]);
    }
    return matrices;
}

}  // namespace prt

// Bibliography
//   [Sloan02]  Precomputed radiance transfer: the transfer matrix
//   [Sloan08]  Stupid spherical harmonics tricks: product integrals
#include "prt/transport/visibility_matrix.h"

#include <algorithm>
#include <array>

#include "prt/base/assert.h"
#include "prt/basis/sh_product.h"
#include "prt/basis/sh_rotation.h"
#include "prt/math/frame.h"

namespace prt {
namespace {

/// Local from world.
Mat3d rotationIntoFrame(const Vec3f& normal) {
    const Frame<double> frame = frameFromNormal(Vec3d(normal).normalized());
    const Vec3d& t = frame.tangent;
    const Vec3d& b = frame.bitangent;
    const Vec3d& n = frame.normal;
    return {t.x, t.y, t.z, b.x, b.y, b.z, n.x, n.y, n.z};
}

std::size_t countCoefficients(int bandCount) {
    return static_cast<std::size_t>(shCoefficientCount(bandCount));
}

}  // namespace

VisibilityMatrix::VisibilityMatrix(int incidentBandCount, int bandCount)
    : incidentBandCount_(incidentBandCount), bandCount_(bandCount) {
    PRT_ASSERT(incidentBandCount >= 1 && bandCount >= 1 && visibilityBandCount() <= kMaxBandCount,
               "visibility has bands of the tables");
    const std::size_t rowCount = countCoefficients(incidentBandCount);
    const std::size_t columnCount = countCoefficients(bandCount);
    std::vector<std::vector<Term>> terms(rowCount * columnCount);

    // A triple stands for all different orders of its three indices.
    const ShTripling tripling(visibilityBandCount());
    for (const ShTriple& triple : tripling.triples()) {
        std::array<std::uint16_t, 3> order = {triple.i, triple.j, triple.k};
        do {
            const auto [i, j, k] = order;
            if (i < rowCount && j < columnCount)
                terms[j * rowCount + i].push_back({k, static_cast<float>(triple.integral)});
        } while (std::next_permutation(order.begin(), order.end()));
    }
    terms_ = std::move(terms);
}

void VisibilityMatrix::make(std::span<const float> visibility, const Vec3f& normal,
                            std::span<float> scratch, std::span<float> matrix) const {
    PRT_ASSERT(visibility.size() == countCoefficients(visibilityBandCount()) &&
                   scratch.size() == elementCount() && matrix.size() == elementCount(),
               "one number an element");
    // Multiply every y_j by the visibility.
    for (std::size_t element = 0; element < scratch.size(); ++element) {
        float sum = 0.0f;
        for (const Term& term : terms_[element])
            sum += term.integral * visibility[term.visibilityIndex];
        scratch[element] = sum;
    }
    // Turn what is visible of it into the local frame.
    rotateSh(rotationIntoFrame(normal), incidentBandCount_, scratch, scratch);
    const std::size_t rowCount = countCoefficients(incidentBandCount_);
    const std::size_t columnCount = countCoefficients(bandCount_);
    for (std::size_t i = 0; i < rowCount; ++i)
        for (std::size_t j = 0; j < columnCount; ++j)
            matrix[i * columnCount + j] = scratch[j * rowCount + i];
}

}  // namespace prt

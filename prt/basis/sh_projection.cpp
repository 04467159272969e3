#include "prt/basis/sh_projection.h"

#include "prt/base/assert.h"
#include "prt/math/quadrature.h"

namespace prt {

std::vector<double> projectSh(const std::function<double(const Vec3d&)>& function, int bandCount,
                              int degree) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(degree >= 0, "a polynomial has a degree");
    std::vector<double> coefficients(static_cast<std::size_t>(shCoefficientCount(bandCount)), 0.0);
    std::vector<double> values(coefficients.size());
    for (const auto& [direction, weight] : sphereQuadrature(degree + bandCount - 1)) {
        const double weighted = weight * function(direction);
        evaluateSh(direction, bandCount, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            coefficients[i] += weighted * values[i];
    }
    return coefficients;
}

}  // namespace prt

#pragma once

#include <span>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/basis/sh_product.h"

namespace prt {

struct ShSamplerOptions {
    int depth = 6;              ///< the sphere is cut into 2^depth by 2^(depth+1) cells
    double uniformShare = 0.0;  ///< in [0, 1], of the samples spread evenly: above 0, every
                                ///< direction may be drawn, as unbiased estimates need
};

/// A direction and the density per steradian with which it is drawn.
struct ShSample {
    Vec3d direction{0.0, 0.0, 1.0};  ///< unit
    double density = 0.0;
};

/// Draws directions in proportion to max(Σ_i c_i y_i, 0) [Jarosz09].
///
/// The density is constant in each cell of a grid of equal steps in z and azimuth, where it follows
/// the exact integral of the function over the cell; cells with a negative integral are not drawn.
/// A function without a positive cell is drawn evenly. Differs from the paper: negative cells are
/// left out on the finest level alone, so that the density does not depend on the way to a cell.
class ShSampler {
  public:
    /// @param coefficients  n²
    /// @param bandCount     n ≥ 1
    ShSampler(std::span<const double> coefficients, int bandCount,
              const ShSamplerOptions& options = {});

    /// Warps a point of the unit square through the cells, halves by halves: points that are evenly
    /// spread stay so.
    ///
    /// @param u, v  in [0, 1)
    ShSample sample(double u, double v) const;

    /// @param direction  unit
    double density(const Vec3d& direction) const;

  private:
    int depth_;
    std::vector<std::vector<double>> levels_;  // sums of 2^k by 2^(k+1) cells, row-major
};

/// Draws in proportion to the positive part of a product of two functions, as far as its first n
/// bands tell (see ShTripling).
///
/// @param a, b  n² coefficients each
ShSampler makeShProductSampler(const ShTripling& tripling, std::span<const double> a,
                               std::span<const double> b, const ShSamplerOptions& options = {});

}  // namespace prt

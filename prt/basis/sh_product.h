#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/basis/sh.h"

namespace prt {

/// A product integral of three basis functions that is not zero, ∫ y_i y_j y_k dω. It is the same
/// in any order: i ≤ j ≤ k.
struct ShTriple {
    std::uint16_t i = 0;
    std::uint16_t j = 0;
    std::uint16_t k = 0;
    double integral = 0.0;
};

/// The sparse tensor of product integrals of n bands, and products of functions by it [Sloan08,
/// appendix A4].
///
/// Integrals are found by a quadrature that is exact for them. Most are zero: where degrees or
/// orders do not match, and in few other places.
class ShTripling {
  public:
    /// @param bandCount  n in [1, kMaxBandCount]
    explicit ShTripling(int bandCount);

    int bandCount() const { return bandCount_; }

    /// Sorted by i, then j, then k.
    std::span<const ShTriple> triples() const& { return triples_; }
    std::span<const ShTriple> triples() && = delete;

    /// Projects the product of two functions back onto n bands:
    ///
    ///   c_k = ∫ (Σ a_i y_i) (Σ b_j y_j) y_k dω = Σ_ij a_i b_j ∫ y_i y_j y_k dω
    ///
    /// The product itself has 2n − 1 bands: those beyond n are lost.
    ///
    /// @param a, b     n² coefficients each
    /// @param product  n² numbers, written; must not overlap a or b
    void multiply(std::span<const double> a, std::span<const double> b,
                  std::span<double> product) const;

    /// The matrix that multiplies by one function, M_kj = Σ_i a_i ∫ y_i y_j y_k dω: for a function
    /// that stays while others change, such as visibility under moving light.
    ///
    /// @param a  n² coefficients
    /// @return   n² × n², symmetric, row-major
    std::vector<double> makeProductMatrix(std::span<const double> a) const;

  private:
    int bandCount_;
    std::vector<ShTriple> triples_;
};

}  // namespace prt

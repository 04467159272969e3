#pragma once

#include <span>
#include <vector>

namespace prt {

/// Less leaves less error above the horizon, and makes coefficients larger.
inline constexpr double kHorizonFitWeight = 0.01;

/// From coefficients f_i of a function that is 0 below the horizon to those of a better one.
///
/// Where nothing comes in from below, a function need only be right above it. What is least in
///
///   ∫ over the upper hemisphere (g − Σ f̃_i y_i)² dω + ε ∫ over the lower (Σ f̃_i y_i)² dω
///
/// is f̃ = ((1 − ε) H + ε 1)⁻¹ f, H_ij = ∫ over the upper hemisphere y_i y_j dω    [Sloan03]
///
/// ε = 1 leaves f as it is. Differs from the paper, where ε is 0: coefficients, and with them the
/// noise that stored radiance brings in, would become large [Lam06].
class HorizonFit {
  public:
    /// @param weight  ε, in (0, 1]
    explicit HorizonFit(int bandCount, double weight = kHorizonFitWeight);

    /// @param coefficients  n² numbers: f, and then f̃
    void apply(std::span<double> coefficients) const;

  private:
    int bandCount_;
    std::vector<std::vector<double>> factors_;  // of Cholesky, for each |m|: [l − m][l' − m]
};

}  // namespace prt

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Draws indices with given probabilities in constant time [Vose91].
class AliasTable {
  public:
    /// @param weights  at least one; finite, not negative; all 0 draws every index alike
    explicit AliasTable(std::span<const double> weights);

    /// @param u  uniform in [0, 1)
    std::size_t sample(double u) const;

    double probability(std::size_t index) const { return probabilities_[index]; }

  private:
    /// A column of equal probability that two indices share: its own and another.
    struct Column {
        double ownShare = 1.0;
        std::uint32_t other = 0;
    };

    std::vector<double> probabilities_;
    std::vector<Column> columns_;
};

}  // namespace prt

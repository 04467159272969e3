// Bibliography
//   [Ivanic96]  Rotation matrices for real spherical harmonics. Direct determination by recursion
//   [Ivanic98]  Additions and corrections to the above
#include "prt/basis/sh_rotation.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

/// Entries in the blocks of the degrees below l: Σ (2k+1)² = l (4l² − 1) / 3.
constexpr std::size_t blockOffset(int l) {
    return static_cast<std::size_t>(l * (4 * l * l - 1) / 3);
}

/// A finished block of degree l, rows and columns numbered −l … l.
struct Block {
    const double* centre;  // entry (0, 0)
    int degree;

    const double* row(int m) const { return centre + m * (2 * degree + 1); }
    double at(int m, int k) const { return row(m)[k]; }
};

/// Adds factor · _iP^l_{a·} of [Ivanic98, table 2] to a row of the block of degree l: row a of the
/// block below, combined with row i of the block of degree 1.
void addProducts(const Block& first, const Block& below, int i, int a, double factor, double* row) {
    const int l = below.degree + 1;
    const double* source = below.row(a);
    const double minus = factor * first.at(i, -1);
    const double zero = factor * first.at(i, 0);
    const double plus = factor * first.at(i, 1);
    row[-l] += plus * source[1 - l] + minus * source[l - 1];
    for (int k = 1 - l; k < l; ++k)
        row[k] += zero * source[k];
    row[l] += plus * source[l - 1] - minus * source[1 - l];
}

/// Row m of the block of degree l up to the column factors: u U + v V + w W of
/// [Ivanic98, tables 1 and 2].
void computeRow(const Block& first, const Block& below, int m, double* row) {
    const int l = below.degree + 1;
    const int size = std::abs(m);
    const double u = std::sqrt(static_cast<double>((l + size) * (l - size)));
    const double v = 0.5 * std::sqrt(static_cast<double>((l + size - 1) * (l + size)));
    const double w = -0.5 * std::sqrt(static_cast<double>((l - size - 1) * (l - size)));

    if (size < l) addProducts(first, below, 0, m, u, row);
    if (m == 0) {
        addProducts(first, below, 1, 1, -std::numbers::sqrt2 * v, row);
        addProducts(first, below, -1, -1, -std::numbers::sqrt2 * v, row);
        return;
    }
    const int sign = m > 0 ? 1 : -1;
    if (size == 1) {
        addProducts(first, below, sign, 0, std::numbers::sqrt2 * v, row);
    } else {
        addProducts(first, below, 1, m - sign, v, row);
        addProducts(first, below, -1, sign - m, -sign * v, row);
    }
    if (size < l - 1) {
        addProducts(first, below, 1, m + sign, w, row);
        addProducts(first, below, -1, -m - sign, sign * w, row);
    }
}

/// What the entries of each column are multiplied by: 1/√((l+k)(l−k)), or
/// 1/√(2l(2l−1)) at the two edges.
std::vector<double> computeColumnFactors(int l) {
    const double edge = 1.0 / std::sqrt(static_cast<double>(2 * l * (2 * l - 1)));
    std::vector<double> factors(static_cast<std::size_t>(2 * l + 1), edge);
    for (int k = 1 - l; k < l; ++k) {
        factors[static_cast<std::size_t>(k + l)] =
            1.0 / std::sqrt(static_cast<double>((l + k) * (l - k)));
    }
    return factors;
}

}  // namespace

ShRotation::ShRotation(const Mat3d& rotation, int bandCount)
    : bandCount_(bandCount), blocks_(blockOffset(bandCount), 0.0) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    const auto centre = [this](int l) {
        return blocks_.data() + blockOffset(l) + static_cast<std::size_t>(2 * l * (l + 1));
    };
    *centre(0) = 1.0;
    if (bandCount == 1) return;

    // The functions of degree 1 are −y, z and −x (C2). These two signs are all that the
    // phase changes: the recurrence hands them on, since the orders of its factors add
    // up to the order of the product.
    constexpr int kAxes[3] = {1, 2, 0};
    for (int m = -1; m <= 1; ++m) {
        for (int k = -1; k <= 1; ++k) {
            const double phase = (m + k) % 2 == 0 ? 1.0 : -1.0;
            centre(1)[3 * m + k] = phase * rotation[kAxes[m + 1]][kAxes[k + 1]];
        }
    }
    for (int l = 2; l < bandCount; ++l) {
        const std::vector<double> columnFactors = computeColumnFactors(l);
        for (int m = -l; m <= l; ++m) {
            double* const row = centre(l) + m * (2 * l + 1);
            computeRow({centre(1), 1}, {centre(l - 1), l - 1}, m, row);
            for (int k = -l; k <= l; ++k)
                row[k] *= columnFactors[static_cast<std::size_t>(k + l)];
        }
    }
}

double ShRotation::entry(int l, int m, int k) const {
    PRT_ASSERT(l >= 0 && l < bandCount_ && std::abs(m) <= l && std::abs(k) <= l,
               "the entry lies in a block");
    return blocks_[blockOffset(l) + static_cast<std::size_t>((m + l) * (2 * l + 1) + k + l)];
}

void ShRotation::apply(std::span<const double> source, std::span<double> rotated) const {
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount_));
    PRT_ASSERT(source.size() == count && rotated.size() == count,
               "there is one coefficient a function");
    const double* entries = blocks_.data();
    for (int l = 0; l < bandCount_; ++l) {
        const double* const band = source.data() + l * l;
        for (int m = -l; m <= l; ++m) {
            double sum = 0.0;
            for (int k = 0; k <= 2 * l; ++k)
                sum += *entries++ * band[k];
            rotated[static_cast<std::size_t>(shIndex(l, m))] = sum;
        }
    }
}

}  // namespace prt

// Bibliography
//   [Ng04]  Triple product wavelet integrals for all-frequency relighting
#include "prt/basis/haar_product.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr double signOf(HaarType type, bool right, bool bottom) {
    const bool falls = type == HaarType::horizontal ? right
                       : type == HaarType::vertical ? bottom
                                                    : right != bottom;
    return falls ? -1.0 : 1.0;
}

/// The value, on the unit square, of a wavelet over the square of a finer one; 0 where it is not.
double valueOver(const HaarFunction& coarse, const HaarFunction& fine) {
    const int steps = fine.level - coarse.level;
    if (steps <= 0 || fine.x >> steps != coarse.x || fine.y >> steps != coarse.y) return 0.0;
    const bool right = (fine.x >> (steps - 1)) & 1, bottom = (fine.y >> (steps - 1)) & 1;
    return signOf(coarse.type, right, bottom) * (1 << coarse.level);
}

bool areOnOneSquare(const HaarFunction& a, const HaarFunction& b) {
    return a.level == b.level && a.x == b.x && a.y == b.y;
}

/// One number for each of a square's wavelets.
struct Wavelets {
    float horizontal, vertical, diagonal;
};

/// One number for each quadrant: top left, top right, bottom left, bottom right.
using Quadrants = std::array<float, 4>;

/// What the wavelets of a square of level 0 are on its quadrants.
Quadrants spread(const Wavelets& w) {
    return {w.horizontal + w.vertical + w.diagonal, -w.horizontal + w.vertical - w.diagonal,
            w.horizontal - w.vertical - w.diagonal, -w.horizontal - w.vertical + w.diagonal};
}

/// The transpose of spread.
Wavelets collect(const Quadrants& q) {
    return {q[0] - q[1] + q[2] - q[3], q[0] + q[1] - q[2] - q[3], q[0] - q[1] - q[2] + q[3]};
}

/// Multiplies on the tree of squares, in the normalisation of the unit square.
class TreeProduct {
  public:
    TreeProduct(std::span<const float> a, std::span<const float> b, std::span<float> product)
        : a_(a),
          b_(b),
          product_(product),
          normalisation_(1.0f / static_cast<float>(1 << std::countr_zero(a.size()) / 2)) {}

    void multiply() {
        const float shared = a_.size() > 1 ? multiplySquare(0, 0, 0, a_[0], b_[0]) : 0.0f;
        product_[0] = normalisation_ * (a_[0] * b_[0] + shared);
    }

  private:
    /// @param meanA, meanB  what the coarser functions add up to on the square
    /// @return              Σ a_i b_i over the wavelets of the square and of those in it
    float multiplySquare(int level, int x, int y, float meanA, float meanB) {
        const std::size_t plane = std::size_t(1) << 2 * level;
        const std::size_t i = plane + static_cast<std::size_t>((y << level) + x);
        const auto height = static_cast<float>(1 << level);
        const Wavelets a{a_[i], a_[i + plane], a_[i + 2 * plane]};
        const Wavelets b{b_[i], b_[i + plane], b_[i + 2 * plane]};

        Quadrants shared{};
        if (4 * plane < a_.size()) {
            const Quadrants stepA = spread(a), stepB = spread(b);
            for (int q = 0; q < 4; ++q) {
                const auto c = static_cast<std::size_t>(q);
                shared[c] = multiplySquare(level + 1, 2 * x + q % 2, 2 * y + q / 2,
                                           meanA + height * stepA[c], meanB + height * stepB[c]);
            }
        }

        // A wavelet with itself and coarser ones; the two other types; finer ones with themselves.
        const Wavelets finer = collect(shared);
        const auto add = [&](float ownA, float ownB, float others, float fine) {
            return normalisation_ * (meanA * ownB + meanB * ownA + height * (others + fine));
        };
        product_[i] = add(a.horizontal, b.horizontal,
                          a.vertical * b.diagonal + a.diagonal * b.vertical, finer.horizontal);
        product_[i + plane] =
            add(a.vertical, b.vertical, a.horizontal * b.diagonal + a.diagonal * b.horizontal,
                finer.vertical);
        product_[i + 2 * plane] =
            add(a.diagonal, b.diagonal, a.horizontal * b.vertical + a.vertical * b.horizontal,
                finer.diagonal);
        return a.horizontal * b.horizontal + a.vertical * b.vertical + a.diagonal * b.diagonal +
               shared[0] + shared[1] + shared[2] + shared[3];
    }

    std::span<const float> a_, b_;
    std::span<float> product_;
    float normalisation_;
};

}  // namespace

double haarTriplingCoefficient(int i, int j, int k) {
    std::array<int, 3> sorted = {i, j, k};  // coarse before fine
    std::sort(sorted.begin(), sorted.end());
    const auto [coarse, middle, fine] = sorted;
    PRT_ASSERT(coarse >= 0, "indices are not negative");
    if (coarse == 0) return middle == fine ? 1.0 : 0.0;
    if (middle == fine) return valueOver(haarFunction(coarse), haarFunction(fine));
    const HaarFunction first = haarFunction(coarse), second = haarFunction(middle);
    const bool allTypes = coarse != middle && areOnOneSquare(first, second) &&
                          areOnOneSquare(second, haarFunction(fine));
    return allTypes ? 1 << first.level : 0.0;
}

void multiplyHaar(std::span<const float> a, std::span<const float> b, std::span<float> product) {
    PRT_ASSERT(isHaarCount(a.size()), "the side of the square is a power of two");
    PRT_ASSERT(b.size() == a.size() && product.size() == a.size(), "S² coefficients each");
    TreeProduct(a, b, product).multiply();
}

double integrateHaarTriple(std::span<const float> a, std::span<const float> b,
                           std::span<const float> c) {
    PRT_ASSERT(c.size() == a.size(), "S² coefficients each");
    std::vector<float> product(a.size());
    multiplyHaar(a, b, product);
    double sum = 0.0;
    for (std::size_t k = 0; k < c.size(); ++k)
        sum += static_cast<double>(product[k]) * c[k];
    return sum;
}

}  // namespace prt

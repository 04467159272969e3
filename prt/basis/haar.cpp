// Bibliography
//   [Stollnitz95]  Wavelets for computer graphics: a primer, part 1 (non-standard decomposition)
//   [Ng03]         All-frequency shadows using non-linear wavelet lighting approximation
#include "prt/basis/haar.h"

#include <utility>
#include <vector>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// The planes of coefficients of one level, each side × side.
template <class Value>
struct Planes {
    std::size_t side;
    Value* scaled;  ///< coefficients of scaling functions of the level's squares
    Value* horizontal;
    Value* vertical;
    Value* diagonal;
};

/// Where the wavelets of the level with so many squares along a side lie.
template <class Value>
Planes<Value> planesOf(std::size_t side, Value* scaled, Value* coefficients) {
    const std::size_t plane = side * side;
    return {side, scaled, coefficients + plane, coefficients + 2 * plane, coefficients + 3 * plane};
}

/// Takes the quadrants of each square, 2 side × 2 side of them, to its coefficients.
template <class Value>
void splitSquares(const Value* quadrants, const Planes<Value>& level) {
    for (std::size_t y = 0; y < level.side; ++y) {
        const Value* top = quadrants + 4 * y * level.side;
        const Value* bottom = top + 2 * level.side;
        const std::size_t row = y * level.side;
        for (std::size_t x = 0; x < level.side; ++x) {
            const Value left = top[2 * x] + bottom[2 * x];
            const Value right = top[2 * x + 1] + bottom[2 * x + 1];
            const Value leftFall = top[2 * x] - bottom[2 * x];
            const Value rightFall = top[2 * x + 1] - bottom[2 * x + 1];
            level.scaled[row + x] = (left + right) * 0.5f;
            level.horizontal[row + x] = (left - right) * 0.5f;
            level.vertical[row + x] = (leftFall + rightFall) * 0.5f;
            level.diagonal[row + x] = (leftFall - rightFall) * 0.5f;
        }
    }
}

/// Undoes splitSquares.
template <class Value>
void joinSquares(const Planes<const Value>& level, Value* quadrants) {
    for (std::size_t y = 0; y < level.side; ++y) {
        Value* top = quadrants + 4 * y * level.side;
        Value* bottom = top + 2 * level.side;
        const std::size_t row = y * level.side;
        for (std::size_t x = 0; x < level.side; ++x) {
            const Value left = (level.scaled[row + x] + level.horizontal[row + x]) * 0.5f;
            const Value right = (level.scaled[row + x] - level.horizontal[row + x]) * 0.5f;
            const Value leftFall = (level.vertical[row + x] + level.diagonal[row + x]) * 0.5f;
            const Value rightFall = (level.vertical[row + x] - level.diagonal[row + x]) * 0.5f;
            top[2 * x] = left + leftFall;
            top[2 * x + 1] = right + rightFall;
            bottom[2 * x] = left - leftFall;
            bottom[2 * x + 1] = right - rightFall;
        }
    }
}

void checkSizes(std::size_t texelCount, std::size_t coefficientCount) {
    PRT_ASSERT(texelCount == coefficientCount, "as many coefficients as texels");
    PRT_ASSERT(isHaarCount(texelCount), "the side of the square is a power of two");
}

std::size_t sideOf(std::size_t count) {
    return std::size_t(1) << (std::countr_zero(count) / 2);
}

template <class Value>
void project(std::span<const Value> texels, std::span<Value> coefficients) {
    checkSizes(texels.size(), coefficients.size());
    if (texels.size() == 1) {
        coefficients[0] = texels[0];
        return;
    }
    // From fine to coarse: the scaling coefficients of a level are the quadrants of the one above.
    std::vector<Value> scaled(texels.size() / 4), coarser(texels.size() / 16);
    const Value* quadrants = texels.data();
    for (std::size_t side = sideOf(texels.size()) / 2; side > 0; side /= 2) {
        Value* destination = side > 1 ? scaled.data() : coefficients.data();
        splitSquares(quadrants, planesOf(side, destination, coefficients.data()));
        quadrants = destination;
        std::swap(scaled, coarser);
    }
}

template <class Value>
void reconstruct(std::span<const Value> coefficients, std::span<Value> texels) {
    checkSizes(texels.size(), coefficients.size());
    if (texels.size() == 1) {
        texels[0] = coefficients[0];
        return;
    }
    // From coarse to fine: the quadrants of a level are the scaling coefficients of the one below.
    std::vector<Value> quadrants(texels.size() / 4), finer(texels.size() / 4);
    const Value* scaled = coefficients.data();
    const std::size_t finest = sideOf(texels.size()) / 2;
    for (std::size_t side = 1; side <= finest; side *= 2) {
        Value* destination = side < finest ? finer.data() : texels.data();
        joinSquares(planesOf(side, scaled, coefficients.data()), destination);
        scaled = destination;
        std::swap(quadrants, finer);
    }
}

}  // namespace

void projectHaar(std::span<const float> texels, std::span<float> coefficients) {
    project(texels, coefficients);
}

void projectHaar(std::span<const Vec3f> texels, std::span<Vec3f> coefficients) {
    project(texels, coefficients);
}

void reconstructHaar(std::span<const float> coefficients, std::span<float> texels) {
    reconstruct(coefficients, texels);
}

void reconstructHaar(std::span<const Vec3f> coefficients, std::span<Vec3f> texels) {
    reconstruct(coefficients, texels);
}

}  // namespace prt

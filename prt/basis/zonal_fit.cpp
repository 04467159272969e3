// Bibliography
//   [Sloan05]  Local, deformable precomputed radiance transfer
#include "prt/basis/zonal_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"

namespace prt {
namespace {

using Axes = std::vector<Vec3d>;

double sumSquares(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value * value;
    return sum;
}

/// Solves A x = b for a positive semidefinite A with a diagonal of about 1, by Cholesky's method
/// with pivots; unknowns whose pivot is lost in rounding are set to 0.
///
/// @param matrix  A, row-major
std::vector<double> solveSemidefinite(std::vector<double> matrix, std::vector<double> rightSide) {
    constexpr double kLeastPivot = 1e-9;
    const std::size_t size = rightSide.size();
    std::vector<std::size_t> order;  // of the pivots
    std::vector<bool> isDone(size, false);
    for (std::size_t step = 0; step < size; ++step) {
        std::size_t pivot = size;
        for (std::size_t i = 0; i < size; ++i) {
            if (!isDone[i] &&
                (pivot == size || matrix[i * size + i] > matrix[pivot * size + pivot]))
                pivot = i;
        }
        if (matrix[pivot * size + pivot] < kLeastPivot) break;
        isDone[pivot] = true;
        order.push_back(pivot);
        for (std::size_t i = 0; i < size; ++i) {
            if (isDone[i]) continue;
            const double factor = matrix[i * size + pivot] / matrix[pivot * size + pivot];
            for (std::size_t j = 0; j < size; ++j)
                matrix[i * size + j] -= factor * matrix[pivot * size + j];
            rightSide[i] -= factor * rightSide[pivot];
        }
    }
    std::vector<double> solution(size, 0.0);
    for (auto pivot = order.rbegin(); pivot != order.rend(); ++pivot) {
        double sum = rightSide[*pivot];
        for (auto later = order.rbegin(); later != pivot; ++later)
            sum -= matrix[*pivot * size + *later] * solution[*later];
        solution[*pivot] = sum / matrix[*pivot * size + *pivot];
    }
    return solution;
}

/// The best lobes about given axes, and what they leave of the function.
struct Projection {
    Axes axes;
    std::vector<double> zonal;     ///< [band][lobe]
    std::vector<double> residual;  ///< n²
    double squaredError = 0.0;
};

/// Band by band, with the functions √(4π/(2l+1)) y_lm(a_i) for columns: their products are
/// P_l(a_i·a_j).
Projection projectOntoAxes(std::span<const double> coefficients, const Axes& axes) {
    const std::size_t lobeCount = axes.size();
    Projection projection{axes, {}, {coefficients.begin(), coefficients.end()}, 0.0};
    const int bandCount = shDegree(static_cast<int>(coefficients.size()) - 1) + 1;
    std::vector<double> values(coefficients.size() * lobeCount);
    for (std::size_t i = 0; i < lobeCount; ++i)
        evaluateSh(axes[i], bandCount,
                   std::span(values).subspan(i * coefficients.size(), coefficients.size()));

    for (int l = 0; l < bandCount; ++l) {
        const double scale = 4.0 * std::numbers::pi / (2 * l + 1);
        const auto begin = static_cast<std::size_t>(shCoefficientCount(l));
        const auto end = static_cast<std::size_t>(shCoefficientCount(l + 1));
        const auto column = [&](std::size_t lobe) { return &values[lobe * coefficients.size()]; };
        std::vector<double> gram(lobeCount * lobeCount), rightSide(lobeCount);
        for (std::size_t i = 0; i < lobeCount; ++i) {
            for (std::size_t k = begin; k < end; ++k)
                rightSide[i] += std::sqrt(scale) * column(i)[k] * coefficients[k];
            for (std::size_t j = 0; j < lobeCount; ++j) {
                for (std::size_t k = begin; k < end; ++k)
                    gram[i * lobeCount + j] += scale * column(i)[k] * column(j)[k];
            }
        }
        const std::vector<double> solution = solveSemidefinite(gram, rightSide);
        for (std::size_t i = 0; i < lobeCount; ++i) {
            for (std::size_t k = begin; k < end; ++k)
                projection.residual[k] -= solution[i] * std::sqrt(scale) * column(i)[k];
        }
        projection.zonal.insert(projection.zonal.end(), solution.begin(), solution.end());
    }
    projection.squaredError = sumSquares(projection.residual);
    return projection;
}

/// Turns each axis by a small vector in the plane across it. @param step  two numbers an axis
Axes turnAxes(const Axes& axes, std::span<const double> step) {
    Axes turned;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Frame<double> frame = frameFromNormal(axes[i]);
        turned.push_back((axes[i] + frame.tangent * step[2 * i] + frame.bitangent * step[2 * i + 1])
                             .normalized());
    }
    return turned;
}

/// How the residual changes with each of the 2k numbers of a turn, by central differences.
std::vector<std::vector<double>> differentiate(std::span<const double> coefficients,
                                               const Axes& axes) {
    constexpr double kStep = 1e-5;  // leaves an error of its square
    std::vector<std::vector<double>> derivatives;
    std::vector<double> step(2 * axes.size(), 0.0);
    for (double& entry : step) {
        entry = kStep;
        std::vector<double> derivative =
            projectOntoAxes(coefficients, turnAxes(axes, step)).residual;
        entry = -kStep;
        const auto behind = projectOntoAxes(coefficients, turnAxes(axes, step)).residual;
        entry = 0.0;
        for (std::size_t i = 0; i < derivative.size(); ++i)
            derivative[i] = (derivative[i] - behind[i]) / (2.0 * kStep);
        derivatives.push_back(std::move(derivative));
    }
    return derivatives;
}

/// A step of Levenberg and Marquardt, in units in which every derivative has length 1.
std::vector<double> findStep(const std::vector<std::vector<double>>& derivatives,
                             std::span<const double> residual, double damping) {
    const std::size_t size = derivatives.size();
    const auto dot = [](std::span<const double> a, std::span<const double> b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += a[i] * b[i];
        return sum;
    };
    std::vector<double> matrix(size * size), rightSide(size), lengths(size);
    for (std::size_t i = 0; i < size; ++i) {
        lengths[i] = std::sqrt(std::max(dot(derivatives[i], derivatives[i]), 1e-300));
        rightSide[i] = -dot(derivatives[i], residual) / lengths[i];
        for (std::size_t j = 0; j <= i; ++j) {
            matrix[i * size + j] = dot(derivatives[i], derivatives[j]) / (lengths[i] * lengths[j]);
            matrix[j * size + i] = matrix[i * size + j];
        }
        matrix[i * size + i] += damping;
    }
    std::vector<double> step = solveSemidefinite(matrix, rightSide);
    for (std::size_t i = 0; i < size; ++i)
        step[i] /= lengths[i];
    return step;
}

/// Turns the axes until the error falls no more.
Projection descend(std::span<const double> coefficients, const Axes& start) {
    constexpr int kMaxStepCount = 100;
    constexpr double kMaxDamping = 1e8;
    constexpr double kLeastGain = 1e-12;  // of the error, and of the function
    const double floor = 1e-30 * sumSquares(coefficients);
    Projection best = projectOntoAxes(coefficients, start);
    double damping = 1e-2;
    for (int count = 0; count < kMaxStepCount && best.squaredError > floor; ++count) {
        const auto derivatives = differentiate(coefficients, best.axes);
        Projection next = best;
        while (damping < kMaxDamping) {
            const auto step = findStep(derivatives, best.residual, damping);
            next = projectOntoAxes(coefficients, turnAxes(best.axes, step));
            if (next.squaredError < best.squaredError) break;
            damping *= 4.0;
        }
        const double gain = best.squaredError - next.squaredError;
        if (gain <= 0.0) break;
        const bool isLast = gain < kLeastGain * best.squaredError;
        best = std::move(next);
        if (isLast) break;
        damping = std::max(0.1 * damping, 1e-12);
    }
    return best;
}

/// The direction, of some all round, about which one lobe takes most of a function.
Vec3d findBestAxis(std::span<const double> coefficients) {
    constexpr std::uint32_t kDirectionCount = 512;
    Vec3d best(0.0, 0.0, 1.0);
    double leastError = sumSquares(coefficients);
    for (std::uint32_t i = 0; i < kDirectionCount; ++i) {
        const SquareBits point = sobolPoint(i);
        const Vec3d axis =
            Vec3d(sampleUniformSphere(unitFloatFromBits(point.x), unitFloatFromBits(point.y)))
                .normalized();
        const double error = projectOntoAxes(coefficients, {axis}).squaredError;
        if (error < leastError) {
            leastError = error;
            best = axis;
        }
    }
    return best;
}

Vec3d randomAxis(RandomStream& random) {
    const float u = unitFloatFromBits(random.nextBits());
    return Vec3d(sampleUniformSphere(u, unitFloatFromBits(random.nextBits()))).normalized();
}

/// The best fit with a lobe more than the last.
Projection addLobe(std::span<const double> coefficients, const Projection& last,
                   const ZonalFitOptions& options) {
    const std::size_t lobeCount = last.axes.size() + 1;
    const auto startFromLast = [&](const Vec3d& axis) {
        Axes axes = last.axes;
        axes.push_back(axis);
        return descend(coefficients, axes);
    };
    Projection best = startFromLast(findBestAxis(last.residual));
    const auto keepBetter = [&](Projection other) {
        if (other.squaredError < best.squaredError) best = std::move(other);
    };
    if (coefficients.size() >= 4)
        keepBetter(startFromLast(
            optimalLinearDirection(std::span<const double, 3>(last.residual.data() + 1, 3))));
    RandomStream random(options.seed, lobeCount);
    const double nothing = 1e-24 * sumSquares(coefficients);
    for (int start = 0; start < options.startCount && best.squaredError > nothing; ++start) {
        Axes axes;
        for (std::size_t i = 0; i < lobeCount; ++i)
            axes.push_back(randomAxis(random));
        keepBetter(descend(coefficients, axes));
    }
    return best;
}

/// The lobe of this number, its axis turned round if the first degree would be negative.
ZonalLobe makeLobe(const Projection& projection, std::size_t index) {
    ZonalLobe lobe{projection.axes[index], {}};
    for (std::size_t k = index; k < projection.zonal.size(); k += projection.axes.size())
        lobe.zonal.push_back(projection.zonal[k]);
    if (lobe.zonal.size() > 1 && lobe.zonal[1] < 0.0) {
        lobe.axis = -lobe.axis;
        for (std::size_t l = 1; l < lobe.zonal.size(); l += 2)
            lobe.zonal[l] = -lobe.zonal[l];
    }
    return lobe;
}

}  // namespace

void expandZonalLobes(std::span<const ZonalLobe> lobes, std::span<double> coefficients) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    std::vector<double> turned(coefficients.size());
    for (const ZonalLobe& lobe : lobes) {
        PRT_ASSERT(lobe.zonal.size() * lobe.zonal.size() == coefficients.size(),
                   "n zonal coefficients for n² of the function");
        rotateZonal(lobe.zonal, lobe.axis, turned);
        for (std::size_t i = 0; i < turned.size(); ++i)
            coefficients[i] += turned[i];
    }
}

ZonalFit fitZonalLobes(std::span<const double> coefficients, const ZonalFitOptions& options) {
    const int bandCount = shDegree(static_cast<int>(coefficients.size()) - 1) + 1;
    PRT_ASSERT(!coefficients.empty() &&
                   coefficients.size() == static_cast<std::size_t>(shCoefficientCount(bandCount)),
               "n² coefficients");
    PRT_ASSERT(options.lobeCount >= 1 && options.startCount >= 0, "at least one lobe");

    Projection projection = projectOntoAxes(coefficients, {});
    for (int lobeCount = 1; lobeCount <= options.lobeCount; ++lobeCount)
        projection = addLobe(coefficients, projection, options);

    ZonalFit fit;
    for (std::size_t i = 0; i < projection.axes.size(); ++i)
        fit.lobes.push_back(makeLobe(projection, i));
    std::vector<double> difference(coefficients.size());
    expandZonalLobes(fit.lobes, difference);
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] -= coefficients[i];
    const double squaredSum = sumSquares(coefficients);
    if (squaredSum > 0.0) fit.relativeError = std::sqrt(sumSquares(difference) / squaredSum);
    return fit;
}

}  // namespace prt

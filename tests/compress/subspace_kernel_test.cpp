#include "prt/compress/subspace_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "prt/base/random.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

// Of the squared length: sums of floats.
constexpr double kRounding = 3e-6;

/// Axes made orthonormal one after another.
Subspace makeSubspace(std::size_t dimension, std::size_t axisCount, RandomStream& random) {
    Subspace subspace;
    for (std::size_t j = 0; j < dimension; ++j)
        subspace.mean.push_back(0.3 * drawNormal(random));
    for (std::size_t p = 0; p < axisCount; ++p) {
        std::vector<double> axis;
        for (std::size_t j = 0; j < dimension; ++j)
            axis.push_back(drawNormal(random));
        for (std::size_t q = 0; q < p; ++q) {
            double dot = 0.0;
            for (std::size_t j = 0; j < dimension; ++j)
                dot += axis[j] * subspace.axes[q * dimension + j];
            for (std::size_t j = 0; j < dimension; ++j)
                axis[j] -= dot * subspace.axes[q * dimension + j];
        }
        double squares = 0.0;
        for (const double number : axis)
            squares += number * number;
        for (const double number : axis)
            subspace.axes.push_back(number / std::sqrt(squares));
    }
    return subspace;
}

/// ‖y − ŷ‖².
double measureDistance(std::span<const double> y, const Subspace& subspace) {
    std::vector<double> left(y.begin(), y.end());
    for (std::size_t j = 0; j < y.size(); ++j)
        left[j] -= subspace.mean[j];
    for (std::size_t p = 0; p < subspace.axisCount(); ++p) {
        double dot = 0.0;
        for (std::size_t j = 0; j < y.size(); ++j)
            dot += left[j] * subspace.axes[p * y.size() + j];
        for (std::size_t j = 0; j < y.size(); ++j)
            left[j] -= dot * subspace.axes[p * y.size() + j];
    }
    double squares = 0.0;
    for (const double number : left)
        squares += number * number;
    return squares;
}

struct Problem {
    std::vector<float> numbers;
    WeightedVectors vectors;
    std::vector<Subspace> subspaces;
};

Problem makeProblem(std::size_t dimension, std::size_t count, std::size_t subspaceCount,
                    std::size_t mostAxes) {
    RandomStream random(dimension, count);
    Problem problem;
    for (std::size_t i = 0; i < count * dimension; ++i)
        problem.numbers.push_back(static_cast<float>(drawNormal(random)));
    problem.vectors = weighVectors({problem.numbers, dimension}, 1);
    for (std::size_t k = 0; k < subspaceCount; ++k)
        problem.subspaces.push_back(
            makeSubspace(dimension, std::min(dimension, k % (mostAxes + 1)), random));
    return problem;
}

std::vector<double> weighRow(const Problem& problem, std::size_t i) {
    const std::size_t d = problem.vectors.dimension;
    return weighPoint(problem.vectors, std::span(problem.numbers).subspan(i * d, d));
}

TEST(SubspaceKernel, FindsTheNearestPointOrSubspaceOfEachVector) {
    onEveryInstructionSet([] {
        for (const std::size_t dimension : {1, 3, 8, 25}) {
            for (const std::size_t subspaceCount : {1, 5, 6, 7, 40}) {
                for (const std::size_t mostAxes : {0, 4}) {
                    const Problem problem = makeProblem(dimension, 131, subspaceCount, mostAxes);
                    const SubspaceRows rows(problem.subspaces, allIndices(subspaceCount));
                    const std::vector<std::uint32_t> all = allIndices(131);
                    std::vector<std::uint32_t> positions(131);
                    std::vector<float> distances(131);
                    findNearestSubspaces(problem.vectors, all, rows, false, {positions, distances});
                    for (std::size_t i = 0; i < 131; ++i) {
                        const std::vector<double> y = weighRow(problem, i);
                        double squares = 0.0, least = 1e30;
                        for (const double number : y)
                            squares += number * number;
                        for (const Subspace& subspace : problem.subspaces)
                            least = std::min(least, measureDistance(y, subspace));
                        const double tolerance = kRounding * (squares + 1.0);
                        ASSERT_LT(positions[i], subspaceCount);
                        ASSERT_NEAR(distances[i], least, tolerance);
                        ASSERT_NEAR(measureDistance(y, problem.subspaces[positions[i]]), least,
                                    tolerance);
                    }
                }
            }
        }
    });
}

TEST(SubspaceKernel, MeasuresAllDistances) {
    onEveryInstructionSet([] {
        const Problem problem = makeProblem(9, 50, 11, 3);
        const std::vector<std::uint32_t> chosen = {4, 0, 10, 7};
        const SubspaceRows rows(problem.subspaces, chosen);
        std::vector<float> distances(chosen.size() * 64);
        measureSubspaceDistances(problem.vectors, allIndices(50), rows, distances);
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            for (std::size_t i = 0; i < 50; ++i)
                ASSERT_NEAR(distances[k * 64 + i],
                            measureDistance(weighRow(problem, i), problem.subspaces[chosen[k]]),
                            kRounding * 10.0);
        }
    });
}

TEST(SubspaceKernel, TheFirstOfEqualSubspacesIsTaken) {
    Problem problem = makeProblem(6, 100, 4, 3);
    problem.subspaces.assign(5, problem.subspaces[3]);
    const std::vector<std::uint32_t> all = allIndices(100);
    std::vector<std::uint32_t> positions(100, 9);
    std::vector<float> distances(100);
    const SubspaceRows rows(problem.subspaces, allIndices(5));
    for (const bool prefersFirst : {false, true}) {
        findNearestSubspaces(problem.vectors, all, rows, prefersFirst, {positions, distances});
        EXPECT_EQ(positions, std::vector<std::uint32_t>(100, 0));
    }
}

TEST(SubspaceKernel, AdvantageKeepsAVectorWhereTheGainIsRounding) {
    // Two points at almost the same distance from a vector of length about 1.
    const std::vector<float> numbers = {1.0f, 0.0f, -1.0f, 0.0f};
    const WeightedVectors vectors = weighVectors({numbers, 2}, 1);
    const double y = weighPoint(vectors, std::span(numbers).first(2))[0];
    const auto nearestOf = [&](double gain, bool prefersFirst) {
        const std::vector<Subspace> points = {{{y, 0.25}}, {{y, 0.25 - gain}}};
        std::vector<std::uint32_t> position(1);
        std::vector<float> distance(1);
        findNearestSubspaces(vectors, std::vector<std::uint32_t>{0},
                             SubspaceRows(points, allIndices(2)), prefersFirst,
                             {position, distance});
        return position[0];
    };
    EXPECT_EQ(nearestOf(2e-7, false), 1u);
    EXPECT_EQ(nearestOf(2e-7, true), 0u);
    EXPECT_EQ(nearestOf(1e-5, true), 1u);
}

}  // namespace
}  // namespace prt

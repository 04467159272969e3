// Bibliography
//   [Halko11]  Finding structure with randomness
#include "prt/compress/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/base/random.h"
#include "prt/compress/row_kernel.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

using Matrix = Eigen::MatrixXd;
using ConstMatrixMap = Eigen::Map<const Matrix>;

constexpr double kLeastShare = 1e-13;

/// The largest eigenvalues of a symmetric matrix, descending, and their vectors.
struct Eigensystem {
    std::vector<double> values;
    Matrix vectors;  ///< in columns
};

Eigensystem takeLargest(const Eigen::SelfAdjointEigenSolver<Matrix>& solver, Eigen::Index count) {
    Eigensystem largest;
    largest.vectors = solver.eigenvectors().rightCols(count).rowwise().reverse();
    for (Eigen::Index i = 1; i <= count; ++i)
        largest.values.push_back(solver.eigenvalues()[solver.eigenvalues().size() - i]);
    return largest;
}

/// Multiplies a random block by the matrix again and again, and takes the best vectors from its
/// range [Halko11, algorithm 4.4].
template <class Symmetric>
Eigensystem iterateSubspace(const Symmetric& matrix, Eigen::Index size, double trace,
                            Eigen::Index count) {
    constexpr Eigen::Index kExtraCount = 10;
    constexpr int kMaxStepCount = 100;
    constexpr double kLeastGain = 1e-6;
    Matrix block(size, count + kExtraCount);
    RandomStream random(1, static_cast<std::uint64_t>(size));
    for (Eigen::Index i = 0; i < block.size(); ++i)
        block.data()[i] = random.nextUnitDouble() - 0.5;

    Eigensystem best;
    double explained = -1.0;
    Matrix image = matrix * block;
    for (int step = 0; step < kMaxStepCount; ++step) {
        const Matrix basis = Eigen::HouseholderQR<Matrix>(image).householderQ() *
                             Matrix::Identity(size, block.cols());
        image.noalias() = matrix * basis;
        const Matrix projected = basis.transpose() * image;
        const Eigen::SelfAdjointEigenSolver<Matrix> solver(projected);
        best = takeLargest(solver, count);
        best.vectors = basis * best.vectors;
        const double before = explained;
        explained = 0.0;
        for (const double value : best.values)
            explained += value;
        const double left = std::max(trace - explained, kLeastShare * trace);
        if (explained - before <= kLeastGain * left) break;
    }
    return best;
}

/// @param matrix  [size][size], the half right of the diagonal; row-major, so left of it for Eigen
Eigensystem findLargest(std::span<const double> matrix, std::size_t stride, std::size_t size,
                        std::size_t count) {
    constexpr std::size_t kLargeSize = 256, kFewParts = 8;
    const Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> map(
        matrix.data(), static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size),
        Eigen::OuterStride<>(static_cast<Eigen::Index>(stride)));
    const auto axisCount = static_cast<Eigen::Index>(std::min(count, size));
    if (size > kLargeSize && count < size / kFewParts)
        return iterateSubspace(map.selfadjointView<Eigen::Lower>(), map.rows(), map.trace(),
                               axisCount);
    return takeLargest(Eigen::SelfAdjointEigenSolver<Matrix>(map), axisCount);
}

/// Sums over some vectors, of z = y − y_first: no digits of doubles are lost by taking the mean
/// from sums of squares later.
struct Moments {
    std::vector<double> sum;       ///< Σ z, [paddedSize]
    std::vector<double> products;  ///< Σ z zᵀ, [paddedSize][paddedSize]
};

void addMoments(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                std::span<const double> shift, Moments& moments) {
    constexpr std::size_t kRowsAtOnce = 64;
    const std::size_t size = moments.sum.size();
    std::vector<double> rows(kRowsAtOnce * size);
    for (std::size_t i = 0; i < members.size(); i += kRowsAtOnce) {
        const std::size_t count = std::min(kRowsAtOnce, members.size() - i);
        gatherRows(vectors, members.subspan(i, count), shift, rows);
        const auto used = std::span(rows).first(count * size);
        addRows(used, moments.sum);
        addProducts(used, size, moments.products);
    }
}

/// The same in parts, of which there are few enough that each can have a matrix for itself.
Moments sumMoments(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                   std::span<const double> shift, int threadCount) {
    constexpr std::size_t kLeastPart = 8192, kMatrixNumbers = std::size_t{1} << 24;
    const std::size_t size = paddedSize(vectors.dimension);
    const std::size_t mostParts = std::clamp<std::size_t>(kMatrixNumbers / (size * size), 1, 64);
    const std::size_t partSize = std::max(kLeastPart, (members.size() + mostParts - 1) / mostParts);
    std::vector<Moments> parts((members.size() + partSize - 1) / partSize);
    parallelFor(members.size(), {threadCount, partSize}, [&](std::size_t begin, std::size_t end) {
        Moments& part = parts[begin / partSize];
        part = {std::vector<double>(size, 0.0), std::vector<double>(size * size, 0.0)};
        addMoments(vectors, members.subspan(begin, end - begin), shift, part);
    });
    Moments total = std::move(parts.front());
    for (std::size_t part = 1; part < parts.size(); ++part) {
        for (std::size_t i = 0; i < size; ++i)
            total.sum[i] += parts[part].sum[i];
        for (std::size_t i = 0; i < size * size; ++i)
            total.products[i] += parts[part].products[i];
    }
    return total;
}

/// Axes and total from the products of dimensions, Σ (y − m)(y − m)ᵀ.
Eigensystem diagonaliseByDimensions(const WeightedVectors& vectors,
                                    std::span<const std::uint32_t> members, std::size_t axisCount,
                                    int threadCount, PrincipalAxes& found) {
    const auto first = vectors.numbers.subspan(members[0] * vectors.dimension, vectors.dimension);
    const std::vector<double> shift = weighPoint(vectors, first);
    const std::size_t size = paddedSize(vectors.dimension);
    Moments moments = sumMoments(vectors, members, shift, threadCount);
    const auto count = static_cast<double>(members.size());
    found.subspace.mean = shift;
    for (std::size_t i = 0; i < vectors.dimension; ++i) {
        found.subspace.mean[i] += moments.sum[i] / count;
        for (std::size_t j = i; j < vectors.dimension; ++j)
            moments.products[i * size + j] -= moments.sum[i] / count * moments.sum[j];
        found.totalSquares += std::max(moments.products[i * size + i], 0.0);
    }
    if (axisCount == 0 || found.totalSquares == 0.0) return {};
    return findLargest(moments.products, size, vectors.dimension, axisCount);
}

/// The same from the products of vectors, ⟨y − m, z − m⟩: an eigenvector u of theirs gives
/// Σ_y u_y (y − m) / √λ.
Eigensystem diagonaliseByVectors(const WeightedVectors& vectors,
                                 std::span<const std::uint32_t> members, std::size_t axisCount,
                                 PrincipalAxes& found) {
    const std::size_t size = paddedSize(vectors.dimension);
    const std::size_t padded = paddedSize(members.size());
    Matrix columns =
        Matrix::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(padded));
    gatherRows(vectors, members, std::vector<double>(vectors.dimension, 0.0),
               {columns.data(), size * members.size()});
    auto used = columns.topLeftCorner(static_cast<Eigen::Index>(vectors.dimension),
                                      static_cast<Eigen::Index>(members.size()));
    const Eigen::VectorXd mean = used.rowwise().mean();
    used.colwise() -= mean;
    found.subspace.mean.assign(mean.data(), mean.data() + mean.size());
    found.totalSquares = used.squaredNorm();
    if (axisCount == 0 || found.totalSquares == 0.0) return {};

    const Matrix transposed = columns.transpose();
    std::vector<double> products(padded * padded, 0.0);
    addProducts({transposed.data(), static_cast<std::size_t>(transposed.size())}, padded, products);
    Eigensystem system = findLargest(products, padded, members.size(), axisCount);
    system.vectors = (used * system.vectors).eval();
    return system;
}

/// Makes the vectors that are sure an orthonormal basis, [axis][dimension]; twice, as one time
/// leaves rounding of those that explain much in those that explain little.
std::vector<double> orthonormalise(const Matrix& vectors, std::size_t count) {
    std::vector<double> axes;
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(count); ++i) {
        Eigen::VectorXd axis = vectors.col(i).normalized();
        for (int pass = 0; pass < 2; ++pass) {
            const ConstMatrixMap before(axes.data(), vectors.rows(), i);
            axis -= before * (before.transpose() * axis).eval();
            axis.normalize();
        }
        axes.insert(axes.end(), axis.data(), axis.data() + axis.size());
    }
    return axes;
}

}  // namespace

double PrincipalAxes::squaredError(std::size_t axisCount) const {
    double left = totalSquares;
    for (std::size_t i = 0; i < std::min(axisCount, squares.size()); ++i)
        left -= squares[i];
    return std::max(left, 0.0);
}

PrincipalAxes findPrincipalAxes(const WeightedVectors& vectors,
                                std::span<const std::uint32_t> members, std::size_t axisCount,
                                int threadCount) {
    PRT_ASSERT(!members.empty(), "there is a vector");
    PrincipalAxes found;
    axisCount = std::min({axisCount, vectors.dimension, members.size() - 1});
    const Eigensystem system =
        members.size() < vectors.dimension
            ? diagonaliseByVectors(vectors, members, axisCount, found)
            : diagonaliseByDimensions(vectors, members, axisCount, threadCount, found);
    for (const double value : system.values) {
        if (value <= kLeastShare * found.totalSquares) break;
        found.squares.push_back(value);
    }
    found.subspace.axes = orthonormalise(system.vectors, found.squares.size());
    return found;
}

}  // namespace prt

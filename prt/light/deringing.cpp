// Bibliography
//   [Sloan17]  Deringing spherical harmonics
#include "prt/light/deringing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/light/irradiance.h"
#include "prt/math/frame.h"

namespace prt {
namespace {

/// Directions dense enough that every minimum of n bands has a grid point in its basin.
struct DirectionGrid {
    int rowCount;
    int columnCount;
    std::vector<Vec3d> directions;

    double spacingRadians() const { return std::numbers::pi / rowCount; }
    std::size_t indexOf(int row, int column) const {
        return static_cast<std::size_t>(row * columnCount + (column + columnCount) % columnCount);
    }
};

DirectionGrid makeGrid(int bandCount) {
    constexpr int kRowsPerBand = 6;  // the shortest wave, 2π / (n − 1), spans 12 rows
    DirectionGrid grid{kRowsPerBand * bandCount, 2 * kRowsPerBand * bandCount, {}};
    for (int row = 0; row < grid.rowCount; ++row) {
        for (int column = 0; column < grid.columnCount; ++column) {
            const double theta = grid.spacingRadians() * (row + 0.5);
            const double phi = grid.spacingRadians() * column;
            grid.directions.emplace_back(std::sin(theta) * std::cos(phi),
                                         std::sin(theta) * std::sin(phi), std::cos(theta));
        }
    }
    return grid;
}

/// One channel of the lighting, and each of its bands over the grid.
struct Channel {
    std::vector<double> coefficients;
    std::vector<std::vector<double>> bandsOnGrid;  ///< [band][direction]
    double tolerance = 0.0;                        ///< what counts as rounding
};

/// The channels whose mean is positive.
std::vector<Channel> sampleChannels(const Lighting& lighting, const DirectionGrid& grid) {
    constexpr double kRounding = 1e-10;
    const auto bandCount = static_cast<std::size_t>(lighting.bandCount);
    std::vector<Channel> channels;
    for (int index = 0; index < 3; ++index) {
        const double mean = lighting.coefficients[0][index];
        if (!(mean > 0.0)) continue;
        Channel channel{{}, std::vector<std::vector<double>>(bandCount), kRounding * mean};
        for (const Vec3d& coefficient : lighting.coefficients)
            channel.coefficients.push_back(coefficient[index]);
        for (std::vector<double>& band : channel.bandsOnGrid)
            band.reserve(grid.directions.size());
        channels.push_back(std::move(channel));
    }
    std::vector<double> basis(lighting.coefficients.size()), bands(bandCount);
    for (const Vec3d& direction : grid.directions) {
        evaluateSh(direction, lighting.bandCount, basis);
        for (Channel& channel : channels) {
            sumShBands(channel.coefficients, basis, bands);
            for (std::size_t l = 0; l < bandCount; ++l)
                channel.bandsOnGrid[l].push_back(bands[l]);
        }
    }
    return channels;
}

std::vector<double> smoothOnGrid(const Channel& channel, std::span<const double> factors) {
    std::vector<double> values(channel.bandsOnGrid[0].size(), 0.0);
    for (std::size_t l = 0; l < factors.size(); ++l) {
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] += factors[l] * channel.bandsOnGrid[l][k];
    }
    return values;
}

/// The grid's points that lie no higher than their neighbours, and so low that the function may be
/// negative between them.
std::vector<std::size_t> findLowMinima(const DirectionGrid& grid, std::span<const double> values) {
    // Along a great circle n bands are a trigonometric polynomial of degree n − 1, whose second
    // derivative is at most (n − 1)² times its largest value (Bernstein). A minimum is at most 1/√2
    // of the spacing π/6n from a grid point, which is then at most (π/6)²/4 of that value higher.
    constexpr double kLargestRise = 0.0686 / (1.0 - 0.0686);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const double ceiling = kLargestRise * std::max(-*lowest, *highest);

    std::vector<std::size_t> minima;
    for (int row = 0; row < grid.rowCount; ++row) {
        for (int column = 0; column < grid.columnCount; ++column) {
            const std::size_t index = grid.indexOf(row, column);
            const auto isNoHigherThan = [&](int otherRow, int otherColumn) {
                return otherRow < 0 || otherRow == grid.rowCount ||
                       values[index] <= values[grid.indexOf(otherRow, otherColumn)];
            };
            if (values[index] <= ceiling && isNoHigherThan(row - 1, column) &&
                isNoHigherThan(row + 1, column) && isNoHigherThan(row, column - 1) &&
                isNoHigherThan(row, column + 1)) {
                minima.push_back(index);
            }
        }
    }
    return minima;
}

/// A function about a direction to second order, in the plane across it.
struct LocalShape {
    double value, slopeX, slopeY, xx, xy, yy;
};

template <class ValueAt>
LocalShape measureShape(const ValueAt& valueAt) {
    constexpr double h = 1e-4;  // radians; leaves slopes an error of its square
    const double value = valueAt(0, 0), east = valueAt(h, 0), west = valueAt(-h, 0),
                 north = valueAt(0, h), south = valueAt(0, -h);
    const double diagonal = valueAt(h, h) + valueAt(-h, -h) - valueAt(h, -h) - valueAt(-h, h);
    return {value,
            (east - west) / (2 * h),
            (north - south) / (2 * h),
            (east + west - 2 * value) / (h * h),
            diagonal / (4 * h * h),
            (north + south - 2 * value) / (h * h)};
}

/// A step to the lowest point of a shape, no longer than the radius.
struct DownhillStep {
    double x = 0.0;
    double y = 0.0;
    double gain = 0.0;  ///< by how much the function should fall
};

DownhillStep stepDownhill(LocalShape shape, double radius) {
    // Bend a saddle or a trough into a bowl.
    constexpr double kLeastCurvature = 1e-6;  // of the largest
    const double middle = 0.5 * (shape.xx + shape.yy);
    const double spread = std::hypot(0.5 * (shape.xx - shape.yy), shape.xy);
    const double leastCurvature = kLeastCurvature * (std::abs(middle) + spread);
    const double bend = std::max(leastCurvature - (middle - spread), 0.0);
    shape.xx += bend;
    shape.yy += bend;

    const double determinant = shape.xx * shape.yy - shape.xy * shape.xy;
    if (!(determinant > 0.0)) return {};
    DownhillStep step;
    step.x = (shape.xy * shape.slopeY - shape.yy * shape.slopeX) / determinant;
    step.y = (shape.xy * shape.slopeX - shape.xx * shape.slopeY) / determinant;
    const double length = std::hypot(step.x, step.y);
    if (length > radius) {
        step.x *= radius / length;
        step.y *= radius / length;
    }
    step.gain = -0.5 * (step.x * shape.slopeX + step.y * shape.slopeY);
    return step;
}

/// Walks downhill from a direction by Newton's method, within a radius that shrinks where a step
/// does not lead down, until there is no more than the tolerance to gain.
Vec3d descend(std::span<const double> coefficients, int bandCount, Vec3d direction, double radius,
              double tolerance) {
    constexpr int kMaxStepCount = 50;
    const double largestRadius = radius;
    for (int count = 0; count < kMaxStepCount; ++count) {
        const Frame<double> frame = frameFromNormal(direction);
        const auto moveBy = [&](double x, double y) {
            return (frame.normal + frame.tangent * x + frame.bitangent * y).normalized();
        };
        const auto valueAt = [&](double x, double y) {
            return reconstructSh(coefficients, bandCount, moveBy(x, y));
        };
        const LocalShape shape = measureShape(valueAt);
        const DownhillStep step = stepDownhill(shape, radius);
        if (step.gain <= tolerance) break;
        if (valueAt(step.x, step.y) < shape.value) {
            direction = moveBy(step.x, step.y);
            radius = std::min(2.0 * radius, largestRadius);
        } else {
            radius = 0.25 * std::hypot(step.x, step.y);
        }
    }
    return direction;
}

/// The first λ from the given one on that is enough at the minima of the channel as it is now.
/// Those move as λ grows, but no λ that was passed over is enough.
double raiseLambda(const Channel& channel, const DirectionGrid& grid, double lambda) {
    const int bandCount = static_cast<int>(channel.bandsOnGrid.size());
    const std::vector<double> factors = laplacianFactors(lambda, bandCount);
    std::vector<double> smoothed = channel.coefficients;
    for (std::size_t i = 0; i < smoothed.size(); ++i)
        smoothed[i] *= factors[static_cast<std::size_t>(shDegree(static_cast<int>(i)))];

    constexpr double kPrecision = 0.01;
    std::vector<double> basis(smoothed.size()), bands(factors.size());
    for (const std::size_t k : findLowMinima(grid, smoothOnGrid(channel, factors))) {
        const Vec3d lowest = descend(smoothed, bandCount, grid.directions[k], grid.spacingRadians(),
                                     kPrecision * channel.tolerance);
        evaluateSh(lowest, bandCount, basis);
        sumShBands(channel.coefficients, basis, bands);
        if (smoothAtPoint(bands, lambda) < -channel.tolerance)
            lambda = findLeastLambda(bands, lambda);
    }
    return lambda;
}

}  // namespace

std::vector<double> deringingFactors(const Lighting& lighting, const DeringingOptions& options) {
    PRT_ASSERT(lighting.bandCount >= 1, "there is at least one band");
    const Lighting judged =
        options.nonNegative == NonNegative::irradiance ? convolveWithCosine(lighting) : lighting;
    const DirectionGrid grid = makeGrid(lighting.bandCount);
    const std::vector<Channel> channels = sampleChannels(judged, grid);

    // Near the end each round squares what is missing.
    constexpr int kMaxRoundCount = 100;
    double lambda = 0.0;
    for (int round = 0; round < kMaxRoundCount; ++round) {
        const double last = lambda;
        for (const Channel& channel : channels)
            lambda = raiseLambda(channel, grid, lambda);
        if (lambda == last) break;
    }
    return laplacianFactors(lambda, lighting.bandCount);
}

}  // namespace prt

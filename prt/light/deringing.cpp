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

/// What each band of one function adds in one direction.
std::vector<double> evaluateBands(std::span<const double> coefficients, int bandCount,
                                  const Vec3d& direction) {
    std::vector<double> values(coefficients.size());
    evaluateSh(direction, bandCount, values);
    std::vector<double> bands(static_cast<std::size_t>(bandCount), 0.0);
    std::size_t i = 0;
    for (std::size_t l = 0; l < bands.size(); ++l) {
        for (; i < (l + 1) * (l + 1); ++i)
            bands[l] += coefficients[i] * values[i];
    }
    return bands;
}

/// One channel of the lighting, and each of its bands over the grid.
struct Channel {
    std::vector<double> coefficients;
    std::vector<std::vector<double>> bandsOnGrid;  ///< [band][direction]
    double tolerance = 0.0;                        ///< what counts as rounding
};

Channel sampleChannel(const Lighting& lighting, int channelIndex, const DirectionGrid& grid) {
    Channel channel;
    for (const Vec3d& coefficient : lighting.coefficients)
        channel.coefficients.push_back(coefficient[channelIndex]);
    channel.bandsOnGrid.resize(static_cast<std::size_t>(lighting.bandCount));
    for (const Vec3d& direction : grid.directions) {
        const auto bands = evaluateBands(channel.coefficients, lighting.bandCount, direction);
        for (std::size_t l = 0; l < bands.size(); ++l)
            channel.bandsOnGrid[l].push_back(bands[l]);
    }
    constexpr double kRounding = 1e-10;
    channel.tolerance = kRounding * channel.coefficients[0];
    return channel;
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

/// Walks downhill from a direction by compass search: to the best of four
/// neighbours, or closer if none is better.
Vec3d descend(std::span<const double> coefficients, int bandCount, Vec3d direction,
              double stepRadians) {
    constexpr double kFinestStepRadians = 1e-6;  // leaves an error of its square
    double lowest = reconstructSh(coefficients, bandCount, direction);
    while (stepRadians > kFinestStepRadians) {
        const Frame<double> frame = frameFromNormal(direction);
        bool hasMoved = false;
        for (const Vec3d& offset :
             {frame.tangent, -frame.tangent, frame.bitangent, -frame.bitangent}) {
            const Vec3d neighbour = (frame.normal + offset * stepRadians).normalized();
            const double value = reconstructSh(coefficients, bandCount, neighbour);
            if (value < lowest) {
                lowest = value;
                direction = neighbour;
                hasMoved = true;
            }
        }
        if (!hasMoved) stepRadians *= 0.5;
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

    for (const std::size_t k : findLowMinima(grid, smoothOnGrid(channel, factors))) {
        const Vec3d lowest =
            descend(smoothed, bandCount, grid.directions[k], grid.spacingRadians());
        const auto bands = evaluateBands(channel.coefficients, bandCount, lowest);
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
    std::vector<Channel> channels;
    for (int channel = 0; channel < 3; ++channel) {
        if (judged.coefficients[0][channel] > 0.0)
            channels.push_back(sampleChannel(judged, channel, grid));
    }

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

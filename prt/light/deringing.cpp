// Bibliography
//   [Sloan17]  Deringing spherical harmonics
#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/light/lighting.h"
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

/// One channel of the lighting, and the radiance of each of its bands over the grid.
struct Channel {
    std::vector<double> coefficients;
    std::vector<std::vector<double>> bandRadiance;
    double tolerance = 0.0;  ///< what counts as rounding
};

Channel sampleChannel(const Lighting& lighting, int channelIndex, const DirectionGrid& grid) {
    Channel channel;
    for (const Vec3d& coefficient : lighting.coefficients) {
        channel.coefficients.push_back(coefficient[channelIndex]);
    }
    channel.bandRadiance.resize(static_cast<std::size_t>(lighting.bandCount));
    std::vector<double> values(channel.coefficients.size());
    for (const Vec3d& direction : grid.directions) {
        evaluateSh(direction, lighting.bandCount, values);
        std::size_t i = 0;
        for (std::size_t l = 0; l < channel.bandRadiance.size(); ++l) {
            double sum = 0.0;
            for (; i < (l + 1) * (l + 1); ++i)
                sum += channel.coefficients[i] * values[i];
            channel.bandRadiance[l].push_back(sum);
        }
    }
    constexpr double kRounding = 1e-10;
    channel.tolerance = kRounding * channel.coefficients[0];
    return channel;
}

std::vector<double> applyFactors(const Channel& channel, std::span<const double> factors) {
    std::vector<double> radiance(channel.bandRadiance[0].size(), 0.0);
    for (std::size_t l = 0; l < factors.size(); ++l) {
        for (std::size_t k = 0; k < radiance.size(); ++k) {
            radiance[k] += factors[l] * channel.bandRadiance[l][k];
        }
    }
    return radiance;
}

/// The lowest of the grid's points that lie no higher than their neighbours.
std::vector<std::size_t> findLowestMinima(const DirectionGrid& grid,
                                          std::span<const double> radiance) {
    std::vector<std::size_t> minima;
    for (int row = 0; row < grid.rowCount; ++row) {
        for (int column = 0; column < grid.columnCount; ++column) {
            const std::size_t index = grid.indexOf(row, column);
            const auto isNoHigherThan = [&](int otherRow, int otherColumn) {
                return otherRow < 0 || otherRow == grid.rowCount ||
                       radiance[index] <= radiance[grid.indexOf(otherRow, otherColumn)];
            };
            if (isNoHigherThan(row - 1, column) && isNoHigherThan(row + 1, column) &&
                isNoHigherThan(row, column - 1) && isNoHigherThan(row, column + 1)) {
                minima.push_back(index);
            }
        }
    }
    constexpr std::size_t kMaxMinimumCount = 32;
    const std::size_t count = std::min(minima.size(), kMaxMinimumCount);
    std::partial_sort(minima.begin(), minima.begin() + static_cast<std::ptrdiff_t>(count),
                      minima.end(),
                      [&](std::size_t a, std::size_t b) { return radiance[a] < radiance[b]; });
    minima.resize(count);
    return minima;
}

/// Walks downhill from a direction by compass search: to the best of four
/// neighbours, or closer if none is better.
double descend(std::span<const double> coefficients, int bandCount, Vec3d direction,
               double stepRadians) {
    constexpr double kFinestStepRadians = 1e-6;  // leaves an error of its square
    double lowest = reconstructSh(coefficients, bandCount, direction);
    while (stepRadians > kFinestStepRadians) {
        const Frame<double> frame = frameFromNormal(direction);
        bool hasMoved = false;
        for (const Vec3d& offset :
             {frame.tangent, -frame.tangent, frame.bitangent, -frame.bitangent}) {
            const Vec3d neighbour = (frame.normal + offset * stepRadians).normalized();
            const double radiance = reconstructSh(coefficients, bandCount, neighbour);
            if (radiance < lowest) {
                lowest = radiance;
                direction = neighbour;
                hasMoved = true;
            }
        }
        if (!hasMoved) stepRadians *= 0.5;
    }
    return lowest;
}

bool isNonNegative(const Channel& channel, const DirectionGrid& grid,
                   std::span<const double> factors) {
    const std::vector<double> radiance = applyFactors(channel, factors);
    if (*std::min_element(radiance.begin(), radiance.end()) < -channel.tolerance) return false;

    std::vector<double> coefficients = channel.coefficients;
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        coefficients[i] *= factors[static_cast<std::size_t>(shDegree(static_cast<int>(i)))];
    }
    const auto minima = findLowestMinima(grid, radiance);
    return std::all_of(minima.begin(), minima.end(), [&](std::size_t k) {
        return descend(coefficients, static_cast<int>(factors.size()), grid.directions[k],
                       grid.spacingRadians()) >= -channel.tolerance;
    });
}

}  // namespace

std::vector<double> deringingFactors(const Lighting& lighting) {
    PRT_ASSERT(lighting.bandCount >= 1, "there is at least one band");
    const DirectionGrid grid = makeGrid(lighting.bandCount);
    std::vector<Channel> channels;
    for (int channel = 0; channel < 3; ++channel) {
        if (lighting.coefficients[0][channel] > 0.0) {
            channels.push_back(sampleChannel(lighting, channel, grid));
        }
    }
    const auto isEnough = [&](double lambda) {
        const auto factors = laplacianFactors(lambda, lighting.bandCount);
        return std::all_of(channels.begin(), channels.end(), [&](const Channel& channel) {
            return isNonNegative(channel, grid, factors);
        });
    };
    if (isEnough(0.0)) return laplacianFactors(0.0, lighting.bandCount);

    // Bracket the least λ between powers of two, then bisect.
    constexpr double kSmallest = 0x1p-20, kLargest = 0x1p40;
    double enough = kSmallest;
    while (enough < kLargest && !isEnough(enough))
        enough *= 2.0;
    double tooLittle = enough == kSmallest ? 0.0 : 0.5 * enough;
    constexpr int kStepCount = 32;
    for (int step = 0; step < kStepCount; ++step) {
        const double middle = 0.5 * (tooLittle + enough);
        (isEnough(middle) ? enough : tooLittle) = middle;
    }
    return laplacianFactors(enough, lighting.bandCount);
}

}  // namespace prt

#include "prt/light/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

/// The layout of an image, whose texels are counted row by row.
struct Layout {
    SphereMap map;
    int width;
    int height;

    std::size_t texelCount() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

Layout layoutOf(const Environment& environment) {
    return {environment.map, environment.radiance.width, environment.radiance.height};
}

std::vector<double> measureTexels(const Layout& layout) {
    return normalisedSolidAngles(layout.map, layout.width, layout.height);
}

class Resampler {
  public:
    Resampler(const Environment& source, const Layout& target, const Mat3d& targetFromSource)
        : source_(source),
          sourceLayout_(layoutOf(source)),
          target_(target),
          targetFromSource_(targetFromSource),
          sourceFromTarget_(targetFromSource.transposed()),
          sourceSolidAngles_(measureTexels(sourceLayout_)),
          targetSolidAngles_(measureTexels(target)) {}

    Image resample() {
        scaleSourceTexels();
        Image radiance(target_.width, target_.height);
        sums_.assign(target_.texelCount(), {});
        gather();
        dropUnseenTexels();
        for (std::size_t i = 0; i < sums_.size(); ++i)
            if (targetSolidAngles_[i] > 0.0) radiance.pixels[i] = finish(i);
        return radiance;
    }

  private:
    /// What has arrived at a texel.
    struct Sum {
        Vec3d flux{0.0, 0.0, 0.0};
        double solidAngle = 0.0;
        Vec3f darkest{std::numeric_limits<float>::max()};

        void add(const Vec3f& radiance, double weight) {
            flux += Vec3d(radiance) * weight;
            solidAngle += weight;
            for (int channel = 0; channel < 3; ++channel)
                darkest[channel] = std::min(darkest[channel], radiance[channel]);
        }
    };

    /// Calls visit(source texel, solid angle) for all that a target texel sees, at evenly spaced
    /// places, about two along each source texel; the solid angles sum to that of the texel.
    template <class Visit>
    void visitSource(int x, int y, const Visit& visit) {
        const double solidAngle = targetSolidAngles_[target_.indexOf(x, y)];
        if (solidAngle == 0.0) return;
        constexpr double kPlacesPerSourceTexel = 2.0;
        const double sourceTexelCount = static_cast<double>(sourceLayout_.texelCount());
        const int count = static_cast<int>(std::ceil(
            kPlacesPerSourceTexel * std::sqrt(solidAngle / kSphere * sourceTexelCount) - 1e-6));
        places_.clear();
        double densitySum = 0.0;
        for (int row = 0; row < count; ++row)
            for (int column = 0; column < count; ++column) {
                places_.push_back(spherePlace(target_.map, target_.width, target_.height,
                                              x + (column + 0.5) / count, y + (row + 0.5) / count));
                densitySum += places_.back().solidAngleDensity;
            }
        for (const SpherePlace& place : places_) {
            if (place.solidAngleDensity <= 0.0) continue;
            const double share = solidAngle * place.solidAngleDensity / densitySum;
            for (const WeightedTexel& texel :
                 bilinearTexels(sourceLayout_.map, sourceLayout_.width, sourceLayout_.height,
                                Vec3f(sourceFromTarget_ * place.direction)))
                if (texel.weight > 0.0f)
                    visit(sourceLayout_.indexOf(texel.x, texel.y),
                          share * static_cast<double>(texel.weight));
        }
    }

    template <class Visit>
    void visitTargetTexels(const Visit& visit) const {
        for (int y = 0; y < target_.height; ++y)
            for (int x = 0; x < target_.width; ++x)
                visit(x, y);
    }

    /// Finds the factors under which each source texel that is seen at all gives its solid angle.
    void scaleSourceTexels() {
        std::vector<double> seen(sourceLayout_.texelCount(), 0.0);
        visitTargetTexels([&](int x, int y) {
            visitSource(x, y, [&](std::size_t texel, double weight) { seen[texel] += weight; });
        });
        scales_.resize(seen.size());
        for (std::size_t i = 0; i < seen.size(); ++i)
            scales_[i] = seen[i] > 0.0 ? sourceSolidAngles_[i] / seen[i] : 0.0;
    }

    void gather() {
        visitTargetTexels([&](int x, int y) {
            Sum& sum = sums_[target_.indexOf(x, y)];
            visitSource(x, y, [&](std::size_t texel, double weight) {
                sum.add(source_.radiance.pixels[texel], weight * scales_[texel]);
            });
        });
    }

    /// Gives texels that slipped between the places, beside the pole of a lat-long map, to the
    /// target texel in which their centre lies.
    void dropUnseenTexels() {
        for (int y = 0; y < sourceLayout_.height; ++y)
            for (int x = 0; x < sourceLayout_.width; ++x) {
                const std::size_t texel = sourceLayout_.indexOf(x, y);
                if (scales_[texel] > 0.0 || sourceSolidAngles_[texel] == 0.0) continue;
                const Vec3d direction =
                    sphereTexel(sourceLayout_.map, sourceLayout_.width, sourceLayout_.height, x, y)
                        .direction;
                const auto nearest = bilinearTexels(target_.map, target_.width, target_.height,
                                                    Vec3f(targetFromSource_ * direction));
                const WeightedTexel& hit = *std::max_element(
                    nearest.begin(), nearest.end(),
                    [](const auto& a, const auto& b) { return a.weight < b.weight; });
                sums_[target_.indexOf(hit.x, hit.y)].add(source_.radiance.pixels[texel],
                                                         sourceSolidAngles_[texel]);
            }
    }

    /// The radiance of a texel. What has arrived covers it only nearly: the darkest radiance makes
    /// up for the difference, so that a constant stays constant and a sun keeps its flux.
    Vec3f finish(std::size_t texel) const {
        const Sum& sum = sums_[texel];
        const double solidAngle = targetSolidAngles_[texel];
        return Vec3f((sum.flux + Vec3d(sum.darkest) * (solidAngle - sum.solidAngle)) / solidAngle);
    }

    const Environment& source_;
    Layout sourceLayout_;
    Layout target_;
    Mat3d targetFromSource_;
    Mat3d sourceFromTarget_;
    std::vector<double> sourceSolidAngles_;
    std::vector<double> targetSolidAngles_;
    std::vector<double> scales_;  // 0 where a source texel is not seen
    std::vector<Sum> sums_;
    std::vector<SpherePlace> places_;  // of the texel being visited
};

/// A lat-long map whose texels are blocks of the source's: the exact mean of each.
Image averageBlocks(const Image& source, int blockSize) {
    const int width = source.width / blockSize;
    const int height = source.height / blockSize;
    Image means(width, height);
    for (int y = 0; y < height; ++y) {
        std::vector<Vec3d> sums(static_cast<std::size_t>(width), Vec3d(0.0));
        double solidAngle = 0.0;  // of the block
        for (int row = y * blockSize; row < (y + 1) * blockSize; ++row) {
            // All texels of a row are as large.
            const double ofTexel =
                sphereTexel(SphereMap::latLong, source.width, source.height, 0, row).solidAngle;
            solidAngle += ofTexel * blockSize;
            for (int x = 0; x < source.width; ++x)
                sums[static_cast<std::size_t>(x / blockSize)] += Vec3d(source.at(x, row)) * ofTexel;
        }
        for (int x = 0; x < width; ++x)
            means.at(x, y) = Vec3f(sums[static_cast<std::size_t>(x)] / solidAngle);
    }
    return means;
}

/// With texels as fine as those in the middle of the source's cells.
int findLatLongHeight(const Environment& source) {
    const int height = source.radiance.height;
    if (source.map == SphereMap::angularMap) return std::max(1, height / 2);
    if (source.map == SphereMap::octahedral) return height;
    return 2 * height / sphereMapSize(source.map, 1).height;
}

}  // namespace

Environment rotate(const Environment& source, const Mat3d& rotation, SphereMap map, int width,
                   int height) {
    PRT_ASSERT(fitsSphereMap(map, width, height), "the result has the shape of its map");
    const Layout from = layoutOf(source);
    if (rotation == Mat3d() && from.map == map) {
        if (from.width == width && from.height == height) return source;
        if (map == SphereMap::latLong && from.width % width == 0)
            return {map, averageBlocks(source.radiance, from.width / width)};
    }
    return {map, Resampler(source, {map, width, height}, rotation).resample()};
}

Environment rotate(const Environment& source, const Mat3d& rotation) {
    const Layout layout = layoutOf(source);
    return rotate(source, rotation, layout.map, layout.width, layout.height);
}

Environment resample(const Environment& source, SphereMap map, int width, int height) {
    return rotate(source, Mat3d(), map, width, height);
}

Environment resampleAsLatLong(Environment source) {
    if (source.map == SphereMap::latLong) return source;
    const int height = findLatLongHeight(source);
    return resample(source, SphereMap::latLong, 2 * height, height);
}

}  // namespace prt

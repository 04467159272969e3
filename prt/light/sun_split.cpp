// Bibliography
//   [Sloan08]  Stupid spherical harmonics (SH) tricks
#include "prt/light/sun_split.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/image/tone_curve.h"
#include "prt/light/analytic_lights.h"

namespace prt {
namespace {

/// An image of the sphere as a graph of texels that touch, whatever seams the layout has.
class TexelGraph {
  public:
    explicit TexelGraph(const Environment& environment)
        : map_(environment.map),
          width_(environment.radiance.width),
          height_(environment.radiance.height) {}

    Vec3d directionOf(std::size_t texel) const {
        return sphereTexel(map_, width_, height_, columnOf(texel), rowOf(texel)).direction;
    }

    /// Calls visit(texel) for the texels around one; for some of them twice.
    template <class Visit>
    void visitNeighbours(std::size_t texel, const Visit& visit) const {
        // Step from the centre towards a place inside the texel, and on across its border.
        constexpr double kInside = 0.25, kStretch = 3.0;
        const Vec3d center = directionOf(texel);
        for (const double down : {-kInside, 0.0, kInside})
            for (const double right : {-kInside, 0.0, kInside}) {
                const SpherePlace place =
                    spherePlace(map_, width_, height_, columnOf(texel) + 0.5 + right,
                                rowOf(texel) + 0.5 + down);
                if (place.solidAngleDensity <= 0.0) continue;
                const Vec3d beyond = center + (place.direction - center) * kStretch;
                const std::size_t neighbour = texelAt(beyond.normalized());
                if (neighbour != texel) visit(neighbour);
            }
    }

  private:
    int columnOf(std::size_t texel) const {
        return static_cast<int>(texel % static_cast<std::size_t>(width_));
    }
    int rowOf(std::size_t texel) const {
        return static_cast<int>(texel / static_cast<std::size_t>(width_));
    }

    std::size_t texelAt(const Vec3d& direction) const {
        const Vec2f pixel = pixelFromDirection(map_, width_, height_, Vec3f(direction));
        const int x = std::clamp(static_cast<int>(pixel.x), 0, width_ - 1);
        const int y = std::clamp(static_cast<int>(pixel.y), 0, height_ - 1);
        if (sphereTexel(map_, width_, height_, x, y).solidAngle > 0.0) return indexOf(x, y);
        // Where the rim of an angular map cuts off a texel, look-ups lead to one inside.
        const auto texels = bilinearTexels(map_, width_, height_, Vec3f(direction));
        const WeightedTexel& nearest =
            *std::max_element(texels.begin(), texels.end(),
                              [](const auto& a, const auto& b) { return a.weight < b.weight; });
        return indexOf(nearest.x, nearest.y);
    }

    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    SphereMap map_;
    int width_;
    int height_;
};

/// A set of texels that can be grown.
struct Region {
    std::vector<std::size_t> texels;
    std::vector<bool> holds;

    explicit Region(std::size_t texelCount) : holds(texelCount, false) {}

    void add(std::size_t texel) {
        if (holds[texel]) return;
        holds[texel] = true;
        texels.push_back(texel);
    }
};

double luminanceOf(const Vec3d& radiance) {
    return static_cast<double>(luminance(Vec3f(radiance)));
}

double angleBetween(const Vec3d& a, const Vec3d& b) {
    return 2.0 * std::asin(std::min(0.5 * (a - b).length(), 1.0));
}

/// What hangs together with the peak above a luminance; nothing where that is larger than a disc of
/// which the peak may be at the rim.
std::optional<Region> growFrom(std::size_t peak, const Environment& environment,
                               const TexelGraph& graph, const SunSplitOptions& options) {
    const std::vector<Vec3f>& radiance = environment.radiance.pixels;
    const float threshold = static_cast<float>(options.edgeFraction) * luminance(radiance[peak]);
    const Vec3d peakDirection = graph.directionOf(peak);
    Region region(radiance.size());
    region.add(peak);
    for (std::size_t i = 0; i < region.texels.size(); ++i) {
        if (angleBetween(graph.directionOf(region.texels[i]), peakDirection) >
            2.0 * options.maxHalfAngleRadians)
            return std::nullopt;
        graph.visitNeighbours(region.texels[i], [&](std::size_t neighbour) {
            if (luminance(radiance[neighbour]) >= threshold) region.add(neighbour);
        });
    }
    return region;
}

/// Adds a rim of one texel.
void dilate(Region& region, const TexelGraph& graph) {
    const std::size_t count = region.texels.size();
    for (std::size_t i = 0; i < count; ++i)
        graph.visitNeighbours(region.texels[i],
                              [&](std::size_t neighbour) { region.add(neighbour); });
}

/// The mean radiance of the texels that touch a region from outside.
Vec3f averageAround(const Region& region, const Environment& environment, const TexelGraph& graph,
                    const std::vector<double>& solidAngles) {
    Region larger = region;
    dilate(larger, graph);
    Vec3d flux(0.0);
    double solidAngle = 0.0;
    for (std::size_t i = region.texels.size(); i < larger.texels.size(); ++i) {
        const std::size_t texel = larger.texels[i];
        flux += Vec3d(environment.radiance.pixels[texel]) * solidAngles[texel];
        solidAngle += solidAngles[texel];
    }
    return solidAngle > 0.0 ? Vec3f(flux / solidAngle) : Vec3f(0.0f);
}

/// Light taken out of a texel.
struct Excess {
    Vec3d direction;
    Vec3d radiance;
    double luminance;
    double solidAngle;
};

/// Lowers a region to a radiance.
std::vector<Excess> takeOut(const Region& region, const Vec3f& fill, const TexelGraph& graph,
                            const std::vector<double>& solidAngles, Image& image) {
    std::vector<Excess> taken;
    for (const std::size_t texel : region.texels) {
        Vec3f& radiance = image.pixels[texel];
        const Vec3d before(radiance);
        for (int channel = 0; channel < 3; ++channel)
            radiance[channel] = std::min(radiance[channel], fill[channel]);
        const Vec3d excess = before - Vec3d(radiance);
        taken.push_back(
            {graph.directionOf(texel), excess, luminanceOf(excess), solidAngles[texel]});
    }
    return taken;
}

/// The disc with the flux of what was taken, if there is any.
std::optional<DiscLight> gatherDisc(const std::vector<Excess>& taken) {
    Vec3d flux(0.0), direction(0.0);
    double sum = 0.0, cubeSum = 0.0, fourthSum = 0.0;
    for (const Excess& excess : taken) {
        const double brightness = excess.luminance;
        flux += excess.radiance * excess.solidAngle;
        direction += excess.direction * (brightness * excess.solidAngle);
        sum += brightness * excess.solidAngle;
        cubeSum += std::pow(brightness, 3.0) * excess.solidAngle;
        fourthSum += std::pow(brightness, 4.0) * excess.solidAngle;
    }
    if (sum <= 0.0) return std::nullopt;
    // The disc is as bright as the sun's face: a mean in which texels at its edge count little.
    const double solidAngle = std::min(sum / (fourthSum / cubeSum), 4.0 * std::numbers::pi);
    return DiscLight{direction.normalized(),
                     2.0 * std::asin(std::sqrt(solidAngle / (4.0 * std::numbers::pi))),
                     flux / solidAngle};
}

/// The brightest texel that the map shows.
std::size_t findPeak(const Environment& environment, const std::vector<double>& solidAngles) {
    const std::vector<Vec3f>& radiance = environment.radiance.pixels;
    std::size_t peak = 0;
    float brightest = -1.0f;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        if (solidAngles[i] == 0.0 || luminance(radiance[i]) <= brightest) continue;
        peak = i;
        brightest = luminance(radiance[i]);
    }
    return peak;
}

}  // namespace

SunSplit splitSun(const Environment& environment, const SunSplitOptions& options) {
    const Image& image = environment.radiance;
    PRT_ASSERT(!image.pixels.empty(), "the environment has texels");
    PRT_ASSERT(options.edgeFraction > 0.0 && options.edgeFraction <= 1.0,
               "a fraction is a fraction");
    const std::vector<double> solidAngles =
        normalisedSolidAngles(environment.map, image.width, image.height);
    const TexelGraph graph(environment);
    SunSplit split{std::nullopt, environment};
    const std::size_t peak = findPeak(environment, solidAngles);
    if (luminance(image.pixels[peak]) <= 0.0f) return split;

    std::optional<Region> region = growFrom(peak, environment, graph, options);
    if (!region) return split;
    dilate(*region, graph);
    const Vec3f fill = averageAround(*region, environment, graph, solidAngles);
    split.sun = gatherDisc(takeOut(*region, fill, graph, solidAngles, split.rest.radiance));
    if (!split.sun || split.sun->halfAngleRadians > options.maxHalfAngleRadians)
        return {std::nullopt, environment};
    return split;
}

std::optional<DominantLight> extractDominantLight(const Lighting& lighting) {
    if (lighting.bandCount < 2) return std::nullopt;
    const std::vector<Vec3d>& coefficients = lighting.coefficients;
    const auto luminanceAt = [&](int m) {
        return luminanceOf(coefficients[static_cast<std::size_t>(shIndex(1, m))]);
    };
    const Vec3d linear(-luminanceAt(1), -luminanceAt(-1), luminanceAt(0));
    constexpr double kRounding = 1e-12;
    if (linear.length() <= kRounding * std::abs(luminanceOf(coefficients[0]))) return std::nullopt;

    // With an ambient light beside it, the constant coefficient fits exactly and tells nothing.
    DominantLight light{linear.normalized(), Vec3d(0.0), lighting};
    const Lighting unit = sunLighting(light.direction, 0.0, lighting.bandCount);
    Vec3d product(0.0);
    double square = 0.0;
    for (std::size_t i = 1; i < coefficients.size(); ++i) {
        product += coefficients[i] * unit.coefficients[i].x;
        square += unit.coefficients[i].x * unit.coefficients[i].x;
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double most = std::max(coefficients[0][channel] / unit.coefficients[0].x, 0.0);
        light.irradiance[channel] = std::clamp(product[channel] / square, 0.0, most);
    }
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        light.rest.coefficients[i] -= light.irradiance * unit.coefficients[i].x;
    return light;
}

}  // namespace prt

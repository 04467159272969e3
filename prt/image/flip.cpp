// Bibliography
//   [Andersson20]  FLIP: a difference evaluator for alternating images
#include "prt/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include "prt/base/assert.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

// The constants of [Andersson20], by their names there.
constexpr float kQc = 0.7f;   // compresses colour differences
constexpr float kPc = 0.4f;   // colour differences up to this part of the largest …
constexpr float kPt = 0.95f;  // … fill this part of the range
constexpr float kQf = 0.5f;   // compresses feature differences
constexpr double kFeatureWidthDegrees = 0.082;

// ── Colour spaces ────────────────────────────────────────────────────────────────────────────────

/// The white of Rec. 709 in XYZ.
constexpr Vec3f kWhite(0.950428545f, 1.0f, 1.088900371f);

Vec3f xyzFromRgb(const Vec3f& rgb) {
    return {0.41238656f * rgb.x + 0.35759149f * rgb.y + 0.18045049f * rgb.z,
            0.21263682f * rgb.x + 0.71518298f * rgb.y + 0.07218020f * rgb.z,
            0.01933062f * rgb.x + 0.11919716f * rgb.y + 0.95037259f * rgb.z};
}

Vec3f rgbFromXyz(const Vec3f& xyz) {
    return {3.24100323f * xyz.x - 1.53739897f * xyz.y - 0.49861588f * xyz.z,
            -0.96922425f * xyz.x + 1.87592998f * xyz.y + 0.04155423f * xyz.z,
            0.05563942f * xyz.x - 0.20401121f * xyz.y + 1.05714898f * xyz.z};
}

/// Opponent colours in which the blur of the eye is linear: achromatic, red-green, blue-yellow.
Vec3f opponentFromXyz(const Vec3f& xyz) {
    const Vec3f relative = xyz / kWhite;
    return {116.0f * relative.y - 16.0f, 500.0f * (relative.x - relative.y),
            200.0f * (relative.y - relative.z)};
}

Vec3f xyzFromOpponent(const Vec3f& opponent) {
    const float y = (opponent.x + 16.0f) / 116.0f;
    return kWhite * Vec3f(y + opponent.y / 500.0f, y, y - opponent.z / 200.0f);
}

float labCurve(float value) {
    constexpr float kKnee = 6.0f / 29.0f;
    if (value > kKnee * kKnee * kKnee) return std::cbrt(value);
    return value / (3.0f * kKnee * kKnee) + 4.0f / 29.0f;
}

/// CIELAB, its colours fading in the dark as they do to the eye (Hunt's effect).
Vec3f huntLabFromRgb(const Vec3f& rgb) {
    const Vec3f relative = xyzFromRgb(rgb) / kWhite;
    const float x = labCurve(relative.x), y = labCurve(relative.y), z = labCurve(relative.z);
    const float lightness = 116.0f * y - 16.0f;
    const float fade = 0.01f * lightness;
    return {lightness, fade * 500.0f * (x - y), fade * 200.0f * (y - z)};
}

/// The distance for large colour differences.
float hyAbDistance(const Vec3f& a, const Vec3f& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// ── Filters ──────────────────────────────────────────────────────────────────────────────────────

using Plane = ImageOf<float>;

/// Weights for the offsets −r … r.
using Kernel = std::vector<float>;

template <class Function>
Kernel sampleKernel(int radius, const Function& function) {
    Kernel kernel;
    for (int offset = -radius; offset <= radius; ++offset)
        kernel.push_back(static_cast<float>(function(static_cast<double>(offset))));
    return kernel;
}

/// Makes the positive weights sum to 1, and the negative ones to −1.
Kernel normalise(Kernel kernel) {
    float positive = 0.0f, negative = 0.0f;
    for (const float weight : kernel)
        (weight > 0.0f ? positive : negative) += weight;
    for (float& weight : kernel)
        weight /= weight > 0.0f ? positive : -negative;
    return kernel;
}

/// Filters along rows with one kernel, and along columns with the other.
Plane filter(const Plane& plane, const Kernel& alongRows, const Kernel& alongColumns) {
    const auto pass = [](const Plane& source, const Kernel& kernel, int stepX, int stepY) {
        const int radius = static_cast<int>(kernel.size()) / 2;
        Plane result(source.width, source.height);
        for (int y = 0; y < source.height; ++y) {
            for (int x = 0; x < source.width; ++x) {
                float sum = 0.0f;
                for (int offset = -radius; offset <= radius; ++offset)
                    sum += kernel[static_cast<std::size_t>(offset + radius)] *
                           source.at(std::clamp(x + stepX * offset, 0, source.width - 1),
                                     std::clamp(y + stepY * offset, 0, source.height - 1));
                result.at(x, y) = sum;
            }
        }
        return result;
    };
    return pass(pass(plane, alongRows, 1, 0), alongColumns, 0, 1);
}

/// One Gaussian of a contrast sensitivity function, a √(π/b) exp(−π²d²/b) with d in degrees.
struct SensitivityTerm {
    double a = 0.0;
    double b = 1.0;
};

constexpr std::array<std::array<SensitivityTerm, 2>, 3> kSensitivity = {{
    {{{1.0, 0.0047}, {0.0, 1e-5}}},   // achromatic
    {{{1.0, 0.0053}, {0.0, 1e-5}}},   // red-green
    {{{34.1, 0.04}, {13.5, 0.025}}},  // blue-yellow
}};

/// Blurs one opponent channel as the eye does. Each Gaussian is separable; their sum is not.
Plane blurAsTheEye(const Plane& plane, const std::array<SensitivityTerm, 2>& terms,
                   double pixelsPerDegree) {
    constexpr double kWidestB = 0.04;
    const double widestSigma = std::sqrt(kWidestB / (2.0 * std::numbers::pi * std::numbers::pi));
    const int radius = static_cast<int>(std::ceil(3.0 * widestSigma * pixelsPerDegree));
    Plane blurred(plane.width, plane.height);
    double volume = 0.0;
    for (const auto& [a, b] : terms) {
        if (a == 0.0) continue;
        const Kernel gaussian = sampleKernel(radius, [&, width = b](double offset) {
            const double degrees = offset / pixelsPerDegree;
            return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / width);
        });
        const double sum = std::accumulate(gaussian.begin(), gaussian.end(), 0.0);
        const double height = a * std::sqrt(std::numbers::pi / b);
        volume += height * sum * sum;
        const Plane part = filter(plane, gaussian, gaussian);
        for (std::size_t i = 0; i < part.pixels.size(); ++i)
            blurred.pixels[i] += static_cast<float>(height) * part.pixels[i];
    }
    for (float& value : blurred.pixels)
        value /= static_cast<float>(volume);
    return blurred;
}

// ── The two pipelines ────────────────────────────────────────────────────────────────────────────

using OpponentPlanes = std::array<Plane, 3>;

OpponentPlanes splitOpponent(const Rgba8Image& image) {
    const Plane blank(image.width, image.height);
    OpponentPlanes planes = {blank, blank, blank};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgba8& pixel = image.pixels[i];
        const Vec3f rgb(decodeSrgb8(pixel.red), decodeSrgb8(pixel.green), decodeSrgb8(pixel.blue));
        const Vec3f opponent = opponentFromXyz(xyzFromRgb(rgb));
        for (int channel = 0; channel < 3; ++channel)
            planes[static_cast<std::size_t>(channel)].pixels[i] = opponent[channel];
    }
    return planes;
}

/// What the eye makes of every pixel's colour.
std::vector<Vec3f> perceiveColors(const OpponentPlanes& planes, double pixelsPerDegree) {
    OpponentPlanes blurred;
    for (std::size_t channel = 0; channel < 3; ++channel)
        blurred[channel] = blurAsTheEye(planes[channel], kSensitivity[channel], pixelsPerDegree);
    std::vector<Vec3f> colors(blurred[0].pixels.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        Vec3f rgb = rgbFromXyz(
            xyzFromOpponent({blurred[0].pixels[i], blurred[1].pixels[i], blurred[2].pixels[i]}));
        for (int channel = 0; channel < 3; ++channel)
            rgb[channel] = std::clamp(rgb[channel], 0.0f, 1.0f);
        colors[i] = huntLabFromRgb(rgb);
    }
    return colors;
}

/// Maps colour distances to [0, 1], most of it for the small ones.
float compressColorDifference(float distance) {
    static const float kLargest = std::pow(
        hyAbDistance(huntLabFromRgb({0.0f, 1.0f, 0.0f}), huntLabFromRgb({0.0f, 0.0f, 1.0f})), kQc);
    const float difference = std::pow(distance, kQc);
    const float knee = kPc * kLargest;
    if (difference < knee) return kPt / knee * difference;
    return kPt + (difference - knee) / (kLargest - knee) * (1.0f - kPt);
}

/// How strongly every pixel is an edge, and a point.
struct Features {
    std::vector<float> edge;
    std::vector<float> point;
};

Features findFeatures(const Plane& achromatic, double pixelsPerDegree) {
    const double sigma = 0.5 * kFeatureWidthDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gaussian = [sigma](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    const Kernel smooth = normalise(sampleKernel(radius, gaussian));
    const Kernel slope =
        normalise(sampleKernel(radius, [&](double x) { return -x * gaussian(x); }));
    const Kernel curvature = normalise(sampleKernel(
        radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gaussian(x); }));

    Plane lightness = achromatic;
    for (float& value : lightness.pixels)
        value = (value + 16.0f) / 116.0f;
    const auto findMagnitude = [&](const Kernel& kernel) {
        const Plane along = filter(lightness, kernel, smooth);
        const Plane across = filter(lightness, smooth, kernel);
        std::vector<float> magnitude(along.pixels.size());
        for (std::size_t i = 0; i < magnitude.size(); ++i)
            magnitude[i] = std::hypot(along.pixels[i], across.pixels[i]);
        return magnitude;
    };
    return {findMagnitude(slope), findMagnitude(curvature)};
}

}  // namespace

ImageOf<float> measureFlip(const Rgba8Image& image, const Rgba8Image& reference,
                           const FlipOptions& options) {
    PRT_ASSERT(image.width == reference.width && image.height == reference.height,
               "the pictures have the same size");
    PRT_ASSERT(options.pixelsPerDegree > 0.0, "a degree has an extent on the screen");
    const OpponentPlanes planes = splitOpponent(image);
    const OpponentPlanes referencePlanes = splitOpponent(reference);
    const auto colors = perceiveColors(planes, options.pixelsPerDegree);
    const auto referenceColors = perceiveColors(referencePlanes, options.pixelsPerDegree);
    const Features features = findFeatures(planes[0], options.pixelsPerDegree);
    const Features referenceFeatures = findFeatures(referencePlanes[0], options.pixelsPerDegree);

    ImageOf<float> map(image.width, image.height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const float color = compressColorDifference(hyAbDistance(colors[i], referenceColors[i]));
        const float feature = std::max(std::abs(features.edge[i] - referenceFeatures.edge[i]),
                                       std::abs(features.point[i] - referenceFeatures.point[i]));
        const float amplification = std::pow(feature / std::numbers::sqrt2_v<float>, kQf);
        map.pixels[i] = std::pow(color, 1.0f - amplification);
    }
    return map;
}

double meanValue(const ImageOf<float>& map) {
    double sum = 0.0;
    for (const float value : map.pixels)
        sum += static_cast<double>(value);
    return sum / static_cast<double>(map.pixels.size());
}

}  // namespace prt

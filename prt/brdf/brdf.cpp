// Bibliography
//   [Heitz18]      Sampling the GGX distribution of visible normals
//   [Lafortune94]  Using the modified Phong reflectance model for physically based rendering
//   [Walter07]     Microfacet models for refraction through rough surfaces
#include "prt/brdf/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/brdf/microfacets.h"

namespace prt {
namespace {

constexpr double kInversePi = std::numbers::inv_pi;

/// The reflectance of a dielectric of index 1.5 along the normal [glTF 2.0, B.3.5].
constexpr double kDielectricF0 = 0.04;

double meanOf(const Vec3d& rgb) {
    return (rgb.x + rgb.y + rgb.z) / 3.0;
}

double clampedAlpha(const GgxLobe& lobe) {
    return std::max(lobe.alpha, kMinGgxAlpha);
}

Vec3d mirrored(const Vec3d& view) {
    return {-view.x, -view.y, view.z};
}

Vec3d sampleCosine(double u, double v) {
    const double radius = std::sqrt(u), phi = 2.0 * std::numbers::pi * v;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0 - u)};
}

double cosineDensity(const Vec3d& incident) {
    return std::max(incident.z, 0.0) * kInversePi;
}

Vec3d evaluate(const std::monostate&, const Vec3d&, const Vec3d&) {
    return Vec3d(0.0);
}
Vec3d sample(const std::monostate&, const Vec3d&, double u, double v) {
    return sampleCosine(u, v);
}
double density(const std::monostate&, const Vec3d& incident, const Vec3d&) {
    return cosineDensity(incident);
}
double guessAlbedo(const std::monostate&, const Vec3d&) {
    return 0.0;
}

Vec3d evaluate(const LambertLobe& lobe, const Vec3d&, const Vec3d&) {
    return lobe.albedo * kInversePi;
}
Vec3d sample(const LambertLobe&, const Vec3d&, double u, double v) {
    return sampleCosine(u, v);
}
double density(const LambertLobe&, const Vec3d& incident, const Vec3d&) {
    return cosineDensity(incident);
}
double guessAlbedo(const LambertLobe& lobe, const Vec3d&) {
    return meanOf(lobe.albedo);
}

Vec3d evaluate(const LayeredLambertLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    const double cosDifference = incident.dot(halfVector(incident, view));
    return lobe.albedo * (kInversePi * (1.0 - schlickWeight(cosDifference)));
}
Vec3d sample(const LayeredLambertLobe&, const Vec3d&, double u, double v) {
    return sampleCosine(u, v);
}
double density(const LayeredLambertLobe&, const Vec3d& incident, const Vec3d&) {
    return cosineDensity(incident);
}
double guessAlbedo(const LayeredLambertLobe& lobe, const Vec3d&) {
    return meanOf(lobe.albedo);
}

Vec3d evaluate(const PhongLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    const double cosAlpha = incident.dot(mirrored(view));
    if (cosAlpha <= 0.0) return Vec3d(0.0);
    return lobe.albedo *
           (0.5 * kInversePi * (lobe.exponent + 2.0) * std::pow(cosAlpha, lobe.exponent));
}
Vec3d sample(const PhongLobe& lobe, const Vec3d& view, double u, double v) {
    const double cosAlpha = std::pow(1.0 - u, 1.0 / (lobe.exponent + 1.0));
    const double sinAlpha = std::sqrt((1.0 - cosAlpha) * (1.0 + cosAlpha));
    const double phi = 2.0 * std::numbers::pi * v;
    const AxisFrame frame = frameAbout(mirrored(view));
    return frame.tangent * (sinAlpha * std::cos(phi)) +
           frame.bitangent * (sinAlpha * std::sin(phi)) + frame.axis * cosAlpha;
}
double density(const PhongLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    const double cosAlpha = incident.dot(mirrored(view));
    if (cosAlpha <= 0.0) return 0.0;
    return 0.5 * kInversePi * (lobe.exponent + 1.0) * std::pow(cosAlpha, lobe.exponent);
}
double guessAlbedo(const PhongLobe& lobe, const Vec3d&) {
    return meanOf(lobe.albedo);
}

Vec3d evaluate(const GgxLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    const double alpha = clampedAlpha(lobe);
    const Vec3d half = halfVector(incident, view);
    const double schlick = schlickWeight(incident.dot(half));
    const Vec3d fresnel = lobe.f0 * (1.0 - schlick) + Vec3d(schlick);
    return fresnel * (ggxDistribution(half, alpha) * smithVisibility(incident.z, view.z, alpha));
}
Vec3d sample(const GgxLobe& lobe, const Vec3d& view, double u, double v) {
    return mirrorAbout(sampleVisibleNormal(view, clampedAlpha(lobe), u, v), view);
}
double density(const GgxLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    return visibleNormalDensity(incident, view, clampedAlpha(lobe));
}
double guessAlbedo(const GgxLobe& lobe, const Vec3d& view) {
    return meanOf(lobe.f0 + (Vec3d(1.0) - lobe.f0) * schlickWeight(view.z));
}

Vec3d evaluate(const MeasuredLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    return lobe.table->evaluate(incident, view);
}
Vec3d sample(const MeasuredLobe& lobe, const Vec3d& view, double u, double v) {
    return lobe.table->sample(view, u, v);
}
double density(const MeasuredLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    return lobe.table->density(incident, view);
}
double guessAlbedo(const MeasuredLobe&, const Vec3d&) {
    return 1.0;
}

/// The probability with which sampleBrdf draws from the first lobe.
double firstShare(const Brdf& brdf, const Vec3d& view) {
    const auto guess = [&](const BrdfLobe& lobe) {
        return std::visit([&](const auto& any) { return guessAlbedo(any, view); }, lobe);
    };
    const double first = guess(brdf.lobes[0]), second = guess(brdf.lobes[1]);
    if (first + second > 0.0) return first / (first + second);
    return std::holds_alternative<std::monostate>(brdf.lobes[1]) ? 1.0 : 0.0;
}

}  // namespace

bool hasLobes(const Brdf& brdf) {
    return !std::holds_alternative<std::monostate>(brdf.lobes[0]) ||
           !std::holds_alternative<std::monostate>(brdf.lobes[1]);
}

GltfLobes splitGltfMaterial(const Vec3f& baseColor, const MetallicRoughness& surface) {
    const Vec3d color(baseColor);
    const auto metallic = static_cast<double>(surface.metallic);
    const auto roughness = static_cast<double>(surface.roughness);
    GltfLobes lobes;
    // Of the layer's 1 − F = (1 − F0)(1 − (1 − ω_i·h)⁵), the first factor is put into the albedo.
    lobes.diffuse.albedo = color * ((1.0 - metallic) * (1.0 - kDielectricF0));
    lobes.specular.f0 = Vec3d((1.0 - metallic) * kDielectricF0) + color * metallic;
    lobes.specular.alpha = roughness * roughness;
    return lobes;
}

Brdf makeGltfBrdf(const Vec3f& baseColor, const MetallicRoughness& surface) {
    const GltfLobes lobes = splitGltfMaterial(baseColor, surface);
    return {.lobes = {lobes.diffuse, lobes.specular}};
}

Vec3d evaluateLobe(const BrdfLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    if (incident.z <= 0.0 || view.z <= 0.0) return Vec3d(0.0);
    return std::visit([&](const auto& any) { return evaluate(any, incident, view); }, lobe);
}

Vec3d evaluateBrdf(const Brdf& brdf, const Vec3d& incident, const Vec3d& view) {
    return evaluateLobe(brdf.lobes[0], incident, view) +
           evaluateLobe(brdf.lobes[1], incident, view);
}

Vec3d sampleLobe(const BrdfLobe& lobe, const Vec3d& view, double u, double v) {
    PRT_ASSERT(view.z > 0.0, "the view is above the horizon");
    return std::visit([&](const auto& any) { return sample(any, view, u, v); }, lobe);
}

double lobeDensity(const BrdfLobe& lobe, const Vec3d& incident, const Vec3d& view) {
    PRT_ASSERT(view.z > 0.0, "the view is above the horizon");
    return std::visit([&](const auto& any) { return density(any, incident, view); }, lobe);
}

double brdfDensity(const Brdf& brdf, const Vec3d& incident, const Vec3d& view) {
    const double share = firstShare(brdf, view);
    double sum = 0.0;
    if (share > 0.0) sum += share * lobeDensity(brdf.lobes[0], incident, view);
    if (share < 1.0) sum += (1.0 - share) * lobeDensity(brdf.lobes[1], incident, view);
    return sum;
}

BrdfSample sampleBrdf(const Brdf& brdf, const Vec3d& view, double u, double v) {
    // Choose a lobe, and use what is left of u.
    const double share = firstShare(brdf, view);
    const bool isFirst = u < share;
    const double rest = isFirst ? u / share : (u - share) / (1.0 - share);
    BrdfSample drawn;
    drawn.incident =
        sampleLobe(brdf.lobes[isFirst ? 0 : 1], view, std::min(rest, 1.0 - 0x1p-53), v);
    drawn.density = brdfDensity(brdf, drawn.incident, view);
    if (drawn.incident.z > 0.0 && drawn.density > 0.0)
        drawn.weight =
            evaluateBrdf(brdf, drawn.incident, view) * (drawn.incident.z / drawn.density);
    return drawn;
}

}  // namespace prt

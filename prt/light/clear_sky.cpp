// Bibliography
//   [Preetham99]  A practical analytic model for daylight
//   [Wyman13]     Simple analytic approximations to the CIE XYZ color matching functions
#include "prt/light/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/light/analytic_lights.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

// Slope and offset in turbidity of A … E [Preetham99, appendix A1].
struct Line {
    double slope, offset;
};
constexpr std::array<std::array<Line, 5>, 3> kPerezLines = {{
    {{{0.17872, -1.46303},
      {-0.35540, 0.42749},
      {-0.02266, 5.32505},
      {0.12064, -2.57705},
      {-0.06696, 0.37027}}},
    {{{-0.01925, -0.25922},
      {-0.06651, 0.00081},
      {-0.00041, 0.21247},
      {-0.06409, -0.89887},
      {-0.00325, 0.04517}}},
    {{{-0.01669, -0.26078},
      {-0.09495, 0.00921},
      {-0.00792, 0.21023},
      {-0.04405, -1.65369},
      {-0.01092, 0.05291}}},
}};

// Zenith chromaticities: rows by T², T, 1; columns by θ³, θ², θ, 1 [Preetham99, appendix A1].
using ZenithTable = std::array<std::array<double, 4>, 3>;
constexpr ZenithTable kZenithX = {{{0.00166, -0.00375, 0.00209, 0.0},
                                   {-0.02903, 0.06377, -0.03202, 0.00394},
                                   {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithTable kZenithY = {{{0.00275, -0.00610, 0.00317, 0.0},
                                   {-0.04214, 0.08970, -0.04153, 0.00516},
                                   {0.15346, -0.26756, 0.06670, 0.26688}}};

double evaluateZenith(const ZenithTable& table, double turbidity, double sunTheta) {
    double value = 0.0;
    for (const auto& row : table) {
        const double inTheta =
            ((row[0] * sunTheta + row[1]) * sunTheta + row[2]) * sunTheta + row[3];
        value = value * turbidity + inTheta;
    }
    return value;
}

/// In thousands of cd/m².
double evaluateZenithLuminance(double turbidity, double sunTheta) {
    const double chi = (4.0 / 9.0 - turbidity / 120.0) * (std::numbers::pi - 2.0 * sunTheta);
    return (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
}

/// F of Perez; at the horizon its first factor is 1, B being negative.
double evaluatePerez(const std::array<double, 5>& p, double cosTheta, double gamma) {
    const double cosGamma = std::cos(gamma);
    const double gradation = 1.0 + p[0] * std::exp(p[1] / std::max(cosTheta, 1e-9));
    return gradation * (1.0 + p[2] * std::exp(p[3] * gamma) + p[4] * cosGamma * cosGamma);
}

/// XYZ to linear Rec. 709 with its white, D65; colours outside go to the edge of the gamut.
Vec3d rec709FromXyz(const Vec3d& xyz) {
    const Vec3d rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                    -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                    0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    return {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)};
}

/// The CIE 1931 colour matching functions [Wyman13, eq. 4].
Vec3d matchColor(double nanometres) {
    const auto lobe = [=](double centre, double below, double above) {
        const double t = (nanometres - centre) * (nanometres < centre ? below : above);
        return std::exp(-0.5 * t * t);
    };
    return {0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323) -
                0.065 * lobe(501.1, 0.0490, 0.0382),
            0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
            1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725)};
}

/// Planck's law up to a factor.
double emitBlackBody(double nanometres, double kelvin) {
    constexpr double kSecondRadiation = 1.438776877e7;  // hc/k, nm K
    return 1.0 / (std::pow(nanometres, 5.0) * std::expm1(kSecondRadiation / (nanometres * kelvin)));
}

/// What air and haze leave of a beam [Preetham99, appendix A2].
double transmitBeam(double nanometres, double airMass, double turbidity) {
    const double micrometres = 1e-3 * nanometres;
    const double haze = 0.04608 * turbidity - 0.04586;
    return std::exp(-airMass *
                    (0.008735 * std::pow(micrometres, -4.08) + haze * std::pow(micrometres, -1.3)));
}

}  // namespace

ClearSky::ClearSky(const Vec3d& sunDirection, double turbidity)
    : sunDirection_(sunDirection), turbidity_(turbidity) {
    PRT_ASSERT(sunDirection.y >= 0.0, "the sun stands above the horizon");
    PRT_ASSERT(turbidity >= kMinTurbidity && turbidity <= kMaxTurbidity,
               "a turbidity of the model");
    const double sunTheta = std::acos(std::min(sunDirection.y, 1.0));
    const std::array<double, 3> zenith = {evaluateZenithLuminance(turbidity, sunTheta),
                                          evaluateZenith(kZenithX, turbidity, sunTheta),
                                          evaluateZenith(kZenithY, turbidity, sunTheta)};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 5; ++i)
            perez_[k][i] = kPerezLines[k][i].slope * turbidity + kPerezLines[k][i].offset;
        zenithOverReference_[k] = zenith[k] / evaluatePerez(perez_[k], 1.0, sunTheta);
    }
}

Vec3d ClearSky::radiance(const Vec3d& direction) const {
    if (direction.y <= 0.0) return Vec3d(0.0);
    const double gamma = std::acos(std::clamp(direction.dot(sunDirection_), -1.0, 1.0));
    std::array<double, 3> values;
    for (std::size_t k = 0; k < 3; ++k)
        values[k] = zenithOverReference_[k] * evaluatePerez(perez_[k], direction.y, gamma);
    const auto [luminance, x, y] = values;
    return rec709FromXyz(Vec3d(x / y, 1.0, (1.0 - x - y) / y) * luminance);
}

Vec3d ClearSky::sunIrradiance() const {
    constexpr double kOutsideIlluminance = 128.0;  // thousands of lx
    constexpr double kSunKelvin = 5778.0;
    const double zenithDegrees =
        std::acos(std::min(sunDirection_.y, 1.0)) * 180.0 / std::numbers::pi;
    const double airMass =
        1.0 / (std::max(sunDirection_.y, 0.0) + 0.15 * std::pow(93.885 - zenithDegrees, -1.253));
    Vec3d attenuated(0.0), outside(0.0);
    for (double nanometres = 380.0; nanometres <= 780.0; nanometres += 5.0) {
        const Vec3d matched = matchColor(nanometres) * emitBlackBody(nanometres, kSunKelvin);
        outside += matched;
        attenuated += matched * transmitBeam(nanometres, airMass, turbidity_);
    }
    return rec709FromXyz(attenuated * (kOutsideIlluminance / outside.y));
}

Lighting skyLighting(const ClearSky& sky, int bandCount) {
    constexpr int kHeightCount = 64;
    constexpr int kAzimuthCount = 128;
    Lighting lighting(bandCount);
    std::vector<double> values(lighting.coefficients.size());
    for (const QuadratureNode& node : gaussLegendre(kHeightCount)) {
        // Heights in [0, 1], denser towards the horizon, where the sky changes fastest.
        const double t = 0.5 * (1.0 + node.position);
        const double height = t * t;
        const double weight = node.weight * t * 2.0 * std::numbers::pi / kAzimuthCount;
        const double radius = std::sqrt(1.0 - height * height);
        for (int k = 0; k < kAzimuthCount; ++k) {
            const double azimuth = 2.0 * std::numbers::pi * (k + 0.5) / kAzimuthCount;
            const Vec3d direction(radius * std::cos(azimuth), height, radius * std::sin(azimuth));
            evaluateSh(direction, bandCount, values);
            const Vec3d flux = sky.radiance(direction) * weight;
            for (std::size_t i = 0; i < values.size(); ++i)
                lighting.coefficients[i] += flux * values[i];
        }
    }
    return lighting;
}

Lighting daylightLighting(const ClearSky& sky, int bandCount) {
    const Lighting sun = sunLighting(sky.sunDirection(), ClearSky::kSunHalfAngleRadians, bandCount);
    return add(skyLighting(sky, bandCount), scale(sun, sky.sunIrradiance()));
}

Environment drawSky(const ClearSky& sky, int width, bool withSun) {
    PRT_ASSERT(width >= 2 && width % 2 == 0, "the width of a lat-long image is twice its height");
    Environment environment{SphereMap::latLong, Image(width, width / 2)};
    Image& image = environment.radiance;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = Vec3f(
                sky.radiance(sphereTexel(SphereMap::latLong, width, image.height, x, y).direction));
    if (withSun)
        addDisc(environment, sky.sunDirection(), ClearSky::kSunHalfAngleRadians,
                sky.sunIrradiance());
    return environment;
}

}  // namespace prt

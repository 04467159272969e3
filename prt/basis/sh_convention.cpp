// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
//   [Kerbl23]        3D Gaussian splatting for real-time radiance field rendering
#include "prt/basis/sh_convention.h"

#include <array>
#include <limits>
#include <numbers>
#include <utility>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"

namespace prt {
namespace {

/// The axis that points the other way in a convention.
enum class Mirror { none, x, z };

/// What a coefficient is multiplied with.
enum class Content {
    radiance,
    radianceOverPi,
    reflectedPolynomial,  ///< irradiance over π, as coefficients of plain polynomials
};

struct ConventionTraits {
    std::string_view name;
    std::string_view description;
    bool hasPhase;  ///< (−1)^m, as ours
    Mirror mirror;
    Content content;
    double constant;  ///< added to the sum of coefficients times functions
    int maxBandCount;
};

constexpr int kNoLimit = std::numeric_limits<int>::max();

// In the order of the enumeration.
constexpr std::array<ConventionTraits, 8> kTraits = {{
    {"cs", "radiance, Condon-Shortley phase, right-handed axes with +y up", true, Mirror::none,
     Content::radiance, 0.0, kNoLimit},
    {"rh", "radiance, no phase, left-handed axes with +z ahead [Ramamoorthi and Hanrahan 2001]",
     false, Mirror::z, Content::radiance, 0.0, kNoLimit},
    {"d3dx", "radiance, Condon-Shortley phase, left-handed axes with +z ahead (D3DX, DirectXMath)",
     true, Mirror::z, Content::radiance, 0.0, kNoLimit},
    {"three", "radiance, no phase, right-handed axes with +y up (three.js SphericalHarmonics3)",
     false, Mirror::none, Content::radiance, 0.0, 3},
    {"filament",
     "irradiance / pi as a polynomial 1 y z x xy yz 3zz-1 xz xx-yy, axes as cs (IndirectLight)",
     false, Mirror::none, Content::reflectedPolynomial, 0.0, 3},
    {"unity",
     "the same polynomial, left-handed axes with +z ahead, x turned round (SphericalHarmonicsL2)",
     false, Mirror::x, Content::reflectedPolynomial, 0.0, 3},
    {"godot", "radiance / pi, no phase, right-handed axes with +y up (Godot LightmapGI probes)",
     false, Mirror::none, Content::radianceOverPi, 0.0, 3},
    {"3dgs",
     "radiance less 0.5, Condon-Shortley phase, right-handed axes with +y up (3D Gaussian "
     "Splatting)",
     true, Mirror::none, Content::radiance, 0.5, 4},
}};

constexpr std::array<ShConvention, kTraits.size()> kConventions = {
    ShConvention::cs,       ShConvention::rh,    ShConvention::d3dx,  ShConvention::three,
    ShConvention::filament, ShConvention::unity, ShConvention::godot, ShConvention::gaussians};

const ConventionTraits& traitsOf(ShConvention convention) {
    return kTraits[static_cast<std::size_t>(convention)];
}

/// Whether y_lm changes its sign when an axis is turned round.
bool isOddIn(Mirror mirror, int l, int m) {
    switch (mirror) {
        case Mirror::x:
            return (m < 0 ? m + 1 : m) % 2 != 0;
        case Mirror::z:
            return (l + m) % 2 != 0;
        case Mirror::none:
            break;
    }
    return false;
}

/// The constants of the first nine functions, |y_lm| over its polynomial [Ramamoorthi01, eq. 3].
constexpr std::array<double, 9> kPolynomialFactors = {
    0.28209479177387814,                                            // √(1/4π)
    0.48860251190291992, 0.48860251190291992, 0.48860251190291992,  // √(3/4π)
    1.0925484305920792,  1.0925484305920792,                        // √(15/4π)
    0.31539156525252000,                                            // √(5/16π)
    1.0925484305920792,
    0.54627421529603959,  // √(15/16π)
};

/// What coefficient (l, m) of ours is multiplied by.
double conversionFactor(const ConventionTraits& traits, int l, int m) {
    const bool changesSign = (!traits.hasPhase && m % 2 != 0) != isOddIn(traits.mirror, l, m);
    const double sign = changesSign ? -1.0 : 1.0;
    switch (traits.content) {
        case Content::radianceOverPi:
            return sign * std::numbers::inv_pi;
        case Content::reflectedPolynomial:
            return sign * clampedCosineFactor(l) * std::numbers::inv_pi *
                   kPolynomialFactors[static_cast<std::size_t>(shIndex(l, m))];
        case Content::radiance:
            break;
    }
    return sign;
}

/// Calls change(coefficient, factor) for each coefficient.
template <class Change>
void changeCoefficients(const ConventionTraits& traits, std::span<double> coefficients,
                        const Change& change) {
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const int l = shDegree(static_cast<int>(i));
        PRT_ASSERT(l < traits.maxBandCount, "the convention has this many bands");
        change(coefficients[i], conversionFactor(traits, l, static_cast<int>(i) - shIndex(l, 0)));
    }
}

/// The first coefficient of the constant that a convention adds.
double constantCoefficient(const ConventionTraits& traits) {
    return traits.constant * 2.0 / std::numbers::inv_sqrtpi;
}

}  // namespace

std::string_view shConventionName(ShConvention convention) {
    return traitsOf(convention).name;
}

std::optional<ShConvention> parseShConvention(std::string_view name) {
    for (const ShConvention convention : kConventions) {
        if (shConventionName(convention) == name) return convention;
    }
    return std::nullopt;
}

std::span<const ShConvention> allShConventions() {
    return kConventions;
}

std::string_view describeShConvention(ShConvention convention) {
    return traitsOf(convention).description;
}

int maxBandCount(ShConvention convention) {
    return traitsOf(convention).maxBandCount;
}

void convertShTo(ShConvention convention, std::span<double> coefficients) {
    const ConventionTraits& traits = traitsOf(convention);
    changeCoefficients(traits, coefficients,
                       [](double& coefficient, double factor) { coefficient *= factor; });
    if (!coefficients.empty()) coefficients[0] -= constantCoefficient(traits);
}

void convertShFrom(ShConvention convention, std::span<double> coefficients) {
    const ConventionTraits& traits = traitsOf(convention);
    if (!coefficients.empty()) coefficients[0] += constantCoefficient(traits);
    changeCoefficients(traits, coefficients,
                       [](double& coefficient, double factor) { coefficient /= factor; });
}

}  // namespace prt

#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace prt {

/// What others call the spherical harmonic coefficients of a light, and how they are scaled, signed
/// and turned (C2). Where d is a direction of ours, right-handed with +y up:
enum class ShConvention {
    cs,  ///< ours, also of SciPy, drjit and Mitsuba: Condon-Shortley phase, right-handed axes
    rh,  ///< Ramamoorthi and Hanrahan 2001: no phase, and (dx, dy, −dz), as in their probe tables
    d3dx,      ///< D3DX and DirectXMath: phase, and (dx, dy, −dz), left-handed with +z ahead
    three,     ///< three.js SphericalHarmonics3: no phase, axes as ours
    filament,  ///< Filament IndirectLight::irradiance: what an albedo of 1 reflects, as
               ///< coefficients of 1, y, z, x, xy, yz, 3z²−1, xz, x²−y²; axes as ours
    unity,  ///< Unity SphericalHarmonicsL2: the same, in (−dx, dy, dz), left-handed with +z ahead,
            ///< as its importers of glTF turn a scene
    godot,      ///< Godot LightmapGI probes: no phase, 1/π of the radiance; axes as ours
    gaussians,  ///< "3dgs", 3D Gaussian Splatting: phase, axes as ours, and ½ is added to the sum
};

/// As on the command line and in files: "cs", "rh", …
std::string_view shConventionName(ShConvention convention);
std::optional<ShConvention> parseShConvention(std::string_view name);

/// All of them in the order of the enumeration.
std::span<const ShConvention> allShConventions();

/// One line for a person: what the numbers are, and in which axes.
std::string_view describeShConvention(ShConvention convention);

/// The most bands that coefficients of this convention have; a large number where there is no end.
int maxBandCount(ShConvention convention);

/// Turns n² coefficients of radiance in ours into those of `convention`, one channel. A convention
/// that adds a constant to the sum (`gaussians`) takes it out here.
///
/// @param coefficients  n² with n ≤ maxBandCount(convention)
void convertShTo(ShConvention convention, std::span<double> coefficients);

/// Leads back from what convertShTo made.
void convertShFrom(ShConvention convention, std::span<double> coefficients);

}  // namespace prt

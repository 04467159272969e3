#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace prt {

/// Published conventions for SH coefficients of radiance, reached from ours by
/// sign changes and a mirror (C2).
enum class ShConvention {
    cs,    ///< ours: Condon-Shortley phase, right-handed axes
    rh,    ///< Ramamoorthi and Hanrahan 2001: no phase, left-handed axes with +z ahead, as in their
           ///< probe tables
    d3dx,  ///< D3DX and DirectXMath: phase, left-handed axes with +z ahead
    three,  ///< three.js SphericalHarmonics3: no phase, right-handed axes
};

std::string_view shConventionName(ShConvention convention);
std::optional<ShConvention> parseShConvention(std::string_view name);

/// Multiplies n² coefficients by the signs that lead from ours to
/// `convention`; the same signs lead back.
void convertSh(ShConvention convention, std::span<double> coefficients);

}  // namespace prt

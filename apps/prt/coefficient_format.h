#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "prt/basis/sh_convention.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// How lighting coefficients are written down.
enum class CoefficientFormat { table, json, c, glsl, hlsl, wgsl };

std::optional<CoefficientFormat> parseCoefficientFormat(std::string_view name);

/// The coefficients as text that ends in a line break.
///
/// @param lighting    in our own convention
/// @param convention  the one to write them in, named in the text
std::string formatCoefficients(const Lighting& lighting, CoefficientFormat format,
                               ShConvention convention);

}  // namespace prt::cli

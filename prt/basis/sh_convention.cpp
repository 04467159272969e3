#include "prt/basis/sh_convention.h"

#include <array>
#include <cstdlib>
#include <utility>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {
namespace {

struct ConventionTraits {
    ShConvention convention;
    std::string_view name;
    bool hasPhase;    ///< (−1)^m, as ours
    bool isMirrored;  ///< z turned round, which multiplies y_lm by (−1)^(l+m)
};

constexpr std::array<ConventionTraits, 4> kConventions = {{
    {ShConvention::cs, "cs", true, false},
    {ShConvention::rh, "rh", false, true},
    {ShConvention::d3dx, "d3dx", true, true},
    {ShConvention::three, "three", false, false},
}};

const ConventionTraits& traitsOf(ShConvention convention) {
    return kConventions[static_cast<std::size_t>(convention)];
}

}  // namespace

std::string_view shConventionName(ShConvention convention) {
    return traitsOf(convention).name;
}

std::optional<ShConvention> parseShConvention(std::string_view name) {
    for (const ConventionTraits& traits : kConventions) {
        if (traits.name == name) return traits.convention;
    }
    return std::nullopt;
}

void convertSh(ShConvention convention, std::span<double> coefficients) {
    const ConventionTraits& traits = traitsOf(convention);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const int l = shDegree(static_cast<int>(i));
        const int m = static_cast<int>(i) - shIndex(l, 0);
        const int signChanges = (traits.hasPhase ? 0 : m) + (traits.isMirrored ? l + m : 0);
        if (signChanges % 2 != 0) coefficients[i] = -coefficients[i];
    }
}

}  // namespace prt

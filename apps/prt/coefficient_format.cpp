#include "apps/prt/coefficient_format.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "prt/basis/sh.h"
#include "prt/io/environment_io.h"

namespace prt::cli {
namespace {

/// Six decimals, and never "-0.000000".
double roundForTable(double value) {
    constexpr double kMillion = 1e6;
    if (std::abs(value) > 1e9) return value;
    return std::round(value * kMillion) / kMillion + 0.0;
}

std::string formatTable(const Lighting& lighting) {
    std::size_t width = 12;
    for (const Vec3d& value : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            width = std::max(width, fmt::formatted_size("{:.6f}", value[channel]) + 2);

    std::string text =
        fmt::format("index   l   m{:>{}}{:>{}}{:>{}}\n", "R", width, "G", width, "B", width);
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i) {
        const int index = static_cast<int>(i);
        const int l = shDegree(index);
        text += fmt::format("{:>5} {:>3} {:>3}", index, l, index - shIndex(l, 0));
        for (int channel = 0; channel < 3; ++channel)
            text +=
                fmt::format("{:>{}.6f}", roundForTable(lighting.coefficients[i][channel]), width);
        text += "\n";
    }
    return text;
}

/// How a language spells an array of vectors.
struct ArraySyntax {
    std::string head;
    std::string element;  // of three numbers
    std::string tail;
};

ArraySyntax arraySyntax(CoefficientFormat format, std::size_t count) {
    if (format == CoefficientFormat::glsl)
        return {fmt::format("const vec3 kLighting[{0}] = vec3[{0}](\n", count),
                "    vec3({:#}, {:#}, {:#})", ");\n"};
    if (format == CoefficientFormat::wgsl)
        return {fmt::format("const kLighting = array<vec3<f32>, {}>(\n", count),
                "    vec3<f32>({:#}, {:#}, {:#})", ");\n"};
    if (format == CoefficientFormat::hlsl)
        return {fmt::format("static const float3 kLighting[{}] = {{\n", count),
                "    float3({:#}, {:#}, {:#})", "};\n"};
    return {fmt::format("static const float kLighting[{}][3] = {{\n", count),
            "    {{{:#}f, {:#}f, {:#}f}}", "};\n"};
}

std::string formatArray(const Lighting& lighting, CoefficientFormat format,
                        ShConvention convention) {
    const std::size_t count = lighting.coefficients.size();
    const ArraySyntax syntax = arraySyntax(format, count);
    std::string text = fmt::format(
        "// A light in {} bands of spherical harmonics; degree l, order m stands at l(l+1)+m.\n"
        "// Convention {}: {}.\n{}",
        lighting.bandCount, shConventionName(convention), describeShConvention(convention),
        syntax.head);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3f value(lighting.coefficients[i]);
        text += fmt::format(fmt::runtime(syntax.element), value.x, value.y, value.z);
        text += i + 1 < count ? ",\n" : "\n";
    }
    return text + syntax.tail;
}

}  // namespace

std::optional<CoefficientFormat> parseCoefficientFormat(std::string_view name) {
    if (name == "table") return CoefficientFormat::table;
    if (name == "json") return CoefficientFormat::json;
    if (name == "glsl") return CoefficientFormat::glsl;
    if (name == "hlsl") return CoefficientFormat::hlsl;
    if (name == "wgsl") return CoefficientFormat::wgsl;
    if (name == "c") return CoefficientFormat::c;
    return std::nullopt;
}

std::string formatCoefficients(const Lighting& lighting, CoefficientFormat format,
                               ShConvention convention) {
    const Lighting converted = convertTo(convention, lighting);
    switch (format) {
        case CoefficientFormat::table:
            return formatTable(converted);
        case CoefficientFormat::json:
            return lightingToJson(lighting, convention);
        case CoefficientFormat::glsl:
        case CoefficientFormat::hlsl:
        case CoefficientFormat::wgsl:
        case CoefficientFormat::c:
            return formatArray(converted, format, convention);
    }
    return {};
}

}  // namespace prt::cli

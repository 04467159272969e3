#include "prt/math/isa.h"

#include <hwy/targets.h>

#include <array>
#include <cstdint>
#include <utility>

namespace prt {
namespace {

constexpr std::array<std::pair<Isa, std::string_view>, 3> kNames = {
    {{Isa::sse4, "sse4"}, {Isa::avx2, "avx2"}, {Isa::avx512, "avx512"}}};

}  // namespace

Isa detectIsa() {
    const std::int64_t targets = hwy::SupportedTargets();
    if ((targets & HWY_AVX3) != 0) return Isa::avx512;
    if ((targets & HWY_AVX2) != 0) return Isa::avx2;
    return Isa::sse4;
}

std::string_view isaName(Isa isa) {
    return kNames[static_cast<std::size_t>(isa)].second;
}

std::optional<Isa> parseIsa(std::string_view name) {
    for (const auto& [isa, isaName] : kNames) {
        if (isaName == name) return isa;
    }
    return std::nullopt;
}

}  // namespace prt

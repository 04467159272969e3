#pragma once

#include <optional>
#include <string_view>

namespace prt {

/// The vector instruction sets that the hot kernels and the ray tracer are built for. The same seed
/// gives the same bits on one of them, not across them (C10).
enum class Isa { sse4, avx2, avx512 };

/// The widest set that this machine runs.
Isa detectIsa();

std::string_view isaName(Isa isa);

/// "sse4", "avx2" or "avx512"; nothing for any other name.
std::optional<Isa> parseIsa(std::string_view name);

}  // namespace prt

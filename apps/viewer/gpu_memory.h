#pragma once

#include <cstdint>
#include <optional>

namespace prt::viewer {

/// Memory of the graphics card that is taken, by all programs; none where the driver does not say.
std::optional<std::uint64_t> usedCardBytes();

}  // namespace prt::viewer

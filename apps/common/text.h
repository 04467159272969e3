#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace prt::cli {

// Numbers as people read them.
std::string formatCount(std::uint64_t count);                          ///< "12,345"
std::string formatCount(std::uint64_t count, std::string_view thing);  ///< "1 mesh", "2 meshes"
std::string formatQuantity(double quantity, std::string_view unit);    ///< "12.3 M rays/s"
std::string formatBytes(std::uint64_t bytes);                          ///< "1.23 MB"
std::string formatPercent(double part);       ///< "12 %", "1.2 %", "0.12 %"
std::string formatDecibels(double decibels);  ///< "41.5 dB", or "equal" for infinitely many
std::string formatDuration(double seconds);   ///< "12 s", "3 min 04 s", "2 h 05 min"

/// The double that JSON writes as the shortest decimal of a float: 0.1, not 0.10000000149011612.
double withDigitsOf(float number);

}  // namespace prt::cli

#pragma once

#include <cstddef>

namespace prt {

/// Incident radiance stands in vectors of as many numbers, the last filled up with zeros.
inline constexpr std::size_t kIncidentLanes = 16;

constexpr std::size_t padToIncidentLanes(std::size_t count) {
    return (count + kIncidentLanes - 1) / kIncidentLanes * kIncidentLanes;
}

/// How many coefficients of n bands have m > 0, and as many m < 0.
constexpr std::size_t pairCount(int bandCount) {
    return static_cast<std::size_t>(bandCount * (bandCount - 1) / 2);
}

/// Where incident radiance keeps coefficient (l, m): first those of m = 0, then those of m > 0,
/// and that of −m behind by as many as there are pairs.
constexpr std::size_t incidentIndex(int bandCount, int l, int m) {
    if (m == 0) return static_cast<std::size_t>(l);
    const auto pair = static_cast<std::size_t>(l * (l - 1) / 2 + (m < 0 ? -m : m) - 1);
    return static_cast<std::size_t>(bandCount) + pair + (m < 0 ? pairCount(bandCount) : 0);
}

/// Numbers of those of m ≥ 0, padded.
constexpr std::size_t uprightRowSize(int bandCount) {
    return padToIncidentLanes(static_cast<std::size_t>(bandCount) + pairCount(bandCount));
}

/// Numbers of all, padded so that there is something behind by as many as there are pairs.
constexpr std::size_t incidentRowSize(int bandCount) {
    return padToIncidentLanes(pairCount(bandCount) + uprightRowSize(bandCount));
}

}  // namespace prt

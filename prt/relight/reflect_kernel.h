#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "prt/math/vector.h"
#include "prt/relight/exit_radiance.h"

namespace prt {

/// Receivers are seen in blocks of as many.
inline constexpr std::size_t kReflectBlockSize = 16;

enum class LobeKind : std::uint8_t {
    gltf,   ///< all light from all incident radiance
    split,  ///< the specular one from what has bounced
    other,  ///< of a BRDF of its own
};

/// What a receiver reflects: rows of coefficients for each view of a table, which at azimuth 0 are
/// of m ≥ 0 alone, in the order of incidentIndex and padded with zeros.
struct ReceiverLobe {
    LobeKind kind = LobeKind::gltf;
    std::uint32_t viewCount = 0;
    /// Of glTF's: [level][view][2], GGX of F0 = 0 and what F0 = 1 has more, from the level below
    /// the receiver's roughness on; of others: [view][channel].
    const float* rows = nullptr;
    float levelShare = 0.0f;  ///< of the level above
    float metallic = 0.0f;
    const float* arriving = nullptr;  ///< of a split one: white light, as incident radiance
};

/// Receivers as the kernel sees them.
struct ReflectView {
    int bandCount = 0;                     ///< of incident radiance
    std::size_t rowSize = 0;               ///< of incident radiance, padded
    std::size_t uprightSize = 0;           ///< of the coefficients of m ≥ 0, padded
    const float* places = nullptr;         ///< [block][position, normal][16]
    const ReceiverLobe* lobes = nullptr;   ///< of each receiver
    const float* diffuse = nullptr;        ///< [view]: rows of a layered Lambert lobe
    const float* open = nullptr;           ///< a row: white light as it would arrive unshadowed
    const std::int32_t* orders = nullptr;  ///< a row: m
    std::size_t incidentSize = 0;          ///< floats a receiver
    bool hasBounced = false;  ///< behind all incident radiance stands that which has bounced
};

/// Writes what receivers from the first on, the first of a block, send to the eye.
///
/// @param incident  [receiver][channel][incidentIndex], and again of what has bounced
/// @param ahead     memory that will be read next, asked for between one receiver and another
void reflectIncident(const ReflectView& receivers, const Vec3f& eye, const float* incident,
                     std::span<const std::byte> ahead, std::span<ExitRadiance> radiance);

}  // namespace prt

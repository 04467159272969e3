#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// What a diffuse bake needs of an MTL material.
struct MtlMaterial {
    std::string name;
    std::optional<Vec3f> diffuse;      ///< Kd
    Vec3f emission{0.0f, 0.0f, 0.0f};  ///< Ke
    std::string diffuseTexture;        ///< the file that map_Kd names, as written; empty if none
    bool clampsTexture = false;        ///< map_Kd -clamp on
    bool isTransparent = false;        ///< d below 1, Tr above 0, or map_d
};

/// Reads the text of a material library. Statements other than those above are skipped.
///
/// @param name     how to call it in an error
/// @throws Error   malformed
std::vector<MtlMaterial> parseMtl(std::string_view text, const std::string& name);

}  // namespace prt

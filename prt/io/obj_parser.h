#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// Where a corner has no texture coordinate or no normal.
inline constexpr std::uint32_t kObjNone = 0xffffffffu;

/// Indices from 0 into the lists of ObjGeometry.
struct ObjCorner {
    std::uint32_t position = kObjNone;
    std::uint32_t uv = kObjNone;
    std::uint32_t normal = kObjNone;

    bool operator==(const ObjCorner&) const = default;
};

struct ObjFace {
    std::size_t firstCorner = 0;
    std::size_t cornerCount = 0;  ///< at least three
    std::size_t material = 0;     ///< index into ObjGeometry::materialNames
    std::size_t lineNumber = 0;
};

/// What an OBJ file says, every index in range and every position and texture coordinate finite.
struct ObjGeometry {
    std::vector<Vec3f> positions;
    std::vector<Vec3f>
        colors;  ///< sRGB-encoded, in [0, 1]; empty or as many as positions, white where not given
    std::vector<Vec2f> uvs;      ///< v counts upwards
    std::vector<Vec3f> normals;  ///< of any length; zero where the file's is not finite
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;
    std::vector<std::string> materialNames;  ///< the first is empty: before any usemtl
    std::vector<std::string> libraryNames;   ///< of each mtllib, as written
    std::size_t degenerateFaceCount = 0;     ///< faces of one or two corners, left out
};

/// Reads the polygons of an OBJ file [WavefrontObj]. Lines, points, free-form surfaces, groups and
/// smoothing groups are skipped.
///
/// @param name    how to call it in an error
/// @throws Error  malformed, naming the line
ObjGeometry parseObj(std::string_view text, const std::string& name);

}  // namespace prt

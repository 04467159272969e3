#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// How a rectangular image covers the sphere of directions (C4). All but the strips are seen from
/// inside, unmirrored.
enum class SphereMap {
    latLong,     ///< width = 2 height; u = ½ + atan2(z, x)/2π, v = arccos(y)/π from the top row
    angularMap,  ///< square; centre is −z, right is +x, up is +y, radius ∝ angle [Debevec98]
    verticalCross,  ///< 3:4; column 1 holds +y, −z, −y, +z from the top (+z turned by 180°), sides
                    ///< −x and +x
    horizontalCross,  ///< 4:3; row 1 holds −x, −z, +x, +z; +y and −y above and below −z
    verticalStrip,  ///< 1:6; faces +x −x +y −y +z −z as OpenGL samples them: seen from inside, each
                    ///< is mirrored
    horizontalStrip,  ///< 6:1; the same
    octahedral,  ///< square; centre +y, corners −y, middles of the edges right +x, left −x, top +z,
                 ///< bottom −z [Engelhardt08]
};

std::string_view sphereMapName(SphereMap map);
std::optional<SphereMap> parseSphereMap(std::string_view name);

bool fitsSphereMap(SphereMap map, int width, int height);

struct SphereMapSize {
    int width = 0;
    int height = 0;
};

/// The size of a map whose cells have so many texels on a side: the faces of a cube, the two halves
/// of a lat-long map, the whole of the others.
SphereMapSize sphereMapSize(SphereMap map, int cellSize);

/// The map whose shape fits, or nothing. Square images are angular maps.
std::optional<SphereMap> recogniseSphereMap(int width, int height);

/// One texel of a sphere map.
struct SphereTexel {
    Vec3d direction{0.0, 0.0, 0.0};  ///< unit, through the texel's centre
    double solidAngle = 0.0;         ///< steradians; both are 0 where a texel shows nothing
};

/// The direction and the exact solid angle of a texel.
///
/// Exact for lat-long rows (the difference of two cosines), cube faces (the arctangent form of
/// [Arvo95]) and octahedral maps (triangles [VanOosterom83]); angular maps are integrated by
/// quadrature inside the texel, to a relative 1e-4.
/// Texels show nothing in the empty cells of crosses, and where their centre lies outside the disc
/// of an angular map.
SphereTexel sphereTexel(SphereMap map, int width, int height, int x, int y);

/// The solid angles of all texels, row by row, scaled to sum to exactly 4π: what the texels of an
/// angular map lack is little.
std::vector<double> normalisedSolidAngles(SphereMap map, int width, int height);

/// A place of a sphere map, between texel centres too.
struct SpherePlace {
    Vec3d direction{0.0, 0.0, 0.0};  ///< unit
    double solidAngleDensity = 0.0;  ///< steradians per area of a pixel
};

/// Where a place of a sphere map lies on the sphere; pixelFromDirection leads back.
///
/// @param x, y  continuous pixel coordinates (texel centres at +½)
/// @return      all 0 where the map shows nothing
SpherePlace spherePlace(SphereMap map, int width, int height, double x, double y);

/// Continuous pixel coordinates (texel centres at +½) of the direction.
///
/// @param direction  unit, world space
Vec2f pixelFromDirection(SphereMap map, int width, int height, const Vec3f& direction);

struct WeightedTexel {
    int x = 0;
    int y = 0;
    float weight = 0.0f;
};

/// The texels around a direction with their bilinear weights, which sum to 1.
///
/// Wraps round lat-long maps and across the edges of octahedral ones, stays on one face of a cube,
/// and inside the disc of an angular map.
std::array<WeightedTexel, 4> bilinearTexels(SphereMap map, int width, int height,
                                            const Vec3f& direction);

}  // namespace prt

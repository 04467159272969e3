// Bibliography
//   [Debevec98]  Rendering synthetic objects into real scenes (angular maps)
//   [Arvo95]     Applications of irradiance tensors to the simulation of non-Lambertian phenomena
#include "prt/image/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "prt/base/assert.h"
#include "prt/image/octahedral_map.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

struct SphereMapTraits {
    SphereMap map;
    std::string_view name;
    int columnCount;  ///< the shape, in cells of the size of a face
    int rowCount;
};

constexpr std::array<SphereMapTraits, 7> kSphereMaps = {{
    {SphereMap::latLong, "lat-long", 2, 1},
    {SphereMap::angularMap, "angular-map", 1, 1},
    {SphereMap::verticalCross, "vertical-cross", 3, 4},
    {SphereMap::horizontalCross, "horizontal-cross", 4, 3},
    {SphereMap::verticalStrip, "vertical-strip", 1, 6},
    {SphereMap::horizontalStrip, "horizontal-strip", 6, 1},
    {SphereMap::octahedral, "octahedral", 1, 1},
}};

const SphereMapTraits& traitsOf(SphereMap map) {
    return kSphereMaps[static_cast<std::size_t>(map)];
}

bool fits(const SphereMapTraits& traits, int width, int height) {
    return width > 0 && width % traits.columnCount == 0 && height % traits.rowCount == 0 &&
           width / traits.columnCount == height / traits.rowCount;
}

void checkShape(SphereMap map, int width, int height) {
    PRT_ASSERT(fitsSphereMap(map, width, height), "the image has the shape of its map");
}

/// std::hypot without its care for overflow, which unit lengths do not
/// need and a million texels feel.
double lengthOf(double x, double y) {
    return std::sqrt(x * x + y * y);
}

// ── Cube maps ────────────────────────────────────────────────────────────────────────────────────

/// A face of the cube: the axis through its centre, and the axes that
/// the image's x and y run along.
struct CubeFace {
    int column;  ///< of the cell that the face fills
    int row;
    Vec3d forward;
    Vec3d right;
    Vec3d down;
};

constexpr Vec3d kX(1.0, 0.0, 0.0), kY(0.0, 1.0, 0.0), kZ(0.0, 0.0, 1.0);

using CubeFaces = std::array<CubeFace, 6>;

/// The cube folded out, so that neighbours in the image are neighbours on the cube; the crosses
/// differ in where the face behind hangs.
constexpr CubeFaces foldOut(const CubeFace& back) {
    return {{{1, 1, -kZ, kX, -kY},
             {0, 1, -kX, -kZ, -kY},
             {2, 1, kX, kZ, -kY},
             {1, 0, kY, kX, -kZ},
             {1, 2, -kY, kX, kZ},
             back}};
}

/// The faces one after another, along s and t of OpenGL's table of cube map faces.
constexpr CubeFaces lineUp(int columnStep, int rowStep) {
    CubeFaces faces = {{{0, 0, kX, -kZ, -kY},
                        {1, 1, -kX, kZ, -kY},
                        {2, 2, kY, kX, kZ},
                        {3, 3, -kY, kX, -kZ},
                        {4, 4, kZ, kX, -kY},
                        {5, 5, -kZ, -kX, -kY}}};
    for (CubeFace& face : faces) {
        face.column *= columnStep;
        face.row *= rowStep;
    }
    return faces;
}

constexpr CubeFaces kVerticalCross = foldOut({1, 3, kZ, kX, kY});
constexpr CubeFaces kHorizontalCross = foldOut({3, 1, kZ, -kX, -kY});
constexpr CubeFaces kVerticalStrip = lineUp(0, 1);
constexpr CubeFaces kHorizontalStrip = lineUp(1, 0);

const CubeFaces& cubeFaces(SphereMap map) {
    switch (map) {
        case SphereMap::verticalCross:
            return kVerticalCross;
        case SphereMap::horizontalCross:
            return kHorizontalCross;
        case SphereMap::verticalStrip:
            return kVerticalStrip;
        default:
            PRT_ASSERT(map == SphereMap::horizontalStrip, "the map is a cube");
    }
    return kHorizontalStrip;
}

/// The solid angle of the rectangle from the face's centre to (x, y),
/// both in units of its distance.
double cornerSolidAngle(double x, double y) {
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
}

/// A coordinate on a face, in units of its distance.
double faceCoordinate(double pixel, int faceSize) {
    return 2.0 * pixel / faceSize - 1.0;
}

/// The face that a place of the image belongs to, or null.
const CubeFace* faceAt(SphereMap map, int faceSize, double x, double y) {
    const int column = static_cast<int>(std::floor(x / faceSize));
    const int row = static_cast<int>(std::floor(y / faceSize));
    for (const CubeFace& face : cubeFaces(map))
        if (face.column == column && face.row == row) return &face;
    return nullptr;
}

SpherePlace cubePlace(SphereMap map, int faceSize, double x, double y) {
    const CubeFace* face = faceAt(map, faceSize, x, y);
    if (!face) return {};
    const double right = faceCoordinate(x - face->column * faceSize, faceSize);
    const double down = faceCoordinate(y - face->row * faceSize, faceSize);
    const Vec3d direction = face->forward + face->right * right + face->down * down;
    const double distance = direction.length();
    const double pixelSide = 2.0 / faceSize;
    return {direction / distance, pixelSide * pixelSide / (distance * distance * distance)};
}

SphereTexel cubeTexel(SphereMap map, int faceSize, int x, int y) {
    const CubeFace* face = faceAt(map, faceSize, x + 0.5, y + 0.5);
    if (!face) return {};
    const int column = x - face->column * faceSize;
    const int row = y - face->row * faceSize;
    const double x0 = faceCoordinate(column, faceSize);
    const double x1 = faceCoordinate(column + 1, faceSize);
    const double y0 = faceCoordinate(row, faceSize);
    const double y1 = faceCoordinate(row + 1, faceSize);
    return {cubePlace(map, faceSize, x + 0.5, y + 0.5).direction,
            cornerSolidAngle(x0, y0) - cornerSolidAngle(x0, y1) - cornerSolidAngle(x1, y0) +
                cornerSolidAngle(x1, y1)};
}

struct FacePixel {
    const CubeFace& face;
    Vec2f pixel;
};

FacePixel facePixelFromDirection(SphereMap map, int faceSize, const Vec3f& direction) {
    const Vec3d d(direction);
    const CubeFaces& faces = cubeFaces(map);
    const CubeFace& face = *std::max_element(
        faces.begin(), faces.end(),
        [&d](const CubeFace& a, const CubeFace& b) { return a.forward.dot(d) < b.forward.dot(d); });
    const double scale = 0.5 * faceSize / face.forward.dot(d);
    const double half = 0.5 * faceSize;
    return {face,
            Vec2f(static_cast<float>(face.column * faceSize + half + scale * face.right.dot(d)),
                  static_cast<float>(face.row * faceSize + half + scale * face.down.dot(d)))};
}

// ── Lat-long maps ────────────────────────────────────────────────────────────────────────────────

SpherePlace latLongPlace(int width, int height, double x, double y) {
    const double azimuth = 2.0 * std::numbers::pi * (x / width - 0.5);
    const double polar = std::numbers::pi * y / height;
    const double radius = std::sin(polar);
    return {Vec3d(radius * std::cos(azimuth), std::cos(polar), radius * std::sin(azimuth)),
            2.0 * std::numbers::pi / width * std::numbers::pi / height * radius};
}

SphereTexel latLongTexel(int width, int height, int x, int y) {
    const SpherePlace center = latLongPlace(width, height, x + 0.5, y + 0.5);
    // cos a − cos b = 2 sin((a + b)/2) sin((b − a)/2)
    const double band = 2.0 * std::sin(std::numbers::pi * (y + 0.5) / height) *
                        std::sin(0.5 * std::numbers::pi / height);
    return {center.direction, 2.0 * std::numbers::pi / width * band};
}

Vec2f latLongPixel(int width, int height, const Vec3f& direction) {
    const Vec3d d(direction);
    const double u = 0.5 + std::atan2(d.z, d.x) / (2.0 * std::numbers::pi);
    const double v = std::atan2(lengthOf(d.x, d.z), d.y) / std::numbers::pi;
    return Vec2f(static_cast<float>(u * width), static_cast<float>(v * height));
}

// ── Angular maps ─────────────────────────────────────────────────────────────────────────────────

/// Coordinates in which the disc of an angular map is the unit disc, x right and y down.
double discCoordinate(double pixel, int size) {
    return 2.0 * pixel / size - 1.0;
}

bool isInDisc(int size, int x, int y) {
    return lengthOf(discCoordinate(x + 0.5, size), discCoordinate(y + 0.5, size)) <= 1.0;
}

/// Solid angle per area of the disc, where the polar angle is π times the radius: π sin(πr)/r.
double angularDensity(double x, double y) {
    const double radius = lengthOf(x, y);
    return radius > 0.0
               ? std::numbers::pi * std::sin(std::numbers::pi * std::min(radius, 1.0)) / radius
               : std::numbers::pi * std::numbers::pi;
}

/// Integrates the density over the part of a square that lies in the disc.
double integrateAngularDensity(double left, double top, double side,
                               std::span<const QuadratureNode> rule) {
    double sum = 0.0;
    for (const QuadratureNode& row : rule) {
        const double y = top + 0.5 * side * (row.position + 1.0);
        const double chord = std::sqrt(std::max(1.0 - y * y, 0.0));
        const double start = std::clamp(left, -chord, chord);
        const double span = std::clamp(left + side, -chord, chord) - start;
        for (const QuadratureNode& column : rule) {
            const double x = start + 0.5 * span * (column.position + 1.0);
            sum += row.weight * column.weight * span * angularDensity(x, y);
        }
    }
    return 0.25 * side * sum;
}

SpherePlace angularPlace(int size, double pixelX, double pixelY) {
    const double x = discCoordinate(pixelX, size);
    const double y = discCoordinate(pixelY, size);
    const double radius = lengthOf(x, y);
    if (radius > 1.0) return {};
    const double sine = std::sin(std::numbers::pi * radius);
    const double perRadius = radius > 0.0 ? sine / radius : 0.0;
    const double pixelSide = 2.0 / size;
    return {Vec3d(x * perRadius, -y * perRadius, -std::cos(std::numbers::pi * radius)),
            pixelSide * pixelSide * angularDensity(x, y)};
}

SphereTexel angularTexel(int size, int pixelX, int pixelY) {
    if (!isInDisc(size, pixelX, pixelY)) return {};
    const double x = discCoordinate(pixelX + 0.5, size);
    const double y = discCoordinate(pixelY + 0.5, size);
    const double radius = lengthOf(x, y);

    // The integrand is smooth but at the rim, which few texels cross.
    static const std::vector<QuadratureNode> kSmoothRule = gaussLegendre(2);
    static const std::vector<QuadratureNode> kRimRule = gaussLegendre(32);
    const double side = 2.0 / size;
    const bool crossesRim = radius + side > 1.0;
    return {angularPlace(size, pixelX + 0.5, pixelY + 0.5).direction,
            integrateAngularDensity(x - 0.5 * side, y - 0.5 * side, side,
                                    crossesRim ? kRimRule : kSmoothRule)};
}

/// @param maxRadius  of the disc: the direction straight behind is everywhere on its rim
Vec2f angularPixel(int size, const Vec3f& direction, double maxRadius) {
    const Vec3d d(direction);
    const double sine = lengthOf(d.x, d.y);
    const double radius = std::min(std::atan2(sine, -d.z) / std::numbers::pi, maxRadius);
    const double x = sine > 0.0 ? radius * d.x / sine : radius;
    const double y = sine > 0.0 ? -radius * d.y / sine : 0.0;
    return Vec2f(static_cast<float>(0.5 * size * (1.0 + x)),
                 static_cast<float>(0.5 * size * (1.0 + y)));
}

// ── Look-up ──────────────────────────────────────────────────────────────────────────────────────

/// Where a direction falls, and the rectangle of texels that belong together there.
struct Footprint {
    Vec2f pixel;
    int minX, minY, maxX, maxY;
};

Footprint footprintOf(SphereMap map, int width, int height, const Vec3f& direction) {
    if (map == SphereMap::latLong) {
        return {latLongPixel(width, height, direction), 0, 0, width - 1, height - 1};
    }
    if (map == SphereMap::octahedral)
        return {octahedralPixel(width, direction), 0, 0, width - 1, height - 1};
    if (map == SphereMap::angularMap) {
        // Keep a texel's diagonal from the rim, so that the texel hit has its centre in the disc.
        const double maxRadius = std::max(1.0 - std::numbers::sqrt2 / width, 0.0);
        return {angularPixel(width, direction, maxRadius), 0, 0, width - 1, height - 1};
    }
    const int faceSize = width / traitsOf(map).columnCount;
    const auto [face, pixel] = facePixelFromDirection(map, faceSize, direction);
    const int minX = face.column * faceSize, minY = face.row * faceSize;
    return {pixel, minX, minY, minX + faceSize - 1, minY + faceSize - 1};
}

/// The texel of a footprint that stands for one that may lie just outside.
TexelIndex bringInside(SphereMap map, int width, const Footprint& footprint, int x, int y) {
    if (map == SphereMap::octahedral) return wrapOctahedral(width, x, y);
    return {map == SphereMap::latLong ? (x + width) % width
                                      : std::clamp(x, footprint.minX, footprint.maxX),
            std::clamp(y, footprint.minY, footprint.maxY)};
}

}  // namespace

std::string_view sphereMapName(SphereMap map) {
    return traitsOf(map).name;
}

std::optional<SphereMap> parseSphereMap(std::string_view name) {
    for (const SphereMapTraits& traits : kSphereMaps) {
        if (traits.name == name) return traits.map;
    }
    return std::nullopt;
}

bool fitsSphereMap(SphereMap map, int width, int height) {
    return fits(traitsOf(map), width, height);
}

SphereMapSize sphereMapSize(SphereMap map, int cellSize) {
    return {traitsOf(map).columnCount * cellSize, traitsOf(map).rowCount * cellSize};
}

std::optional<SphereMap> recogniseSphereMap(int width, int height) {
    for (const SphereMapTraits& traits : kSphereMaps) {
        if (fits(traits, width, height)) return traits.map;
    }
    return std::nullopt;
}

SphereTexel sphereTexel(SphereMap map, int width, int height, int x, int y) {
    checkShape(map, width, height);
    PRT_ASSERT(x >= 0 && x < width && y >= 0 && y < height, "the texel lies in the image");
    switch (map) {
        case SphereMap::latLong:
            return latLongTexel(width, height, x, y);
        case SphereMap::angularMap:
            return angularTexel(width, x, y);
        case SphereMap::octahedral:
            return octahedralTexel(width, x, y);
        default:
            return cubeTexel(map, width / traitsOf(map).columnCount, x, y);
    }
}

std::vector<double> normalisedSolidAngles(SphereMap map, int width, int height) {
    std::vector<double> solidAngles;
    solidAngles.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    double sum = 0.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            solidAngles.push_back(sphereTexel(map, width, height, x, y).solidAngle);
            sum += solidAngles.back();
        }
    for (double& solidAngle : solidAngles)
        solidAngle *= 4.0 * std::numbers::pi / sum;
    return solidAngles;
}

SpherePlace spherePlace(SphereMap map, int width, int height, double x, double y) {
    checkShape(map, width, height);
    switch (map) {
        case SphereMap::latLong:
            return latLongPlace(width, height, x, y);
        case SphereMap::angularMap:
            return angularPlace(width, x, y);
        case SphereMap::octahedral:
            return octahedralPlace(width, x, y);
        default:
            return cubePlace(map, width / traitsOf(map).columnCount, x, y);
    }
}

Vec2f pixelFromDirection(SphereMap map, int width, int height, const Vec3f& direction) {
    checkShape(map, width, height);
    switch (map) {
        case SphereMap::latLong:
            return latLongPixel(width, height, direction);
        case SphereMap::angularMap:
            return angularPixel(width, direction, 1.0);
        case SphereMap::octahedral:
            return octahedralPixel(width, direction);
        default:
            return facePixelFromDirection(map, width / traitsOf(map).columnCount, direction).pixel;
    }
}

std::array<WeightedTexel, 4> bilinearTexels(SphereMap map, int width, int height,
                                            const Vec3f& direction) {
    const Footprint footprint = footprintOf(map, width, height, direction);
    const float left = std::floor(footprint.pixel.x - 0.5f);
    const float top = std::floor(footprint.pixel.y - 0.5f);
    const float rightWeight = footprint.pixel.x - 0.5f - left;
    const float bottomWeight = footprint.pixel.y - 0.5f - top;

    std::array<WeightedTexel, 4> texels;
    float weightSum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const int column = i % 2, row = i / 2;
        WeightedTexel& texel = texels[static_cast<std::size_t>(i)];
        const auto [x, y] = bringInside(map, width, footprint, static_cast<int>(left) + column,
                                        static_cast<int>(top) + row);
        texel.x = x;
        texel.y = y;
        texel.weight = (column == 1 ? rightWeight : 1.0f - rightWeight) *
                       (row == 1 ? bottomWeight : 1.0f - bottomWeight);
        if (map == SphereMap::angularMap && !isInDisc(width, texel.x, texel.y)) texel.weight = 0.0f;
        weightSum += texel.weight;
    }
    for (WeightedTexel& texel : texels)
        texel.weight /= weightSum;
    return texels;
}

}  // namespace prt

#include "prt/image/sphere_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/image/image.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

struct Shape {
    SphereMap map;
    int columnCount;
    int rowCount;
};

constexpr Shape kShapes[] = {{SphereMap::latLong, 2, 1},       {SphereMap::angularMap, 1, 1},
                             {SphereMap::verticalCross, 3, 4}, {SphereMap::horizontalCross, 4, 3},
                             {SphereMap::verticalStrip, 1, 6}, {SphereMap::horizontalStrip, 6, 1},
                             {SphereMap::octahedral, 1, 1}};

bool isStrip(SphereMap map) {
    return map == SphereMap::verticalStrip || map == SphereMap::horizontalStrip;
}

double angleBetween(const Vec3d& a, const Vec3d& b) {
    return std::atan2(a.cross(b).length(), a.dot(b));
}

TEST(SphereMap, NamesLeadBackAndShapesAreRecognised) {
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        EXPECT_EQ(parseSphereMap(sphereMapName(map)), map);
        const auto [width, height] = sphereMapSize(map, 7);
        EXPECT_EQ(width, 7 * columnCount);
        EXPECT_EQ(height, 7 * rowCount);
        const SphereMap recognised = map == SphereMap::octahedral ? SphereMap::angularMap : map;
        EXPECT_EQ(recogniseSphereMap(32 * columnCount, 32 * rowCount), recognised);
    }
    EXPECT_EQ(parseSphereMap("octahedron"), std::nullopt);
    for (const auto& [width, height] : {std::pair(0, 0), {3, 2}, {33, 16}, {30, 41}, {-2, -1}}) {
        EXPECT_EQ(recogniseSphereMap(width, height), std::nullopt) << width << "x" << height;
    }
}

TEST(Conventions, C4_LatLongImagesAreCentredOnXWithZToTheRightAndYUp) {
    constexpr float kFloatRounding = 1e-3f;
    const struct {
        Vec3f direction;
        Vec2f uv;
    } table[] = {{{1, 0, 0}, {0.5f, 0.5f}},   {{0, 0, 1}, {0.75f, 0.5f}},
                 {{0, 0, -1}, {0.25f, 0.5f}}, {{-1, 0, -1e-6f}, {0, .5f}},
                 {{-1, 0, 1e-6f}, {1, 0.5f}}, {{0, 1, 0}, {0.5f, 0.0f}},
                 {{0, -1, 0}, {0.5f, 1.0f}}};
    for (const auto& [direction, uv] : table) {
        const Vec2f pixel = pixelFromDirection(SphereMap::latLong, 1024, 512, direction);
        EXPECT_NEAR(pixel.x, 1024 * uv.x, kFloatRounding);
        EXPECT_NEAR(pixel.y, 512 * uv.y, kFloatRounding);
    }
    const SphereTexel texel = sphereTexel(SphereMap::latLong, 8, 4, 4, 1);
    const double polar = kPi * 1.5 / 4, azimuth = kPi / 8;  // pixel centres at +½
    EXPECT_NEAR(
        angleBetween(texel.direction, Vec3d(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                            std::sin(polar) * std::sin(azimuth))),
        0.0, 1e-15);
}

TEST(Conventions, C4_OctahedralImagesShowUpInTheMiddleXToTheRightAndZAtTheTop) {
    constexpr float kFloatRounding = 1e-4f;
    const struct {
        Vec3f direction;
        Vec2f uv;
    } table[] = {{{0, 1, 0}, {0.5f, 0.5f}},       {{1, 0, 0}, {1.0f, 0.5f}},
                 {{-1, 0, 0}, {0.0f, 0.5f}},      {{0, 0, 1}, {0.5f, 0.0f}},
                 {{0, 0, -1}, {0.5f, 1.0f}},      {{1e-6f, -1, 1e-6f}, {1.0f, 0.0f}},
                 {{0.5f, 0, 0.5f}, {.75f, .25f}}, {{-1e-6f, -1, -1e-6f}, {0.0f, 1.0f}}};
    for (const auto& [direction, uv] : table) {
        const Vec2f pixel = pixelFromDirection(SphereMap::octahedral, 64, 64, direction);
        EXPECT_NEAR(pixel.x, 64 * uv.x, kFloatRounding);
        EXPECT_NEAR(pixel.y, 64 * uv.y, kFloatRounding);
    }
}

// The layouts, cell by cell, as the formats define them: what the middle of each cell looks at.
TEST(SphereMap, EveryCellLooksAlongItsAxis) {
    constexpr double kHalfTexel = 0.05;
    const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), nothing(0, 0, 0);
    const struct {
        SphereMap map;
        int columnCount;
        std::vector<Vec3d> cells;
    } layouts[] = {
        {SphereMap::verticalCross,
         3,
         {nothing, y, nothing, -x, -z, x, nothing, -y, nothing, nothing, z, nothing}},
        {SphereMap::horizontalCross,
         4,
         {nothing, y, nothing, nothing, -x, -z, x, z, nothing, -y, nothing, nothing}},
        {SphereMap::verticalStrip, 1, {x, -x, y, -y, z, -z}},
        {SphereMap::horizontalStrip, 6, {x, -x, y, -y, z, -z}},
    };
    constexpr int kFaceSize = 33;
    for (const auto& [map, columnCount, cells] : layouts) {
        const int rowCount = static_cast<int>(cells.size()) / columnCount;
        for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
            const SphereTexel texel =
                sphereTexel(map, columnCount * kFaceSize, rowCount * kFaceSize,
                            (i % columnCount) * kFaceSize + kFaceSize / 2,
                            (i / columnCount) * kFaceSize + kFaceSize / 2);
            const Vec3d& axis = cells[static_cast<std::size_t>(i)];
            EXPECT_EQ(texel.solidAngle == 0.0, axis == nothing);
            EXPECT_NEAR((texel.direction - axis).length(), 0.0, kHalfTexel)
                << sphereMapName(map) << " cell " << i;
        }
    }
}

// OpenGL 4.6, table 8.19, with v = −t: the direction that (s, t) of each face samples.
TEST(SphereMap, StripsAreTheFacesThatOpenGlSamples) {
    constexpr double kRounding = 1e-15;
    constexpr int kFaceSize = 4;
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kFaceSize; ++row) {
            for (int column = 0; column < kFaceSize; ++column) {
                const double s = 2.0 * (column + 0.5) / kFaceSize - 1.0;
                const double t = 2.0 * (row + 0.5) / kFaceSize - 1.0;
                const Vec3d table[] = {Vec3d(1, -t, -s), Vec3d(-1, -t, s), Vec3d(s, 1, t),
                                       Vec3d(s, -1, -t), Vec3d(s, -t, 1),  Vec3d(-s, -t, -1)};
                const Vec3d expected = table[face].normalized();
                const SphereTexel vertical =
                    sphereTexel(SphereMap::verticalStrip, kFaceSize, 6 * kFaceSize, column,
                                face * kFaceSize + row);
                const SphereTexel horizontal =
                    sphereTexel(SphereMap::horizontalStrip, 6 * kFaceSize, kFaceSize,
                                face * kFaceSize + column, row);
                EXPECT_NEAR((vertical.direction - expected).length(), 0.0, kRounding);
                EXPECT_NEAR((horizontal.direction - expected).length(), 0.0, kRounding);
            }
        }
    }
}

TEST(SphereMap, NeighboursInACrossAreNeighboursOnTheSphere) {
    constexpr int kFaceSize = 16;
    const double kLargestStep = 2.0 / kFaceSize * 1.01;  // a texel at the middle of a face
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        if (map != SphereMap::verticalCross && map != SphereMap::horizontalCross) continue;
        const int width = columnCount * kFaceSize, height = rowCount * kFaceSize;
        int pairCount = 0;
        for (int y = 0; y + 1 < height; ++y) {
            for (int x = 0; x + 1 < width; ++x) {
                const SphereTexel texel = sphereTexel(map, width, height, x, y);
                for (const auto& [stepX, stepY] : {std::pair(1, 0), std::pair(0, 1)}) {
                    const SphereTexel next = sphereTexel(map, width, height, x + stepX, y + stepY);
                    if (texel.solidAngle == 0.0 || next.solidAngle == 0.0) continue;
                    const int column = (x + stepX) / kFaceSize, row = (y + stepY) / kFaceSize;
                    // The outer cells of a cross touch empty cells only, so every
                    // such pair shares an edge.
                    EXPECT_LT(angleBetween(texel.direction, next.direction), kLargestStep)
                        << sphereMapName(map) << " cell " << column << ", " << row;
                    ++pairCount;
                }
            }
        }
        EXPECT_GT(pairCount, 6 * kFaceSize * (kFaceSize - 1));
    }
}

TEST(SphereMap, AnArrowSeenFromInsideIsNotMirrored) {
    RandomStream random(4, 0);
    int checkCount = 0;
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        const int width = columnCount * 64, height = rowCount * 64;
        for (int i = 0; i < 500; ++i) {
            const int x = static_cast<int>(random.nextUnitDouble() * (width - 1));
            const int y = static_cast<int>(random.nextUnitDouble() * (height - 1));
            const SphereTexel texel = sphereTexel(map, width, height, x, y);
            const SphereTexel right = sphereTexel(map, width, height, x + 1, y);
            const SphereTexel below = sphereTexel(map, width, height, x, y + 1);
            if (texel.solidAngle * right.solidAngle * below.solidAngle == 0.0) continue;
            if (angleBetween(texel.direction, right.direction) > 0.2)
                continue;  // across a seam of a strip
            if (angleBetween(texel.direction, below.direction) > 0.2) continue;
            // Seen from inside, right × down points ahead; OpenGL's faces are seen from outside.
            const double ahead = (right.direction - texel.direction)
                                     .cross(below.direction - texel.direction)
                                     .dot(texel.direction);
            EXPECT_EQ(ahead > 0.0, !isStrip(map)) << sphereMapName(map) << " " << x << ", " << y;
            ++checkCount;
        }
    }
    EXPECT_GT(checkCount, 1500);
}

TEST(SphereMap, PixelFromDirectionIsTheInverseOfTexelDirection) {
    constexpr float kFloatRounding = 2e-4f;  // of a pixel, in an image of a few hundred
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        const int width = columnCount * 32, height = rowCount * 32;
        int texelCount = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const SphereTexel texel = sphereTexel(map, width, height, x, y);
                if (texel.solidAngle == 0.0) continue;
                const Vec2f pixel = pixelFromDirection(map, width, height, Vec3f(texel.direction));
                ASSERT_NEAR(pixel.x, static_cast<float>(x) + 0.5f, kFloatRounding)
                    << sphereMapName(map);
                ASSERT_NEAR(pixel.y, static_cast<float>(y) + 0.5f, kFloatRounding)
                    << sphereMapName(map);
                ++texelCount;
            }
        }
        EXPECT_GT(texelCount, columnCount * rowCount == 1 ? 700 : 2000);
    }
}

double sumSolidAngles(const Shape& shape, int cellSize) {
    double sum = 0.0;
    const int width = shape.columnCount * cellSize, height = shape.rowCount * cellSize;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            sum += sphereTexel(shape.map, width, height, x, y).solidAngle;
    }
    return sum;
}

TEST(SphereMap, PlacesLeadBackAndTheirDensityAddsUpToTexels) {
    constexpr int kCellSize = 16;
    constexpr int kFine = 16;                // midpoints an axis of a texel
    constexpr double kMidpointError = 2e-3;  // of texels beside a pole
    constexpr double kPixelRounding = 1e-3;
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        const int width = kCellSize * columnCount, height = kCellSize * rowCount;
        int texelCount = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const SphereTexel texel = sphereTexel(map, width, height, x, y);
                const SpherePlace center = spherePlace(map, width, height, x + 0.5, y + 0.5);
                EXPECT_EQ(texel.solidAngle > 0.0, center.solidAngleDensity > 0.0);
                if (texel.solidAngle == 0.0) continue;
                EXPECT_LT(angleBetween(center.direction, texel.direction), 1e-12);
                const Vec2f back = pixelFromDirection(map, width, height, Vec3f(center.direction));
                EXPECT_NEAR(back.x, x + 0.5, kPixelRounding);
                EXPECT_NEAR(back.y, y + 0.5, kPixelRounding);
                // Texels that the rim of an angular map cuts are not smooth.
                const double radius = std::hypot(x + 0.5 - width / 2.0, y + 0.5 - height / 2.0);
                if (map == SphereMap::angularMap && radius > width / 2.0 - 1.0) continue;
                double sum = 0.0;
                for (int i = 0; i < kFine * kFine; ++i)
                    sum += spherePlace(map, width, height, x + (i % kFine + 0.5) / kFine,
                                       y + (i / kFine + 0.5) / kFine)
                               .solidAngleDensity;
                EXPECT_NEAR(sum / (kFine * kFine), texel.solidAngle,
                            kMidpointError * texel.solidAngle);
                ++texelCount;
            }
        }
        EXPECT_GT(texelCount, width * height / 3);
    }
}

TEST(SphereMap, SolidAnglesSumToTheSphere) {
    for (const Shape& shape : kShapes) {
        for (const int cellSize : {1, 2, 7, 64}) {
            if (shape.map == SphereMap::angularMap) continue;
            EXPECT_NEAR(sumSolidAngles(shape, cellSize) / (4.0 * kPi), 1.0, 1e-13)
                << sphereMapName(shape.map) << " " << cellSize;
        }
    }
    // An angular map loses the parts of texels whose centre is outside,
    // where little of the sphere is.
    EXPECT_NEAR(sumSolidAngles({SphereMap::angularMap, 1, 1}, 64) / (4.0 * kPi), 1.0, 5e-4);
    EXPECT_NEAR(sumSolidAngles({SphereMap::angularMap, 1, 1}, 256) / (4.0 * kPi), 1.0, 5e-5);
}

TEST(SphereMap, CubeTexelsHaveThePublishedSolidAngles) {
    constexpr double kPrintedPrecision = 1e-10;
    EXPECT_NEAR(sphereTexel(SphereMap::verticalStrip, 8, 48, 0, 0).solidAngle, .0155686079,
                kPrintedPrecision);
    EXPECT_NEAR(sphereTexel(SphereMap::verticalStrip, 8, 48, 3, 3).solidAngle, .0588575059,
                kPrintedPrecision);
}

TEST(SphereMap, EachQuarterOfAnOctahedralMapIsTwoOctants) {
    for (const int size : {2, 6, 10}) {
        double sum = 0.0;
        for (int y = 0; y < size / 2; ++y)
            for (int x = 0; x < size / 2; ++x)
                sum += sphereTexel(SphereMap::octahedral, size, size, x, y).solidAngle;
        EXPECT_NEAR(sum, kPi, 1e-13) << size;
    }
}

/// The solid angle of an angular-map texel as a plain sum over many points.
double sumAngularTexel(int size, int pixelX, int pixelY) {
    constexpr int kPointCount = 400;
    const double step = 2.0 / size / kPointCount;
    double sum = 0.0;
    for (int j = 0; j < kPointCount; ++j) {
        for (int i = 0; i < kPointCount; ++i) {
            const double x = 2.0 * pixelX / size - 1.0 + step * (i + 0.5);
            const double y = 2.0 * pixelY / size - 1.0 + step * (j + 0.5);
            const double radius = std::hypot(x, y);
            if (radius < 1.0) sum += kPi * std::sin(kPi * radius) / radius * step * step;
        }
    }
    return sum;
}

TEST(SphereMap, AngularTexelsAreAccurateToOnePartInTenThousand) {
    for (const int size : {8, 9, 20}) {
        for (int y = 0; y < (size + 1) / 2; ++y) {
            for (int x = 0; x < (size + 1) / 2; ++x) {
                const SphereTexel texel = sphereTexel(SphereMap::angularMap, size, size, x, y);
                if (texel.solidAngle == 0.0) continue;
                EXPECT_NEAR(texel.solidAngle / sumAngularTexel(size, x, y), 1.0, 1e-4)
                    << size << ": " << x << ", " << y;
            }
        }
    }
}

TEST(SphereMap, AngularTexelsAreAsLargeAsTheirMirrorImages) {
    constexpr double kRelativeRounding = 1e-12;
    constexpr int kSize = 9;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const auto solidAngle = [](int column, int row) {
                return sphereTexel(SphereMap::angularMap, kSize, kSize, column, row).solidAngle;
            };
            const double scale = kRelativeRounding * solidAngle(x, y);
            EXPECT_NEAR(solidAngle(kSize - 1 - x, y), solidAngle(x, y), scale);
            EXPECT_NEAR(solidAngle(x, kSize - 1 - y), solidAngle(x, y), scale);
        }
    }
}

TEST(SphereMap, AnglesOfAnAngularMapGrowWithTheRadius) {
    constexpr double kRounding = 1e-12;
    // Three quarters from the centre to the right is 135° from −z towards +x.
    const SphereTexel texel = sphereTexel(SphereMap::angularMap, 801, 801, 700, 400);
    const double angle = kPi * (700.5 / 400.5 - 1.0);
    EXPECT_NEAR(angleBetween(texel.direction, Vec3d(std::sin(angle), 0.0, -std::cos(angle))), 0.0,
                kRounding);
    EXPECT_GT(sphereTexel(SphereMap::angularMap, 801, 801, 400, 200).direction.y, 0.99);
}

TEST(BilinearTexels, WeightsSumToOneAndAverageBackToTheDirection) {
    constexpr float kWeightRounding = 1e-6f;
    RandomStream random(4, 1);
    for (const auto& [map, columnCount, rowCount] : kShapes) {
        const int width = columnCount * 64, height = rowCount * 64;
        for (int i = 0; i < 2000; ++i) {
            const double z = 2.0 * random.nextUnitDouble() - 1.0,
                         phi = 2.0 * kPi * random.nextUnitDouble();
            const double radius = std::sqrt(1.0 - z * z);
            const Vec3d direction(radius * std::cos(phi), radius * std::sin(phi), z);
            Vec3d mean(0.0);
            float weightSum = 0.0f;
            for (const auto& [x, y, weight] :
                 bilinearTexels(map, width, height, Vec3f(direction))) {
                const SphereTexel texel = sphereTexel(map, width, height, x, y);
                EXPECT_TRUE(weight == 0.0f || texel.solidAngle > 0.0);
                mean += texel.direction * weight;
                weightSum += weight;
            }
            EXPECT_NEAR(weightSum, 1.0f, kWeightRounding);
            // The clamp at seams, poles and rims moves a look-up by up to a texel's diagonal.
            EXPECT_LT(angleBetween(mean, direction), 1.5 * kPi / 64) << sphereMapName(map);
        }
    }
}

TEST(BilinearTexels, WrapRoundALatLongMap) {
    const auto texels = bilinearTexels(SphereMap::latLong, 8, 4, Vec3f(-1.0f, 0.0f, 0.0f));
    float left = 0.0f, right = 0.0f;
    for (const auto& [x, y, weight] : texels)
        (x == 0 ? left : right) += weight;
    EXPECT_FLOAT_EQ(left, 0.5f);
    EXPECT_FLOAT_EQ(right, 0.5f);
}

TEST(BilinearTexels, OfAnOctahedralMapKnowNoSeam) {
    constexpr int kSize = 64;
    constexpr double kGap = 1e-5;
    constexpr double kFloatRounding = 1e-4;
    const auto meanDirection = [](const Vec3d& direction) {
        Vec3d mean(0.0);
        for (const auto& [x, y, weight] :
             bilinearTexels(SphereMap::octahedral, kSize, kSize, Vec3f(direction)))
            mean += sphereTexel(SphereMap::octahedral, kSize, kSize, x, y).direction * weight;
        return mean;
    };
    RandomStream random(8, 0);
    for (int i = 0; i < 500; ++i) {
        // Pairs of directions on either side of a cut, a half plane below one of the axes.
        const double angle = 0.02 + (kPi - 0.04) * random.nextUnitDouble();
        const double along = std::cos(angle), down = -std::sin(angle);
        for (const auto& [a, b] :
             {std::pair(Vec3d(kGap, down, along), Vec3d(-kGap, down, along)),
              std::pair(Vec3d(along, down, kGap), Vec3d(along, down, -kGap))}) {
            EXPECT_LT((meanDirection(a) - meanDirection(b)).length(), 20 * kGap + kFloatRounding);
            EXPECT_LT(angleBetween(meanDirection(a), a), 0.5 * kPi / kSize);
        }
    }
}

}  // namespace
}  // namespace prt

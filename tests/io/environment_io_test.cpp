#include <cmath>
#include <limits>

#include "prt/io/environment_io.h"
#include "test_files.h"

namespace prt {
namespace {

using test::catchError;
using test::TemporaryFolder;

std::filesystem::path writeImage(const TemporaryFolder& folder, const std::string& name,
                                 const Image& image) {
    writeExr(folder.path() / name, image);
    return folder.path() / name;
}

Image constantImage(int width, int height, float value) {
    return Image(width, height, Vec3f(value));
}

TEST(EnvironmentIo, LayoutIsRecognisedByShape) {  // C4
    const TemporaryFolder folder;
    const std::vector<std::tuple<int, int, SphereMap>> shapes = {
        {8, 4, SphereMap::latLong},        {5, 5, SphereMap::angularMap},
        {6, 8, SphereMap::verticalCross},  {8, 6, SphereMap::horizontalCross},
        {2, 12, SphereMap::verticalStrip}, {12, 2, SphereMap::horizontalStrip}};
    for (const auto& [width, height, map] : shapes) {
        const auto path = writeImage(folder, "env.exr", constantImage(width, height, 3.0f));
        const LoadedEnvironment loaded = loadEnvironment(path);
        EXPECT_EQ(loaded.environment.map, map);
        EXPECT_EQ(loaded.environment.radiance.width, width);
        EXPECT_EQ(loadEnvironment(path, map).environment.map, map);
    }
}

TEST(EnvironmentIo, SquareImagesAreOctahedralWhereWanted) {  // C4
    const TemporaryFolder folder;
    const auto square = writeImage(folder, "env.exr", constantImage(4, 4, 1.0f));
    EXPECT_EQ(loadEnvironment(square, SphereMap::octahedral).environment.map,
              SphereMap::octahedral);
    const auto latLong = writeImage(folder, "wide.exr", constantImage(8, 4, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(latLong, SphereMap::octahedral); }).code(),
              ErrorCode::malformed);
}

TEST(EnvironmentIo, OtherShapesAreRefused) {
    const TemporaryFolder folder;
    const auto odd = writeImage(folder, "odd.exr", constantImage(7, 3, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(odd); }).code(), ErrorCode::malformed);
    const auto latLong = writeImage(folder, "env.exr", constantImage(8, 4, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(latLong, SphereMap::verticalCross); }).code(),
              ErrorCode::malformed);
}

TEST(EnvironmentIo, BadTexelsAreMendedAndCounted) {
    const TemporaryFolder folder;
    Image image = constantImage(4, 2, 2.0f);
    image.at(0, 0).x = std::numeric_limits<float>::quiet_NaN();
    image.at(1, 0).y = std::numeric_limits<float>::infinity();
    image.at(2, 1).z = -4.0f;
    const LoadedEnvironment loaded = loadEnvironment(writeImage(folder, "env.exr", image));
    EXPECT_EQ(loaded.mended.nanCount, 1u);
    EXPECT_EQ(loaded.mended.infiniteCount, 1u);
    EXPECT_EQ(loaded.mended.negativeCount, 1u);
    for (const Vec3f& texel : loaded.environment.radiance.pixels)
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_TRUE(std::isfinite(texel[channel]));
            EXPECT_GE(texel[channel], 0.0f);
        }
}

TEST(EnvironmentIo, SixFacesBecomeAStrip) {
    const std::vector<std::vector<std::string>> namings = {
        {"px", "nx", "py", "ny", "pz", "nz"},
        {"posx", "negx", "posy", "negy", "posz", "negz"},
        {"PX", "NX", "PY", "NY", "PZ", "NZ"}};
    for (const std::vector<std::string>& names : namings) {
        const TemporaryFolder folder;
        for (std::size_t i = 0; i < 6; ++i) {
            Image face = constantImage(2, 2, float(i + 1));
            face.at(1, 0) = Vec3f(float(i) + 0.5f);
            writeImage(folder, names[i] + ".exr", face);
        }
        folder.write("readme.txt", "not a face");
        const Environment environment = loadEnvironment(folder.path()).environment;
        EXPECT_EQ(environment.map, SphereMap::horizontalStrip);
        ASSERT_EQ(environment.radiance.width, 12);
        ASSERT_EQ(environment.radiance.height, 2);
        for (int i = 0; i < 6; ++i) {
            EXPECT_EQ(environment.radiance.at(2 * i, 1), Vec3f(float(i + 1)));
            EXPECT_EQ(environment.radiance.at(2 * i + 1, 0), Vec3f(float(i) + 0.5f));
        }
    }
}

/// The direction that OpenGL samples at (s, t) of a face, t counted from the first row in memory
/// (OpenGL 4.6, table 8.19: r solved for s_c, t_c and m_a).
Vec3f directionOfFace(std::size_t face, float s, float t) {
    const float sc = 2.0f * s - 1.0f, tc = 2.0f * t - 1.0f;
    const Vec3f directions[6] = {{1, -tc, -sc}, {-1, -tc, sc}, {sc, 1, tc},
                                 {sc, -1, -tc}, {sc, -tc, 1},  {-sc, -tc, -1}};
    return directions[face].normalized();
}

TEST(EnvironmentIo, FacesLieWhereOpenGlSamplesThem) {  // C4
    const TemporaryFolder folder;
    constexpr int kSize = 4;
    const char* names[6] = {"px", "nx", "py", "ny", "pz", "nz"};
    const auto valueOf = [](std::size_t face, int x, int y) {
        return float(100 * face + 10 * std::size_t(x) + std::size_t(y) + 1);
    };
    for (std::size_t face = 0; face < 6; ++face) {
        Image image(kSize, kSize);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                image.at(x, y) = Vec3f(valueOf(face, x, y));
        writeImage(folder, std::string(names[face]) + ".exr", image);
    }
    const Environment environment = loadEnvironment(folder.path()).environment;
    for (std::size_t face = 0; face < 6; ++face)
        for (const int x : {0, kSize - 1})
            for (const int y : {0, kSize - 1}) {
                const Vec3f direction =
                    directionOfFace(face, (float(x) + 0.5f) / kSize, (float(y) + 0.5f) / kSize);
                EXPECT_NEAR(lookUpRadiance(environment, direction).x, valueOf(face, x, y), 1e-2f)
                    << names[face] << " " << x << ", " << y;
            }
}

TEST(EnvironmentIo, FacesThatMakeNoCubeAreRefused) {
    const TemporaryFolder folder;
    for (const char* name : {"px.exr", "nx.exr", "py.exr", "ny.exr", "pz.exr"})
        writeImage(folder, name, constantImage(2, 2, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(folder.path()); }).code(), ErrorCode::notFound);
    writeImage(folder, "nz.exr", constantImage(3, 3, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(folder.path()); }).code(), ErrorCode::malformed);
    writeImage(folder, "nz.exr", constantImage(2, 3, 1.0f));
    EXPECT_EQ(catchError([&] { loadEnvironment(folder.path()); }).code(), ErrorCode::malformed);
    EXPECT_EQ(catchError([&] { loadEnvironment(folder.path(), SphereMap::latLong); }).code(),
              ErrorCode::invalidOption);
}

}  // namespace
}  // namespace prt

#include <cmath>

#include "prt/image/tone_curve.h"
#include "prt/io/ply_reader.h"
#include "prt/io/scene_io.h"
#include "test_files.h"

namespace prt {
namespace {

using test::append;
using test::appendBigEndian;
using test::catchError;
using test::TemporaryFolder;

const std::string kAsciiSquare =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty "
    "float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

Scene readBytes(const std::string& bytes) {
    return parsePly(bytes, "scene.ply");
}

Error readWrong(const std::string& bytes) {
    return catchError([&] { readBytes(bytes); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

void expectSquare(const Scene& scene) {
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    for (const Vec3f& normal : mesh.normals)
        EXPECT_EQ(normal, Vec3f(0, 0, 1));
    ASSERT_EQ(mesh.normals.size(), 4u);
    EXPECT_EQ(mesh.material, 0u);
    EXPECT_EQ(scene.materials.size(), 1u);
}

/// The square in binary, with a property and an element to pass over between what is wanted.
template <class Position, class Count, class Index, class Appender>
std::string makeBinarySquare(const std::string& format, const std::string& positionType,
                             const std::string& countType, const std::string& indexType,
                             Appender appendNumber) {
    std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 4\n";
    for (const char* name : {"x", "y"})
        bytes += "property " + positionType + " " + name + "\n";
    bytes += "property short quality\nproperty list uchar double weights\nproperty " +
             positionType + " z\n";
    bytes +=
        "element camera 2\nproperty uint id\nelement face 1\nproperty uchar flags\nproperty list " +
        countType + " " + indexType + " vertex_index\nend_header\n";
    const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const auto& corner : corners) {
        appendNumber(bytes, Position(corner[0]));
        appendNumber(bytes, Position(corner[1]));
        appendNumber(bytes, std::int16_t(-7));
        appendNumber(bytes, std::uint8_t(1));
        appendNumber(bytes, 0.5);
        appendNumber(bytes, Position(0));
    }
    for (const std::uint32_t id : {1u, 2u})
        appendNumber(bytes, id);
    appendNumber(bytes, std::uint8_t(9));
    appendNumber(bytes, Count(4));
    for (int i = 0; i < 4; ++i)
        appendNumber(bytes, Index(i));
    return bytes;
}

constexpr auto kLittle = [](std::string& bytes, auto number) { append(bytes, number); };
constexpr auto kBig = [](std::string& bytes, auto number) { appendBigEndian(bytes, number); };

TEST(Ply, SquareIsTwoTriangles) {
    expectSquare(readBytes(kAsciiSquare));
}

TEST(Ply, FilesAreReadFromTheirPath) {
    const TemporaryFolder folder;
    expectSquare(readPly(folder.write("square.ply", kAsciiSquare)));
}

TEST(Ply, HeadersMayEndTheirLinesAnyWay) {
    for (const char* lineEnd : {"\r\n", "\r"}) {
        std::string converted;
        for (const char c : kAsciiSquare)
            converted += c == '\n' ? lineEnd : std::string(1, c);
        expectSquare(readBytes(converted));
    }
    expectSquare(readBytes(kAsciiSquare.substr(0, kAsciiSquare.size() - 1)));
    expectSquare(readBytes(replaced(kAsciiSquare, "comment made", "obj_info made")));
    expectSquare(readBytes(replaced(kAsciiSquare, "format ascii 1.0\ncomment made by hand\n",
                                    "comment made by hand\nformat ascii 1.0\n")));
}

TEST(Ply, EveryTypeIsReadInBothByteOrders) {
    const std::string le = "binary_little_endian", be = "binary_big_endian";
    expectSquare(readBytes(
        makeBinarySquare<float, std::uint8_t, std::int32_t>(le, "float", "uchar", "int", kLittle)));
    expectSquare(readBytes(
        makeBinarySquare<float, std::uint8_t, std::int32_t>(be, "float", "uchar", "int", kBig)));
    expectSquare(readBytes(makeBinarySquare<double, std::int32_t, std::uint32_t>(
        le, "double", "int", "uint", kLittle)));
    expectSquare(readBytes(makeBinarySquare<double, std::uint32_t, std::uint16_t>(
        be, "float64", "uint32", "uint16", kBig)));
    expectSquare(readBytes(makeBinarySquare<std::int16_t, std::int8_t, std::uint8_t>(
        be, "int16", "int8", "uint8", kBig)));
    expectSquare(readBytes(makeBinarySquare<std::int8_t, std::uint16_t, std::int16_t>(
        le, "char", "ushort", "short", kLittle)));
}

TEST(Ply, VertexAttributesAreFoundByName) {
    const Mesh mesh =
        readBytes(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
            "float z\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty "
            "float t\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
            "element face 1\nproperty list uchar int vertex_index\nend_header\n"
            "0 0 0 0 3 4 0.25 0.25 255 0 188 51\n1 0 0 0 0 0 1 1 0 0 0 255\n0 1 0 0 0 -5 0 0 0 0 0 "
            "0\n3 0 1 2\n")
            .meshes[0];
    EXPECT_EQ(mesh.normals[0], Vec3f(0.0f, 0.6f, 0.8f));
    EXPECT_EQ(mesh.normals[1], Vec3f(0, 0, 1));  // was zero
    EXPECT_EQ(mesh.normals[2], Vec3f(0, 0, -1));
    EXPECT_EQ(mesh.uvSets[0][0], Vec2f(0.25f, 0.75f));
    EXPECT_EQ(mesh.colors[0], Vec4f(1.0f, 0.0f, decodeSrgb(188.0f / 255.0f), 0.2f));
}

TEST(Ply, FloatingPointColoursAreLinear) {
    const Mesh mesh = readBytes(
                          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                          "float y\nproperty float z\n"
                          "property float red\nproperty float green\nproperty float blue\n"
                          "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                          "0 0 0 0.5 0.25 1\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n")
                          .meshes[0];
    EXPECT_EQ(mesh.colors[0], Vec4f(0.5f, 0.25f, 1.0f, 1.0f));
}

TEST(Ply, WrongFilesAreMalformed) {
    const std::vector<std::pair<std::string, std::string>> changes = {
        {"ply\n", "plx\n"},
        {"ascii", "asci"},
        {"element vertex 4", "element vertex"},
        {"element vertex 4", "element vertex -4"},
        {"element vertex 4", "property float x"},
        {"float x", "float32x x"},
        {"property float z", "property float w"},
        {"uchar int", "float int"},
        {"element face", "elephant face"},
        {"4 0 1 2 3", "4 0 1 2 4"},
        {"4 0 1 2 3", "4 0 1 2 -1"},
        {"4 0 1 2 3", "4 0 1 2 1.5"},
        {"4 0 1 2 3", "-1"},
        {"4 0 1 2 3", "256 0 1 2 3"},
        {"4 0 1 2 3", "5 0 1 2 3"},
        {"1 1 0", "1 nan 0"},
        {"1 1 0", "1 inf 0"},
        {"1 1 0", "1 1e39 0"},
        {"1 1 0", "1 one 0"}};
    for (const auto& [from, to] : changes)
        EXPECT_EQ(readWrong(replaced(kAsciiSquare, from, to)).code(), ErrorCode::malformed) << to;
    EXPECT_EQ(readWrong(replaced(kAsciiSquare, "1.0", "2.0")).code(), ErrorCode::unsupported);
    EXPECT_EQ(readWrong("").code(), ErrorCode::malformed);
}

TEST(Ply, ClaimsBeyondTheFileAreRefusedBeforeAllocation) {
    for (const char* count : {"1000000000000", "18446744073709551615", "4294967295"}) {
        EXPECT_EQ(
            readWrong(replaced(kAsciiSquare, "vertex 4", std::string("vertex ") + count)).code(),
            ErrorCode::malformed);
        EXPECT_EQ(readWrong(replaced(kAsciiSquare, "face 1", std::string("face ") + count)).code(),
                  ErrorCode::malformed);
        EXPECT_EQ(readWrong(replaced(kAsciiSquare, "element face",
                                     std::string("element none ") + count + "\nelement face"))
                      .code(),
                  ErrorCode::malformed);
    }
    std::string binary = makeBinarySquare<float, std::uint32_t, std::int32_t>(
        "binary_little_endian", "float", "uint", "int", kLittle);
    binary.replace(binary.size() - 20, 4, "\xff\xff\xff\xff");
    EXPECT_EQ(readWrong(binary).code(), ErrorCode::malformed);
}

TEST(Ply, PointCloudsAreUnsupported) {
    const std::string cloud =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
        "float z\nend_header\n0 0 0\n";
    EXPECT_EQ(readWrong(cloud).code(), ErrorCode::unsupported);
}

TEST(Ply, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    const auto read = [](const std::string& bytes) {
        const Scene scene = parsePly(bytes, "scene.ply");
        for (const Mesh& mesh : scene.meshes) {
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
            for (const std::uint32_t index : mesh.indices)
                ASSERT_LT(index, mesh.positions.size());
            for (const Vec3f& p : mesh.positions)
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        }
    };
    EXPECT_EQ(test::readDamaged(kAsciiSquare, read), 1u);  // only the last newline may be missing
    EXPECT_EQ(test::readDamaged(makeBinarySquare<float, std::uint8_t, std::int32_t>(
                                    "binary_little_endian", "float", "uchar", "int", kLittle),
                                read),
              0u);
    EXPECT_EQ(test::readDamaged(makeBinarySquare<double, std::int32_t, std::uint32_t>(
                                    "binary_big_endian", "double", "int", "uint", kBig),
                                read),
              0u);
}

}  // namespace
}  // namespace prt

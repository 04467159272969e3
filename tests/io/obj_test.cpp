#include <cmath>

#include "png_bytes.h"
#include "prt/image/tone_curve.h"
#include "prt/io/mtl_parser.h"
#include "prt/io/obj_parser.h"
#include "prt/io/scene_io.h"

namespace prt {
namespace {

using test::catchError;
using test::TemporaryFolder;

// Unit vectors in float.
constexpr float kUnitTolerance = 1e-6f;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kTexturedSquare = kSquare + "vt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 1\n";

Scene readText(const std::string& text) {
    const TemporaryFolder folder;
    return readObj(folder.write("scene.obj", text));
}

Error readWrong(const std::string& text) {
    return catchError([&] { readText(text); });
}

/// Everything a reader promises (scene.h).
void expectPromisesKept(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.indices.size() % 3, 0u);
        for (const std::vector<Vec2f>& uvs : mesh.uvSets)
            ASSERT_TRUE(uvs.empty() || uvs.size() == mesh.positions.size());
        ASSERT_TRUE(mesh.colors.empty() || mesh.colors.size() == mesh.positions.size());
        for (const std::uint32_t index : mesh.indices)
            ASSERT_LT(index, mesh.positions.size());
        for (const Vec3f& p : mesh.positions)
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        for (const Vec3f& normal : mesh.normals)
            ASSERT_NEAR(normal.length(), 1.0f, kUnitTolerance);
    }
    for (const Material& material : scene.materials)
        if (material.baseColorTexture) {
            ASSERT_LT(material.baseColorTexture->image, scene.images.size());
        }
}

TEST(Obj, SquareIsTwoTriangles) {
    const Scene scene = readText(kSquare + "f 1 2 3 4\n");
    expectPromisesKept(scene);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[2], Vec3f(1, 1, 0));
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(scene.meshes[0].normals[0], Vec3f(0, 0, 1));
    EXPECT_TRUE(scene.meshes[0].uvSets[0].empty());
    EXPECT_TRUE(scene.meshes[0].colors.empty());
    EXPECT_EQ(scene.materials[0].baseColorFactor, Vec4f(1.0f));
}

TEST(Obj, WaysOfWritingTheSameFile) {
    const std::vector<std::string> texts = {
        kSquare + "f 1 2 3 4",                       // no final newline
        kSquare + "f -4 -3 -2 -1\n",                 // relative
        "f 1 2 3 4\n" + kSquare,                     // before its vertices
        kSquare + "f 1 2 \\\n3 4\n",                 // continued
        kSquare + "\t f\t1//  2/ 3/0/0 4 # four\n",  // blanks and empty fields
        "# UTF-8 \xe2\x82\xac\ng a b\ns off\n" + kSquare + "l 1 2\np 1\no\xc3\xa4\nf +1 2 3 4\n",
        "v +0. .0 0e5\nv 1e0 -0 0 1.0\nv 1.000000000000000000001 1 0\nv 0 1 0\nf 1 2 3 4\n"};
    for (const std::string& text : texts) {
        for (const char* lineEnd : {"\n", "\r\n", "\r"}) {
            std::string converted;
            for (const char c : text)
                converted += c == '\n' ? lineEnd : std::string(1, c);
            const Scene scene = readText(converted);
            ASSERT_EQ(scene.meshes.size(), 1u) << text;
            EXPECT_EQ(scene.meshes[0].positions,
                      (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
            EXPECT_EQ(scene.meshes[0].indices.size(), 6u);
        }
    }
}

TEST(Obj, VerticesAreSplitOnlyWhereUvOrNormalDiffer) {
    const std::string text =
        kTexturedSquare + "vn 0 0 2\nvn 0 1 0\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n";
    const Scene shared = readText(text);
    expectPromisesKept(shared);
    EXPECT_EQ(shared.meshes[0].vertexCount(), 4u);
    const Scene split = readText(text + "f 1/2/1 3/3/2 4/4/1\n");
    EXPECT_EQ(split.meshes[0].vertexCount(), 6u);
}

TEST(Obj, TextureCoordinatesCountFromTheTop) {
    const Scene scene = readText(kTexturedSquare + "f 1/1 2/2 3/-2 4/-1\n");
    EXPECT_EQ(scene.meshes[0].uvSets[0], (std::vector<Vec2f>{{0, 1}, {1, 1}, {1, 0.25f}, {0, 0}}));
}

TEST(Obj, NormalsAreMadeUnitAndMissingOnesComputed) {
    const Scene scene = readText(kSquare + "vn 0 3 4\nvn nan nan nan\nf 1//1 2//2 3//-1 4\n");
    expectPromisesKept(scene);
    EXPECT_EQ(scene.meshes[0].normals[0], Vec3f(0.0f, 0.6f, 0.8f));
    for (int i = 1; i < 4; ++i)
        EXPECT_EQ(scene.meshes[0].normals[std::size_t(i)], Vec3f(0, 0, 1));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(Obj, VertexColoursAreDecodedFromSrgb) {  // C5
    const Scene scene = readText("v 0 0 0 0.5 0 1\nv 1 0 0 2 -1 0.25\nv 0 1 0\nf 1 2 3\n");
    ASSERT_EQ(scene.meshes[0].colors.size(), 3u);
    EXPECT_NEAR(scene.meshes[0].colors[0].x, 0.21404114, 1e-6);  // ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_EQ(scene.meshes[0].colors[0].z, 1.0f);
    EXPECT_EQ(scene.meshes[0].colors[1], Vec4f(1.0f, 0.0f, decodeSrgb(0.25f), 1.0f));
    EXPECT_EQ(scene.meshes[0].colors[2], Vec4f(1.0f));
}

TEST(Obj, ConcavePolygonsKeepTheirShape) {
    const Scene scene = readText("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n");
    float area = 0.0f;
    const Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3f& a = mesh.positions[mesh.indices[i]];
        area += (mesh.positions[mesh.indices[i + 1]] - a)
                    .cross(mesh.positions[mesh.indices[i + 2]] - a)
                    .length() /
                2;
    }
    EXPECT_FLOAT_EQ(area, 1.0f);  // a fan would cover 3
}

TEST(Obj, ErrorsNameTheLine) {  // F7
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {kSquare + "f 1 2 5\n", "line 5"},
        {kSquare + "\nf 1 2 -5\n", "line 6"},
        {kSquare + "f 1 2 0\n", "line 5"},
        {kSquare + "f 1/1 2/1 3/1\n", "line 5"},
        {kSquare + "f 1//7 2//7 3//7\n", "line 5"},
        {kSquare + "f 1 2 3/x\n", "line 5"},
        {kSquare + "f 1 2 3/1/1/1\n", "line 5"},
        {kSquare + "f 1 2 99999999999999999999\n", "line 5"},
        {kSquare + "f 1 2 4294967296\n", "line 5"},
        {"v 0 0 nan\n" + kSquare + "f 2 3 4\n", "line 1"},
        {"\nv 0 inf 0\n", "line 2"},
        {"v 0 1e39 0\n", "line 1"},
        {"v 0 0\n", "line 1"},
        {"v 0 0 0,5\n", "line 1"},
        {"v 0 0 0x10\n", "line 1"},
        {"v 0 0 0 1 1 nan\n", "line 1"},
        {kSquare + "vt nan 0\n", "line 5"},
        {kSquare + "vn 0 0\n", "line 5"}};
    for (const auto& [text, place] : wrong) {
        const Error error = readWrong(text);
        EXPECT_EQ(error.code(), ErrorCode::malformed) << text;
        EXPECT_EQ(std::string(error.what()).find(place + " "), 0u) << error.what();
        EXPECT_NE(error.where().find("scene.obj"), std::string::npos);
    }
}

TEST(Obj, FilesWithoutFacesAreMalformed) {
    for (const char* text : {"", "\n", "v 0 0 0\n", "\xff\xfev\0 \0"})
        EXPECT_EQ(readWrong(text).code(), ErrorCode::malformed);
}

TEST(Obj, FacesOfOneOrTwoCornersAreLeftOutWithAWarning) {
    const Scene scene = readText(kSquare + "f 1 2\nf 3\nf\nf 1 2 3\n");
    EXPECT_EQ(scene.triangleCount(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].substr(0, 1), "3");
}

TEST(Obj, EachMaterialIsOneMesh) {
    const TemporaryFolder folder;
    folder.write("my materials.mtl",
                 "Kd 9 9 9\nnewmtl red\nKd 0.5 0.25 2\nKe 3 2 1\nillum 2\n\nnewmtl two words\r\nKd "
                 "0.125\nd 0.5\n");
    const Scene scene =
        readObj(folder.write("scene.obj", "mtllib my materials.mtl\n" + kSquare +
                                              "f 1 2 3\nusemtl red\nf 1 2 3\nf 2 3 4\nusemtl two "
                                              "words\nf 1 3 4\nusemtl red\nf 4 3 2\n"
                                              "usemtl unknown\nf 1 2 4\n"));
    expectPromisesKept(scene);
    ASSERT_EQ(scene.meshes.size(), 4u);
    EXPECT_EQ(scene.meshes[0].name, "default");
    EXPECT_EQ(scene.meshes[1].name, "red");
    EXPECT_EQ(scene.meshes[1].triangleCount(), 3u);
    EXPECT_EQ(scene.meshes[2].name, "two words");
    const Material& red = scene.materials[scene.meshes[1].material];
    EXPECT_EQ(red.baseColorFactor, Vec4f(0.5f, 0.25f, 1.0f, 1.0f));
    EXPECT_EQ(red.emissiveFactor, Vec3f(3, 2, 1));
    EXPECT_EQ(scene.materials[scene.meshes[2].material].baseColorFactor,
              Vec4f(0.125f, 0.125f, 0.125f, 1.0f));
    EXPECT_EQ(scene.materials[scene.meshes[3].material].baseColorFactor, Vec4f(1.0f));
    EXPECT_EQ(scene.warnings.size(), 2u);  // transparency, unknown
}

TEST(Obj, TexturesAreReadFromTheFolderAndBelow) {
    const TemporaryFolder folder;
    const std::string png = test::PngBytes{.rows = std::string("\0\1\2\3", 4)}.file();
    folder.write("textures/a b.png", png);
    folder.write("grey.jpg", test::makeGreyJpeg());
    folder.write(
        "scene.mtl",
        "newmtl a\nmap_Kd -clamp on -s 1 1 -o 0.5 textures\\a b.png\nnewmtl b\nmap_Kd grey.jpg\n"
        "newmtl c\nmap_Kd -bm 1 textures/a b.png\n");
    const Scene scene = loadScene(
        folder.write("scene.obj", "mtllib scene.mtl\n" + kTexturedSquare +
                                      "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl "
                                      "c\nf 1/1 2/2 3/3\nusemtl b\nf 1 2 4\n"));
    expectPromisesKept(scene);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"2 triangles lie exactly on others"});
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(scene.images[0].mimeType, "image/png");
    EXPECT_EQ(scene.images[1].mimeType, "image/jpeg");
    EXPECT_EQ(scene.images[0].pixels.at(0, 0).blue, 3);
    EXPECT_EQ(scene.images[1].pixels.width, 8);
    EXPECT_EQ(scene.materials[0].baseColorTexture->wrapU, TextureWrap::clampToEdge);
    EXPECT_EQ(scene.materials[1].baseColorTexture->wrapV, TextureWrap::repeat);
    EXPECT_EQ(scene.materials[2].baseColorTexture->image, 0u);
}

TEST(Obj, NothingOutsideTheFolderIsOpened) {
    const TemporaryFolder outer;
    const std::string png = test::PngBytes{.rows = std::string("\0\1\2\3", 4)}.file();
    const std::filesystem::path secret = outer.write("secret.png", png);
    outer.write("secret.mtl", "newmtl a\nKd 0 0 0\n");
    std::filesystem::create_directories(outer.path() / "inner");
    std::filesystem::create_symlink(secret, outer.path() / "inner" / "link.png");
    for (const std::string& name :
         {std::string("../secret.png"), secret.string(), std::string("link.png"),
          std::string("..\\secret.png"), std::string("missing.png"), std::string("."),
          "file://" + secret.string()}) {
        outer.write("inner/scene.mtl", "newmtl a\nKd 1 1 1\nmap_Kd " + name + "\n");
        const Scene scene = loadScene(
            outer.write("inner/scene.obj", "mtllib ../secret.mtl\nmtllib scene.mtl\n" +
                                               kTexturedSquare + "usemtl a\nf 1/1 2/2 3/3\n"));
        EXPECT_TRUE(scene.images.empty()) << name;
        EXPECT_FALSE(scene.materials[0].baseColorTexture);
        EXPECT_EQ(scene.materials[0].baseColorFactor, Vec4f(1.0f));
        EXPECT_EQ(scene.warnings.size(), 2u) << name;
    }
}

TEST(Obj, TextureWithoutCoordinatesOrOfAnotherFormatIsLeftOut) {
    const TemporaryFolder folder;
    folder.write("a.png", test::PngBytes{.rows = std::string("\0\1\2\3", 4)}.file());
    folder.write("a.tga", "no magic");
    folder.write("scene.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd a.tga\n");
    const Scene scene =
        readObj(folder.write("scene.obj", "mtllib scene.mtl\n" + kTexturedSquare +
                                              "usemtl a\nf 1 2 3\nusemtl b\nf 1/1 2/2 3/3\n"));
    expectPromisesKept(scene);
    EXPECT_FALSE(scene.materials[0].baseColorTexture);
    EXPECT_FALSE(scene.materials[1].baseColorTexture);
    EXPECT_EQ(scene.warnings.size(), 2u);
}

TEST(Obj, WrongLibrariesAreMalformed) {
    for (const char* text :
         {"newmtl a\nKd\n", "newmtl a\nKd 1 2\n", "newmtl a\nKd red\n", "newmtl a\nKe 1 nan 1\n",
          "newmtl a\nKd -1 0 0\n", "newmtl a\nd x\n"}) {
        const TemporaryFolder folder;
        folder.write("scene.mtl", text);
        const auto path = folder.write("scene.obj", "mtllib scene.mtl\n" + kSquare + "f 1 2 3\n");
        const Error error = catchError([&] { readObj(path); });
        EXPECT_EQ(error.code(), ErrorCode::malformed) << text;
        EXPECT_NE(error.where().find("scene.mtl"), std::string::npos);
    }
}

TEST(Obj, EveryPrefixAndEveryChangeIsSurvived) {
    const std::string text = "mtllib s.mtl\n" + kTexturedSquare +
                             "vn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4/-1/-1\nf -4 -3 -2\n";
    test::readDamaged(text, [&](const std::string& bytes) {
        const ObjGeometry geometry = parseObj(bytes, "scene.obj");
        for (const ObjFace& face : geometry.faces)
            for (std::size_t i = 0; i < face.cornerCount; ++i) {
                const ObjCorner& corner = geometry.corners.at(face.firstCorner + i);
                ASSERT_LT(corner.position, geometry.positions.size());
                ASSERT_TRUE(corner.uv == kObjNone || corner.uv < geometry.uvs.size());
                ASSERT_TRUE(corner.normal == kObjNone || corner.normal < geometry.normals.size());
            }
    });
    const std::string library =
        "newmtl a\nKd 1 .5 1\nKe 0 0 1\nd 0.5\nmap_Kd -s 1 1 1 -clamp on x.png\n";
    test::readDamaged(library, [](const std::string& bytes) { parseMtl(bytes, "s.mtl"); });
}

TEST(Obj, GridOfManyVerticesKeepsItsCounts) {
    constexpr int kCells = 190;  // 36,481 vertices, about the Stanford bunny
    std::string text;
    for (int y = 0; y <= kCells; ++y)
        for (int x = 0; x <= kCells; ++x)
            text += "v " + std::to_string(float(x) / 7.0f) + " " + std::to_string(float(y) / 7.0f) +
                    " 0.123456\n";
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            const int first = y * (kCells + 1) + x + 1;
            for (const int corner : {first, first + 1, first + kCells + 2, first + kCells + 1})
                text += (corner == first ? "f " : " ") + std::to_string(corner);
            text += '\n';
        }
    const Scene scene = readText(text);
    EXPECT_EQ(scene.vertexCount(), std::size_t((kCells + 1) * (kCells + 1)));
    EXPECT_EQ(scene.triangleCount(), std::size_t(2 * kCells * kCells));
}

}  // namespace
}  // namespace prt

#include "prt/io/scene_io.h"

#include "test_files.h"

namespace prt {
namespace {

using test::catchError;
using test::TemporaryFolder;

const std::string kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kTrianglePly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 "
    "1 2\n";
// One triangle as unsigned bytes would not be aligned; three float positions as base64.
const std::string kTriangleGltf =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

TEST(LoadScene, SuffixDecidesWhateverItsCase) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> files = {{"a.obj", kTriangleObj},
                                                                    {"a.OBJ", kTriangleObj},
                                                                    {"a.ply", kTrianglePly},
                                                                    {"a.Ply", kTrianglePly},
                                                                    {"a.gltf", kTriangleGltf}};
    for (const auto& [name, text] : files) {
        const Scene scene = loadScene(folder.write(name, text));
        ASSERT_EQ(scene.vertexCount(), 3u) << name;
        EXPECT_EQ(scene.meshes[0].positions[1], Vec3f(1, 0, 0));
        EXPECT_EQ(scene.meshes[0].normals[0], Vec3f(0, 0, 1));
        EXPECT_FALSE(scene.materials.empty());
    }
}

TEST(LoadScene, OtherSuffixesAreUnsupportedAndTheHintNamesOurs) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.fbx", "");
    const Error error = catchError([&] { loadScene(path); });
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    for (const char* suffix : {".gltf", ".glb", ".obj", ".ply"})
        EXPECT_NE(error.hint().find(suffix), std::string::npos) << suffix;
}

TEST(LoadScene, OdditiesAreKeptAndCounted) {
    const TemporaryFolder folder;
    const Scene scene = loadScene(
        folder.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 3\nf 1 1 2\n"));
    EXPECT_EQ(scene.triangleCount(), 3u);
    EXPECT_EQ(scene.warnings,
              (std::vector<std::string>{"1 triangle has no area, and no ray meets it",
                                        "1 triangle lies exactly on another"}));
}

TEST(LoadScene, MissingFilesAreNotFound) {
    const TemporaryFolder folder;
    for (const char* name : {"none.obj", "none.ply", "none.glb", "none.gltf"}) {
        const Error error = catchError([&] { loadScene(folder.path() / name); });
        EXPECT_EQ(error.code(), ErrorCode::notFound) << name;
        EXPECT_NE(error.where().find(name), std::string::npos);
    }
}

}  // namespace
}  // namespace prt

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "prt/base/checksum.h"
#include "prt/base/random.h"
#include "prt/gltf/glb_writer.h"
#include "prt/gltf/gltf_document.h"
#include "prt/gltf/vertex_order.h"
#include "tests/gltf/glb_file.h"

namespace prt {
namespace {

using test::GlbFile;
using test::splitGlb;
using Json = nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";

/// A wavy grid, with all attributes that a mesh can have.
Mesh makeWaves(std::uint32_t side) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const auto x = static_cast<float>(i % side), z = static_cast<float>(i / side);
        mesh.positions.emplace_back(x, 0.25f * std::sin(x), z);
        mesh.normals.push_back(Vec3f(-0.25f * std::cos(x), 1.0f, 0.0f).normalized());
        mesh.uvSets[0].emplace_back(x / 16.0f, z / 16.0f);
        mesh.colors.emplace_back(x / 32.0f, z / 32.0f, 1.0f, 1.0f);
    }
    for (std::uint32_t z = 0; z + 1 < side; ++z)
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t i = z * side + x;
            for (const std::uint32_t corner : {i, i + side, i + 1, i + 1, i + side, i + side + 1})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

/// An even and an odd number of short indices, and an image whose length is no multiple of four.
Scene makeWavyScene() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {makeWaves(20), makeWaves(12)};
    scene.meshes[1].indices.resize(scene.meshes[1].indices.size() - 3);
    TextureImage image;
    image.mimeType = "image/png";
    for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00})
        image.encoded.push_back(static_cast<std::byte>(byte));
    scene.images = {image};
    scene.materials[0].baseColorTexture = TextureUse{};
    return scene;
}

/// Two attributes of random bytes for each mesh: no encoding makes them fewer. The one in between
/// is smooth.
GlbExtension makeExtension(const Scene& scene) {
    GlbExtension extension;
    extension.name = "TEST_extension";
    extension.rootJson = "{}";
    for (const Mesh& mesh : scene.meshes) {
        extension.meshJson.push_back("{}");
        auto& attributes = extension.attributes.emplace_back();
        for (const bool isSmooth : {false, true, false})
            attributes.push_back({"_TEST_" + std::to_string(attributes.size()),
                                  {mesh.vertexCount(), 4, ComponentType::uint8, true},
                                  [isSmooth](std::span<std::byte> values) {
                                      RandomStream random(1, 1);
                                      for (std::size_t i = 0; i < values.size(); ++i)
                                          values[i] = static_cast<std::byte>(
                                              isSmooth ? i / 16 : random.nextBits());
                                  }});
    }
    return extension;
}

std::vector<std::byte> encodeWaves(bool meshopt) {
    const Scene scene = makeWavyScene();
    const GlbExtension extension = makeExtension(scene);
    return encodeGlb(scene, &extension, {.meshopt = meshopt});
}

/// A triangle's corners from the smallest on.
std::array<std::uint32_t, 3> triangleAt(const std::vector<std::uint32_t>& indices, std::size_t t) {
    std::array<std::uint32_t, 3> triangle = {indices[3 * t], indices[3 * t + 1],
                                             indices[3 * t + 2]};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    return triangle;
}

TEST(MeshoptWriter, TheEncodedFileHoldsTheSameInFewerBytes) {
    const std::vector<std::byte> plain = encodeWaves(false), encoded = encodeWaves(true);
    EXPECT_LT(2 * encoded.size(), plain.size());
    const GltfDocument a(plain, ""), b(encoded, "");
    ASSERT_EQ(a.accessorCount(), b.accessorCount());
    const Json json = splitGlb(plain).json;
    for (const Json& mesh : json["meshes"])
        for (const auto& [semantic, accessor] : mesh["primitives"][0]["attributes"].items())
            EXPECT_EQ(a.readRaw(accessor), b.readRaw(accessor)) << semantic;

    const Scene read = b.flatten().scene, truth = a.flatten().scene;
    EXPECT_EQ(read.warnings, truth.warnings);
    ASSERT_EQ(read.meshes.size(), truth.meshes.size());
    for (std::size_t m = 0; m < truth.meshes.size(); ++m) {
        const Mesh& mesh = truth.meshes[m];
        ASSERT_EQ(read.meshes[m].indices.size(), mesh.indices.size());
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
            ASSERT_EQ(triangleAt(read.meshes[m].indices, t), triangleAt(mesh.indices, t));
    }
    ASSERT_EQ(read.images.size(), 1u);
    EXPECT_EQ(read.images[0].encoded, truth.images[0].encoded);
}

/// Where a view's bytes are stored, as the JSON says.
std::span<const std::byte> storedBytes(const GlbFile& file, const Json& view) {
    const bool isEncoded = view.contains("extensions");
    const Json& place = isEncoded ? view["extensions"][kMeshopt] : view;
    EXPECT_EQ(place["buffer"], 0);
    return std::span(file.binary).subspan(place["byteOffset"], place["byteLength"]);
}

TEST(MeshoptWriter, ViewsAreDescribedAsTheExtensionDemands) {
    const GlbFile file = splitGlb(encodeWaves(true));
    EXPECT_EQ(file.json["extensionsRequired"], std::vector<std::string>{kMeshopt});
    EXPECT_EQ(file.json["extensionsUsed"], (std::vector<std::string>{"TEST_extension", kMeshopt}));
    ASSERT_EQ(file.json["buffers"].size(), 2u);
    const Json& fallback = file.json["buffers"][1];
    EXPECT_EQ(fallback["extensions"][kMeshopt]["fallback"], true);
    EXPECT_FALSE(fallback.contains("uri"));

    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    std::size_t encodedCount = 0;
    for (const Json& view : file.json["bufferViews"]) {
        const std::span<const std::byte> stored = storedBytes(file, view);
        const auto begin = static_cast<std::size_t>(stored.data() - file.binary.data());
        ranges.emplace_back(begin, begin + stored.size());
        if (!view.contains("extensions")) {
            EXPECT_TRUE(begin % 4 == 0 || !view.contains("target"));
            continue;
        }
        ++encodedCount;
        const Json& object = view["extensions"][kMeshopt];
        const std::size_t length = view["byteLength"], offset = view["byteOffset"];
        EXPECT_EQ(view["buffer"], 1);
        EXPECT_EQ(offset % 4, 0u);
        EXPECT_LE(offset + length, fallback["byteLength"]);
        EXPECT_LT(stored.size(), length);
        EXPECT_EQ(object["count"].get<std::size_t>() * object["byteStride"].get<std::size_t>(),
                  length);
        EXPECT_EQ(object["mode"], view["target"] == 34963 ? "TRIANGLES" : "ATTRIBUTES");
    }
    // Of each mesh, all but two attributes; the image is as it came.
    EXPECT_EQ(encodedCount, 12u);
    EXPECT_EQ(file.json["bufferViews"].size(), 17u);
    // Every byte of the buffer lies in one stored view.
    std::sort(ranges.begin(), ranges.end());
    EXPECT_EQ(ranges.front().first, 0u);
    for (std::size_t i = 1; i < ranges.size(); ++i)
        EXPECT_EQ(ranges[i].first, ranges[i - 1].second);
    EXPECT_EQ(ranges.back().second, file.json["buffers"][0]["byteLength"]);
}

TEST(MeshoptWriter, ChecksumsAreOfStoredBytesForViewsAndOfValuesForAttributes) {
    const std::vector<std::byte> bytes = encodeWaves(true);
    const GlbFile file = splitGlb(bytes);
    const GltfDocument document(bytes, "");
    const Json& checksums = file.json["extensions"]["TEST_extension"]["checksums"];
    const Json& views = file.json["bufferViews"];
    ASSERT_EQ(checksums.size(), views.size());
    for (std::size_t view = 0; view < views.size(); ++view)
        EXPECT_EQ(checksums[view], formatChecksum(computeCrc32(storedBytes(file, views[view]))));
    for (const Json& mesh : file.json["meshes"]) {
        const Json& primitive = mesh["primitives"][0];
        const Json& bound = primitive["extensions"]["TEST_extension"]["checksums"];
        EXPECT_EQ(bound.size(), 7u);
        for (const auto& [semantic, accessor] : primitive["attributes"].items())
            EXPECT_EQ(bound[semantic], formatChecksum(computeCrc32(document.readRaw(accessor))));
    }
}

TEST(MeshoptWriter, AFileThatGainsNothingIsTheSameAsWithout) {
    Scene scene;
    EXPECT_EQ(encodeGlb(scene, nullptr, {.meshopt = true}), encodeGlb(scene));
    scene.materials.resize(1);
    scene.meshes.resize(1);
    scene.meshes[0].positions = {{0.1f, 0.7f, 0.3f}, {1.3f, 0.2f, 0.9f}, {0.6f, 1.7f, 0.4f}};
    scene.meshes[0].normals.assign(3, Vec3f(0.0f, 0.0f, 1.0f));
    scene.meshes[0].indices = {0, 1, 2};
    EXPECT_EQ(encodeGlb(scene, nullptr, {.meshopt = true}), encodeGlb(scene));
}

/// Everything that belongs to a vertex.
auto describeVertex(const Mesh& mesh, std::size_t v, std::uint32_t number) {
    const Vec3f &p = mesh.positions[v], &n = mesh.normals[v];
    const Vec2f uv = mesh.uvSets[0].empty() ? Vec2f(0.0f) : mesh.uvSets[0][v];
    const Vec4f color = mesh.colors.empty() ? Vec4f(0.0f) : mesh.colors[v];
    return std::array<float, 10>{p.x,  p.y,  p.z,     n.x,     n.y,
                                 uv.x, uv.y, color.x, color.y, static_cast<float>(number)};
}

/// The corners of all triangles, and all vertices, each sorted: what an order cannot change.
auto describeMesh(const Mesh& mesh, std::span<const std::uint32_t> numbers) {
    std::vector<std::array<float, 10>> vertices;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
        vertices.push_back(describeVertex(mesh, v, numbers[v]));
    std::vector<std::array<std::array<float, 10>, 3>> triangles;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        auto& triangle = triangles.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            triangle[c] = vertices[mesh.indices[t + c]];
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
    }
    std::sort(triangles.begin(), triangles.end());
    std::sort(vertices.begin(), vertices.end());
    return std::pair(vertices, triangles);
}

/// The wavy scene with its vertices and triangles shuffled, and vertices that no triangle uses.
Scene makeShuffledScene() {
    Scene scene = makeWavyScene();
    RandomStream random(8, 1);
    for (Mesh& mesh : scene.meshes) {
        for (std::size_t t = mesh.triangleCount(); t-- > 1;) {
            const std::size_t other = random.nextBits() % (t + 1);
            for (std::size_t c = 0; c < 3; ++c)
                std::swap(mesh.indices[3 * t + c], mesh.indices[3 * other + c]);
        }
        mesh.indices.resize(mesh.indices.size() - 150);
    }
    scene.meshes[1].uvSets[0].clear();
    scene.meshes[1].colors.clear();
    scene.meshes.insert(scene.meshes.begin() + 1, Mesh());
    return scene;
}

TEST(VertexOrder, MeshesStayTheSameAndNumbersGoWithTheirVertices) {
    Scene scene = makeShuffledScene();
    const Scene before = scene;
    std::vector<std::uint32_t> numbers(scene.vertexCount());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = static_cast<std::uint32_t>(7 * i);
    const std::vector<std::uint32_t> numbersBefore = numbers;
    orderForEncoding(scene, numbers);
    EXPECT_NE(scene.meshes[0].indices, before.meshes[0].indices);
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    ASSERT_EQ(offsets, vertexOffsets(before));
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const std::size_t count = offsets[m + 1] - offsets[m];
        EXPECT_EQ(
            describeMesh(scene.meshes[m], std::span(numbers).subspan(offsets[m], count)),
            describeMesh(before.meshes[m], std::span(numbersBefore).subspan(offsets[m], count)));
    }
}

TEST(VertexOrder, VerticesComeAsTrianglesUseThemAndTheOthersLast) {
    Scene scene = makeShuffledScene();
    std::vector<std::uint32_t> numbers(scene.vertexCount());
    orderForEncoding(scene, numbers);
    for (const Mesh& mesh : scene.meshes) {
        std::uint32_t next = 0;
        for (const std::uint32_t index : mesh.indices) {
            ASSERT_LE(index, next);
            if (index == next) ++next;
        }
        EXPECT_LE(next, mesh.vertexCount());
    }
}

TEST(VertexOrder, IndicesTakeHalfTheBytesOrLess) {
    Scene scene = makeShuffledScene();
    const auto countIndexBytes = [&] {
        std::size_t bytes = 0;
        const GlbFile file = splitGlb(encodeGlb(scene, nullptr, {.meshopt = true}));
        for (const Json& view : file.json["bufferViews"])
            if (view.contains("target") && view["target"] == 34963)
                bytes += storedBytes(file, view).size();
        return bytes;
    };
    const std::size_t before = countIndexBytes();
    std::vector<std::uint32_t> numbers(scene.vertexCount());
    orderForEncoding(scene, numbers);
    EXPECT_LT(2 * countIndexBytes(), before);
}

}  // namespace
}  // namespace prt

#include "prt/gltf/gltf_document.h"

#include <gtest/gtest.h>

#include "tests/gltf/gltf_builder.h"

namespace prt::test {
namespace {

/// A file with an extension on its root and on its one primitive, which has an attribute "_PRT_0".
GltfBuilder makeExtendedFile() {
    GltfBuilder builder;
    const auto positions = builder.addVectors(kTriangle);
    const auto custom = builder.addArray(std::vector<float>{1, 2, 3, 4, 5, 6}, "VEC2", 3);
    builder.json["extensionsUsed"] = {"OPENPRT_radiance_transfer"};
    builder.json["extensions"] = {{"OPENPRT_radiance_transfer", {{"bands", 5}}}};
    builder.addMeshNode({{"attributes", {{"POSITION", positions}, {"_PRT_0", custom}}},
                         {"extensions", {{"OPENPRT_radiance_transfer", {{"clusters", {1, 2}}}}}}});
    return builder;
}

TEST(GltfDocument, ExtensionsComeAsTheirJson) {
    const ScratchFolder folder;
    const GltfDocument document(folder.write("scene.glb", makeExtendedFile().glb()));
    EXPECT_EQ(document.rootExtension("OPENPRT_radiance_transfer"), R"({"bands":5})");
    EXPECT_EQ(document.primitiveExtension({0, 0}, "OPENPRT_radiance_transfer"),
              R"({"clusters":[1,2]})");
    EXPECT_EQ(document.rootExtension("KHR_lights_punctual"), std::nullopt);
    EXPECT_EQ(document.primitiveExtension({0, 0}, "KHR_lights_punctual"), std::nullopt);
    EXPECT_TRUE(document.flatten().scene.warnings.empty());
}

TEST(GltfDocument, CustomAttributesAreFoundByTheirName) {
    const ScratchFolder folder;
    const GltfDocument document(folder.write("scene.glb", makeExtendedFile().glb()));
    const auto accessor = document.attributeAccessor({0, 0}, "_PRT_0");
    ASSERT_TRUE(accessor);
    const AccessorInfo info = document.describeAccessor(*accessor);
    EXPECT_EQ(info.count, 3u);
    EXPECT_EQ(info.componentCount, 2);
    EXPECT_EQ(info.type, ComponentType::float32);
    EXPECT_FALSE(info.normalized);
    EXPECT_EQ(document.readFloats(*accessor), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(document.attributeAccessor({0, 0}, "_PRT_1"), std::nullopt);
}

TEST(GltfDocument, BufferViewsGiveTheirBytes) {
    const ScratchFolder folder;
    const GltfDocument document(folder.write("scene.glb", makeExtendedFile().glb()));
    ASSERT_EQ(document.bufferViewCount(), 2u);
    EXPECT_EQ(document.accessorCount(), 2u);
    EXPECT_EQ(document.bufferViewBytes(0).size(), 36u);
    EXPECT_EQ(document.bufferViewBytes(1).size(), 24u);
}

TEST(GltfDocument, EachMeshOfTheSceneKnowsItsPrimitive) {
    // Two primitives, of which the first is points, shown by two nodes.
    GltfBuilder builder;
    const auto positions = builder.addVectors(kTriangle);
    const Json points = {{"attributes", {{"POSITION", positions}}}, {"mode", 0}};
    const Json triangle = {{"attributes", {{"POSITION", positions}}}};
    builder.add("meshes", {{"primitives", {triangle}}});
    builder.add("meshes", {{"primitives", {points, triangle}}});
    for (const int mesh : {1, 0, 1})
        builder.add("nodes", {{"mesh", mesh}});
    const ScratchFolder folder;
    const FlattenedGltf flattened =
        GltfDocument(folder.write("scene.glb", builder.glb())).flatten();
    ASSERT_EQ(flattened.primitiveOfMesh.size(), 3u);
    ASSERT_EQ(flattened.scene.meshes.size(), 3u);
    const std::vector<std::size_t> meshes = {1, 0, 1};
    const std::vector<std::size_t> primitives = {1, 0, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(flattened.primitiveOfMesh[i].mesh, meshes[i]);
        EXPECT_EQ(flattened.primitiveOfMesh[i].primitive, primitives[i]);
    }
}

}  // namespace
}  // namespace prt::test

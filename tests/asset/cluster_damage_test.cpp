#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "prt/asset/asset.h"
#include "tests/asset/asset_damage.h"

namespace prt {
namespace {

using test::ClusterForm;
using test::expectEachIsRefused;
using test::GlbFile;
using test::headerOf;
using test::layerOf;
using test::makeProvenance;
using test::makeTwoGrids;
using test::Mutant;
using test::primitiveOf;
using test::refusalOf;
using Json = nlohmann::json;

// The clusters of these assets: the second has no components, so rows are of four numbers.
const std::vector<std::uint32_t> kComponentCounts = {2, 0, 3};

std::vector<std::byte> makeAssetBytes(TransferEncoding weights = TransferEncoding::unorm8,
                                      TransferEncoding vectors = TransferEncoding::unorm16) {
    const Scene scene = makeTwoGrids();
    return encodeAsset(
        scene,
        test::makeClusteredTransfer(scene, 2, {weights, vectors, kComponentCounts},
                                    {Transport::shadowed, Transport::interreflected}),
        makeProvenance());
}

Json& clustersOf(GlbFile& file) {
    return layerOf(file, 0)["clusters"];
}

Mutant withMember(const char* name, const char* key, Json value, const char* complaint) {
    return {name, [key, value](GlbFile& file) { clustersOf(file)[key] = value; }, complaint};
}

TEST(ClusterDamage, HeadersThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    expectEachIsRefused(
        {withMember("no clusters", "components", Json::array(), "1 to 256 clusters"),
         withMember("257 clusters", "components", std::vector<int>(257, 0), "1 to 256 clusters"),
         withMember("a cluster less", "components", {2, 3}, "form"),
         withMember("a cluster more", "components", {2, 0, 3, 0}, "form"),
         withMember("a component more", "components", {2, 1, 3}, "form"),
         withMember("components of another cluster", "components", {0, 2, 3}, "component"),
         withMember("components beyond the attributes", "components", {2, 0, 4}, "attributes"),
         withMember("256 components", "components", {2, 0, 256}, "255"),
         withMember("absurdly many", "components", {2, 0, 4000000000u}, "255"),
         withMember("a negative count", "components", {2, -1, 3}, "whole number"),
         withMember("half a component", "components", {2, 0.5, 3}, "whole number"),
         withMember("a text", "components", "203", "array"),
         withMember("another encoding", "encoding", "unorm8", "form"),
         withMember("an unknown encoding", "encoding", "unorm4", "encoding"),
         withMember("other weights", "weights", "unorm16", "form"),
         withMember("clusters of clusters", "weights", "clusters", "weights"),
         withMember("short scale", "scale", {0.1, 0.1, 0.1}, "scale"),
         withMember("negative scale", "scale", {0.1, 0.1, -0.1, 0.1}, "negative"),
         withMember("no number", "scale", {0.1, 0.1, nullptr, 0.1}, "number"),
         withMember("huge scale", "scale", {0.1, 100.5, 0.1, 0.1}, "100"),
         withMember("huge bias", "bias", {0.1, -1e30, 0.1, 0.1}, "100"),
         withMember("no accessor", "accessor", nullptr, "accessor"),
         withMember("an accessor that is not there", "accessor", 99, "accessor 99"),
         withMember("an accessor beyond all", "accessor", 9007199254740991u, "accessor"),
         withMember("an accessor of another type", "accessor", 2, "form"),
         withMember("an accessor of another length", "accessor", 1, "form")},
        makeAssetBytes());
}

TEST(ClusterDamage, ErrorsThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    std::vector<Mutant> mutants;
    for (const Json& error : {Json(0), Json(-0.01), Json(101), Json("0.01"), Json()})
        mutants.push_back({"largestError",
                           [error](GlbFile& file) { layerOf(file, 0)["largestError"] = error; },
                           "largestError"});
    expectEachIsRefused(mutants, makeAssetBytes());
}

TEST(ClusterDamage, EachMemberIsNeeded) {
    std::vector<Mutant> mutants = {
        {"clusters", [](GlbFile& file) { layerOf(file, 0).erase("clusters"); }, "clusters"}};
    for (const char* key :
         {"weights", "components", "encoding", "scale", "bias", "accessor", "checksum"})
        mutants.push_back({key, [key](GlbFile& file) { clustersOf(file).erase(key); }, key});
    // The checksum comes back where it is repaired.
    mutants.back().change = [](GlbFile& file) {
        clustersOf(file).erase("checksum");
        clustersOf(file).erase("accessor");
    };
    mutants.back().complaint = "lacks";
    expectEachIsRefused(mutants, makeAssetBytes());
}

TEST(ClusterDamage, AFileOfTheFirstVersionHasNoClusters) {
    expectEachIsRefused({{"1.0", [](GlbFile& f) { headerOf(f)["version"] = "1.0"; }, "1.0"}},
                        makeAssetBytes());
}

// Both layers have accessors of one form, but each is bound to its own.
TEST(ClusterDamage, VectorsOfAnotherLayerAreRefused) {
    const Scene scene = makeTwoGrids();
    GlbFile file = test::splitGlb(
        encodeAsset(scene,
                    test::makeClusteredTransfer(scene, 2, {.componentCounts = {1, 1}},
                                                {Transport::unshadowed, Transport::shadowed}),
                    makeProvenance()));
    ASSERT_FALSE(refusalOf(test::joinGlb(file)));
    std::swap(clustersOf(file)["accessor"], layerOf(file, 1)["clusters"]["accessor"]);
    const std::optional<Error> refusal = refusalOf(test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_NE(std::string(refusal->what()).find("checksum"), std::string::npos);
}

/// Sets one number of the first vertex whose cluster is the given one.
template <class Stored>
Mutant withNumber(const char* name, std::uint32_t cluster, std::size_t column, Stored number,
                  const char* complaint) {
    const auto change = [=](GlbFile& file) {
        const std::span<std::byte> view =
            file.view(primitiveOf(file, 0)["attributes"]["_PRT_0"].get<std::size_t>());
        for (std::size_t begin = 0; begin < view.size(); begin += 4 * sizeof(Stored)) {
            Stored stored;
            std::memcpy(&stored, &view[begin], sizeof(Stored));
            if (stored != static_cast<Stored>(cluster)) continue;
            std::memcpy(&view[begin + column * sizeof(Stored)], &number, sizeof(Stored));
            return;
        }
        ADD_FAILURE() << "no vertex is in the cluster";
    };
    return {name, change, complaint};
}

TEST(ClusterDamage, FloatsThatAreNoClusterOrNoWeightAreRefused) {
    const char* const cluster = "cluster that is not there";
    const char* const weight = "weight beyond 0 and 1";
    const char* const behind = "component that its cluster does not have";
    expectEachIsRefused(
        {withNumber("the fourth of three", 0, 0, 3.0f, cluster),
         withNumber("a fraction", 0, 0, 0.5f, cluster),
         withNumber("negative", 0, 0, -1.0f, cluster),
         withNumber("NaN", 0, 0, std::nanf(""), cluster),
         withNumber("infinite", 0, 0, INFINITY, cluster), withNumber("huge", 0, 0, 1e30f, cluster),
         withNumber("a weight above 1", 0, 1, 1.0001f, weight),
         withNumber("a negative weight", 0, 2, -0.0001f, weight),
         withNumber("a weight that is NaN", 0, 2, std::nanf(""), weight),
         withNumber("a weight too many", 0, 3, 0.5f, behind),
         withNumber("a weight where there is none", 1, 1, 1.0f, behind),
         withNumber("NaN behind the weights", 1, 3, std::nanf(""), weight)},
        makeAssetBytes(TransferEncoding::float32));
}

TEST(ClusterDamage, IntegersThatAreNoClusterOrNoWeightAreRefused) {
    const char* const cluster = "cluster that is not there";
    const char* const behind = "component that its cluster does not have";
    expectEachIsRefused(
        {withNumber<std::uint16_t>("the fourth of three", 0, 0, 3, cluster),
         withNumber<std::uint16_t>("the last that a word has", 0, 0, 65535, cluster),
         withNumber<std::uint16_t>("a weight too many", 0, 3, 1, behind)},
        makeAssetBytes(TransferEncoding::unorm16));
    expectEachIsRefused({withNumber<std::uint8_t>("the fourth of three", 0, 0, 3, cluster),
                         withNumber<std::uint8_t>("a weight too many", 1, 1, 255, behind)},
                        makeAssetBytes(TransferEncoding::unorm8));
}

TEST(ClusterDamage, VectorsThatCannotBeTransferAreRefused) {
    const auto setFloat = [](float value, std::size_t element) {
        return [value, element](GlbFile& file) {
            std::memcpy(&test::vectorsOf(file, clustersOf(file))[element * sizeof(float)], &value,
                        sizeof(value));
        };
    };
    expectEachIsRefused({{"NaN", setFloat(std::nanf(""), 5), "100"},
                         {"infinity", setFloat(-INFINITY, 0), "100"},
                         {"too large", setFloat(100.5f, 31), "100"}},
                        makeAssetBytes(TransferEncoding::unorm8, TransferEncoding::float32));
}

// Two components are three numbers, and the fourth is padding.
TEST(ClusterDamage, PaddingThatIsNotZeroIsRefused) {
    const Scene scene = makeTwoGrids();
    const std::vector<std::byte> bytes = encodeAsset(
        scene,
        test::makeClusteredTransfer(scene, 2, {.componentCounts = {2}}, {Transport::shadowed}),
        makeProvenance());
    expectEachIsRefused({withNumber<std::uint8_t>("padding", 0, 3, 1, "beyond the last")}, bytes);
}

TEST(ClusterVersions, ANewerMinorVersionMayStoreItsClustersInWaysThatArePassedOver) {
    for (const char* key : {"weights", "encoding"}) {
        GlbFile file = test::splitGlb(makeAssetBytes());
        headerOf(file)["version"] = "1.7";
        clustersOf(file)[key] = "unorm4";
        test::repairChecksums(file);
        Asset asset;
        ASSERT_FALSE(refusalOf(test::joinGlb(file), &asset)) << key;
        ASSERT_EQ(asset.transfer.layers.size(), 1u) << key;
        EXPECT_EQ(asset.transfer.layers[0].transport, Transport::interreflected);
    }
}

}  // namespace
}  // namespace prt

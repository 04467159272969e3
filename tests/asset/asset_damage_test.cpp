#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "tests/asset/asset_builder.h"
#include "tests/gltf/gltf_builder.h"

namespace prt {
namespace {

using test::GlbFile;
using test::headerOf;
using test::makeProvenance;
using test::makeTransfer;
using test::makeTwoGrids;
using test::repairChecksums;
using test::ScratchFolder;
using Json = nlohmann::json;

std::vector<std::byte> makeAssetBytes(TransferEncoding encoding = TransferEncoding::unorm8) {
    const Scene scene = makeTwoGrids();
    return encodeAsset(
        scene, makeTransfer(scene, 2, encoding, {Transport::shadowed, Transport::interreflected}),
        makeProvenance());
}

/// Why the file is refused; nothing if it is read, into `asset` where given.
std::optional<Error> refusalOf(const ScratchFolder& folder, std::span<const std::byte> bytes,
                               Asset* asset = nullptr) {
    // Replacing a file makes some file systems wait for the disk; a new one does not.
    std::filesystem::remove(folder.path() / "damaged.prt.glb");
    const std::filesystem::path path = folder.write("damaged.prt.glb", bytes);
    try {
        Asset read = readAsset(path);
        if (asset) *asset = std::move(read);
        return std::nullopt;
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), path.string());
        return error;
    }
}

bool isSameTransfer(const CompressedTransfer& a, const CompressedTransfer& b) {
    if (a.bandCount != b.bandCount || a.receiverCount != b.receiverCount ||
        a.layers.size() != b.layers.size())
        return false;
    for (std::size_t i = 0; i < a.layers.size(); ++i)
        if (a.layers[i].transport != b.layers[i].transport ||
            a.layers[i].channelCount != b.layers[i].channelCount ||
            a.layers[i].encoding != b.layers[i].encoding ||
            a.layers[i].scale != b.layers[i].scale || a.layers[i].bias != b.layers[i].bias ||
            !(a.layers[i].data == b.layers[i].data))
            return false;
    return true;
}

bool isSameGeometry(const Scene& a, const Scene& b) {
    if (a.meshes.size() != b.meshes.size()) return false;
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        if (a.meshes[i].positions != b.meshes[i].positions ||
            a.meshes[i].normals != b.meshes[i].normals)
            return false;
    return true;
}

TEST(AssetDamage, EveryPrefixIsRefused) {
    const ScratchFolder folder;
    const std::vector<std::byte> bytes = makeAssetBytes();
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_TRUE(refusalOf(folder, std::span(bytes).first(size))) << size << " bytes";
}

TEST(AssetDamage, BytesAfterTheEndAreRefused) {
    const ScratchFolder folder;
    std::vector<std::byte> bytes = makeAssetBytes();
    for (int i = 0; i < 16; ++i) {
        bytes.push_back(std::byte{0});
        EXPECT_TRUE(refusalOf(folder, bytes));
    }
}

TEST(AssetDamage, EveryChangedByteOfTheBinaryChunkIsRefused) {
    const ScratchFolder folder;
    std::vector<std::byte> bytes = makeAssetBytes();
    for (std::size_t i = test::findBinaryChunk(bytes); i < bytes.size(); ++i)
        for (const std::byte change : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
            bytes[i] ^= change;
            ASSERT_TRUE(refusalOf(folder, bytes)) << "byte " << i;
            bytes[i] ^= change;
        }
    EXPECT_FALSE(refusalOf(folder, bytes));
}

// Names, materials and white space have no checksum; what the light is computed from has.
TEST(AssetDamage, AChangedByteOfTheJsonIsRefusedOrLeavesTransferAndGeometryAsTheyWere) {
    const ScratchFolder folder;
    std::vector<std::byte> bytes = makeAssetBytes();
    Asset original;
    ASSERT_FALSE(refusalOf(folder, bytes, &original));
    for (std::size_t i = 0; i < test::findBinaryChunk(bytes); ++i)
        for (const std::byte change : {std::byte{0x01}, std::byte{0x02}}) {
            bytes[i] ^= change;
            Asset asset;
            if (!refusalOf(folder, bytes, &asset)) {
                ASSERT_TRUE(isSameTransfer(asset.transfer, original.transfer)) << "byte " << i;
                ASSERT_TRUE(isSameGeometry(asset.scene, original.scene)) << "byte " << i;
            }
            bytes[i] ^= change;
        }
}

/// A change to a sound file, after which the checksums are made to fit again.
struct Mutant {
    const char* name;
    std::function<void(GlbFile&)> change;
    const char* complaint;  ///< a part of it
};

Json& primitiveOf(GlbFile& file, std::size_t mesh) {
    return file.json["meshes"][mesh]["primitives"][0];
}

Json& layerOf(GlbFile& file, std::size_t layer) {
    return headerOf(file)["layers"][layer];
}

void expectEachIsRefused(const std::vector<Mutant>& mutants, TransferEncoding encoding) {
    const ScratchFolder folder;
    const std::vector<std::byte> bytes = makeAssetBytes(encoding);
    for (const Mutant& mutant : mutants) {
        SCOPED_TRACE(mutant.name);
        GlbFile file = test::splitGlb(bytes);
        mutant.change(file);
        repairChecksums(file);
        const std::optional<Error> refusal = refusalOf(folder, test::joinGlb(file));
        ASSERT_TRUE(refusal);
        EXPECT_NE(std::string(refusal->what()).find(mutant.complaint), std::string::npos)
            << refusal->what();
    }
}

TEST(AssetDamage, HeadersThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    expectEachIsRefused(
        {{"no bands", [](GlbFile& f) { headerOf(f)["bands"] = 0; }, "bands"},
         {"too many bands", [](GlbFile& f) { headerOf(f)["bands"] = 11; }, "bands"},
         {"other bands", [](GlbFile& f) { headerOf(f)["bands"] = 3; }, "numbers"},
         {"bands beyond int", [](GlbFile& f) { headerOf(f)["bands"] = 4294967298u; }, "bands"},
         {"negative bands", [](GlbFile& f) { headerOf(f)["bands"] = -2; }, "bands"},
         {"fractional bands", [](GlbFile& f) { headerOf(f)["bands"] = 2.5; }, "bands"},
         {"other convention", [](GlbFile& f) { headerOf(f)["convention"] = "rh"; }, "\"rh\""},
         {"other quantity", [](GlbFile& f) { headerOf(f)["quantity"] = "glossy"; }, "glossy"},
         {"no provenance", [](GlbFile& f) { headerOf(f).erase("provenance"); }, "provenance"},
         {"seed of 65 bits",
          [](GlbFile& f) { headerOf(f)["provenance"]["seed"] = "18446744073709551616"; }, "seed"},
         {"seed as a number", [](GlbFile& f) { headerOf(f)["provenance"]["seed"] = 1; }, "seed"},
         {"no layers", [](GlbFile& f) { headerOf(f)["layers"] = Json::array(); }, "layer"},
         {"no version", [](GlbFile& f) { headerOf(f).erase("version"); }, "version"},
         {"vertices of another mesh", [](GlbFile& f) { headerOf(f)["vertices"] = 9; },
          "13 vertices"},
         {"a mesh less", [](GlbFile& f) { f.json["nodes"][1].erase("mesh"); }, "9 vertices"},
         {"a checksum less", [](GlbFile& f) { headerOf(f)["checksums"].erase(0); }, "checksums"},
         {"a checksum more",
          [](GlbFile& f) { f.json["bufferViews"].push_back(f.json["bufferViews"][0]); },
          "checksums"}},
        TransferEncoding::unorm8);
}

TEST(AssetDamage, LayersThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    expectEachIsRefused(
        {{"twice", [](GlbFile& f) { layerOf(f, 0)["transport"] = "interreflected"; }, "different"},
         {"unknown transport", [](GlbFile& f) { layerOf(f, 0)["transport"] = "glossy"; },
          "transport"},
         {"unknown encoding", [](GlbFile& f) { layerOf(f, 0)["encoding"] = "unorm4"; }, "encoding"},
         {"other encoding", [](GlbFile& f) { layerOf(f, 0)["encoding"] = "unorm16"; }, "form"},
         {"two channels", [](GlbFile& f) { layerOf(f, 0)["channels"] = 2; }, "1 or 3"},
         {"no channels", [](GlbFile& f) { layerOf(f, 0)["channels"] = 0; }, "1 or 3"},
         {"more channels", [](GlbFile& f) { layerOf(f, 0)["channels"] = 3; }, "numbers"},
         {"short scale", [](GlbFile& f) { layerOf(f, 0)["scale"].erase(0); }, "scale"},
         {"negative scale", [](GlbFile& f) { layerOf(f, 0)["scale"][1] = -0.1; }, "negative"},
         {"huge scale", [](GlbFile& f) { layerOf(f, 0)["scale"][1] = 1e30; }, "100"},
         {"huge bias", [](GlbFile& f) { layerOf(f, 1)["bias"][2] = -101; }, "100"},
         {"no number", [](GlbFile& f) { layerOf(f, 0)["bias"][0] = nullptr; }, "bias"},
         {"no attributes", [](GlbFile& f) { layerOf(f, 0)["attributes"]["count"] = 0; }, "count"},
         {"attributes past the last", [](GlbFile& f) { layerOf(f, 1)["attributes"]["first"] = 9; },
          "_PRT_"},
         {"shared attributes", [](GlbFile& f) { layerOf(f, 1)["attributes"]["first"] = 0; },
          "one after the other"},
         {"far attributes",
          [](GlbFile& f) { layerOf(f, 0)["attributes"]["first"] = 9007199254740991u; },
          "one after the other"}},
        TransferEncoding::unorm8);
}

TEST(AssetDamage, MeshesThatDoNotFitTheirTransferAreRefusedEvenWithFittingChecksums) {
    expectEachIsRefused(
        {{"attribute missing",
          [](GlbFile& f) {
              primitiveOf(f, 1)["attributes"].erase("_PRT_3");
              primitiveOf(f, 1)["extensions"].begin().value()["checksums"].erase("_PRT_3");
          },
          "_PRT_3"},
         {"unbound attribute",
          [](GlbFile& f) {
              primitiveOf(f, 1)["extensions"].begin().value()["checksums"].erase("_PRT_3");
          },
          "_PRT_3"},
         {"unmarked primitive", [](GlbFile& f) { primitiveOf(f, 0)["extensions"].clear(); },
          "no radiance transfer"},
         {"a vertex less",
          [](GlbFile& f) {
              const std::size_t accessor = primitiveOf(f, 0)["attributes"]["_PRT_0"];
              f.json["accessors"][accessor]["count"] = 8;
          },
          "number"},
         {"not normalised",
          [](GlbFile& f) {
              const std::size_t accessor = primitiveOf(f, 0)["attributes"]["_PRT_0"];
              f.json["accessors"][accessor].erase("normalized");
          },
          "form"},
         {"moved",
          [](GlbFile& f) {
              f.json["nodes"][1]["translation"] = {0.0, 0.5, 0.0};
          },
          "moved"},
         {"placed twice",
          [](GlbFile& f) {
              f.json["nodes"].push_back(f.json["nodes"][0]);
              f.json["scenes"][0]["nodes"].push_back(f.json["nodes"].size() - 1);
          },
          "twice"}},
        TransferEncoding::unorm8);
}

TEST(AssetDamage, FloatsThatAreNoCoefficientsAreRefusedEvenWithFittingChecksums) {
    const auto setFloat = [](float value, std::size_t element) {
        return [value, element](GlbFile& file) {
            const std::size_t attribute = primitiveOf(file, 0)["attributes"]["_PRT_0"];
            std::memcpy(file.view(attribute).data() + element * sizeof(float), &value,
                        sizeof(value));
        };
    };
    expectEachIsRefused({{"NaN", setFloat(std::nanf(""), 5), "100"},
                         {"infinity", setFloat(-INFINITY, 0), "100"},
                         {"too large", setFloat(100.5f, 3), "100"}},
                        TransferEncoding::float32);
}

// Three bands are nine coefficients in three attributes; the last three
// numbers of the third are padding.
TEST(AssetDamage, PaddingThatIsNotZeroIsRefused) {
    const ScratchFolder folder;
    const Scene scene = makeTwoGrids();
    GlbFile file = test::splitGlb(
        encodeAsset(scene, makeTransfer(scene, 3, TransferEncoding::unorm16, {Transport::shadowed}),
                    makeProvenance()));
    const std::size_t attribute = primitiveOf(file, 0)["attributes"]["_PRT_2"];
    file.view(attribute)[7] = std::byte{1};
    repairChecksums(file);
    const std::optional<Error> refusal = refusalOf(folder, test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_NE(std::string(refusal->what()).find("beyond the last"), std::string::npos);
}

TEST(AssetVersions, AnotherMajorVersionIsRefusedInASentenceThatNamesBoth) {
    const ScratchFolder folder;
    GlbFile file = test::splitGlb(makeAssetBytes());
    headerOf(file)["version"] = "2.3";
    const std::optional<Error> refusal = refusalOf(folder, test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->code(), ErrorCode::unsupported);
    EXPECT_NE(std::string(refusal->what()).find("2.3"), std::string::npos);
    EXPECT_NE(std::string(refusal->what()).find("1.0"), std::string::npos);
}

TEST(AssetVersions, TextThatIsNoVersionIsRefused) {
    const ScratchFolder folder;
    for (const char* version :
         {"", "1", "1.", ".0", "1.0.0", "1.x", "v1.0", "-1.0", "1.-1", " 1.0", "1.99999999999"}) {
        GlbFile file = test::splitGlb(makeAssetBytes());
        headerOf(file)["version"] = version;
        const std::optional<Error> refusal = refusalOf(folder, test::joinGlb(file));
        ASSERT_TRUE(refusal) << version;
        EXPECT_EQ(refusal->code(), ErrorCode::malformed) << version;
    }
}

TEST(AssetVersions, ANewerMinorVersionIsReadAndWhatItAddsIsPassedOver) {
    const ScratchFolder folder;
    Asset original;
    ASSERT_FALSE(refusalOf(folder, makeAssetBytes(), &original));

    GlbFile file = test::splitGlb(makeAssetBytes());
    Json& header = headerOf(file);
    header["version"] = "1.7";
    header["novelty"] = {1, 2, 3};
    header["layers"][1]["novelty"] = true;
    Json glossy = header["layers"][1];
    glossy["transport"] = "glossy";
    header["layers"].push_back(glossy);
    repairChecksums(file);
    Asset asset;
    ASSERT_FALSE(refusalOf(folder, test::joinGlb(file), &asset));
    EXPECT_TRUE(isSameTransfer(asset.transfer, original.transfer));

    header["layers"] = {glossy};
    EXPECT_TRUE(refusalOf(folder, test::joinGlb(file)));
}

TEST(AssetVersions, AGltfWithoutTheExtensionIsToldFromADamagedAsset) {
    const ScratchFolder folder;
    const std::optional<Error> refusal = refusalOf(folder, encodeGlb(makeTwoGrids()));
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->code(), ErrorCode::unsupported);
    EXPECT_FALSE(refusal->hint().empty());
    try {
        readAsset(folder.path() / "absent.prt.glb");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::notFound);
    }
}

}  // namespace
}  // namespace prt

#include <gtest/gtest.h>

#include <optional>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "tests/asset/asset_builder.h"
#include "tests/asset/asset_damage.h"
#include "tests/gltf/gltf_builder.h"

namespace prt {
namespace {

using test::expectEachIsRefused;
using test::GlbFile;
using test::headerOf;
using test::isSameGeometry;
using test::isSameTransfer;
using test::layerOf;
using test::makeProvenance;
using test::makeTransfer;
using test::makeTwoGrids;
using test::primitiveOf;
using test::refusalOf;
using test::repairChecksums;
using test::ScratchFolder;
using Json = nlohmann::json;

/// The layers of an asset and how they are stored; with clusters, their vectors and weights.
struct StorageForm {
    TransferEncoding encoding = TransferEncoding::unorm8;
    std::optional<TransferEncoding> vectors{};
    std::vector<Transport> transports = {Transport::shadowed, Transport::interreflected};
};
const std::vector<Transport> kGlossy = {Transport::glossyShadowed, Transport::glossy};

CompressedTransfer makeStored(const Scene& scene, int bandCount, const StorageForm& form) {
    if (!form.vectors) return makeTransfer(scene, bandCount, form.encoding, form.transports);
    return test::makeClusteredTransfer(scene, bandCount, {form.encoding, *form.vectors, {2, 0}},
                                       form.transports);
}

std::vector<std::byte> makeAssetBytes(const StorageForm& form = {}) {
    const Scene scene = makeTwoGrids();
    return encodeAsset(scene, makeStored(scene, 2, form), makeProvenance());
}

/// A triangle and one band: so few bytes that each can be changed in every way.
std::vector<std::byte> makeSmallAssetBytes(StorageForm form) {
    const Scene scene = test::makeTriangle();
    if (form.vectors || form.transports == kGlossy) form.transports.pop_back();
    return encodeAsset(scene, makeStored(scene, 1, form), makeProvenance());
}

class AssetDamageOfEncoding : public testing::TestWithParam<StorageForm> {};

TEST_P(AssetDamageOfEncoding, EveryPrefixIsRefused) {
    const std::vector<std::byte> bytes = makeAssetBytes(GetParam());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        ASSERT_TRUE(refusalOf(std::span(bytes).first(size))) << size << " bytes";
}

TEST_P(AssetDamageOfEncoding, BytesAfterTheEndAreRefused) {
    std::vector<std::byte> bytes = makeAssetBytes(GetParam());
    for (int i = 0; i < 16; ++i) {
        bytes.push_back(std::byte{0});
        EXPECT_TRUE(refusalOf(bytes));
    }
}

/// Sanitizers are slow: a flipped bit at a time with them, all changes of a byte without.
unsigned nextChange(unsigned change) {
#if defined(__SANITIZE_ADDRESS__)
    return 2 * change;
#else
    return change + 1;
#endif
}

TEST_P(AssetDamageOfEncoding, EveryChangeOfAByteOfTheBinaryChunkIsRefused) {
    std::vector<std::byte> bytes = makeSmallAssetBytes(GetParam());
    for (std::size_t i = test::findBinaryChunk(bytes); i < bytes.size(); ++i)
        for (unsigned change = 1; change < 256; change = nextChange(change)) {
            bytes[i] ^= static_cast<std::byte>(change);
            ASSERT_TRUE(refusalOf(bytes)) << "byte " << i << ", change " << change;
            bytes[i] ^= static_cast<std::byte>(change);
        }
    EXPECT_FALSE(refusalOf(bytes));
}

// Names, materials and white space have no checksum; what the light is computed from has.
TEST_P(AssetDamageOfEncoding, AFlippedBitOfTheJsonIsRefusedOrLeavesTransferAndGeometryAsTheyWere) {
    std::vector<std::byte> bytes = makeSmallAssetBytes(GetParam());
    Asset original;
    ASSERT_FALSE(refusalOf(bytes, &original));
    for (std::size_t i = 0; i < test::findBinaryChunk(bytes); ++i)
        for (unsigned bit = 0; bit < 8; ++bit) {
            bytes[i] ^= std::byte{1} << bit;
            Asset asset;
            if (!refusalOf(bytes, &asset)) {
                ASSERT_TRUE(isSameTransfer(asset.transfer, original.transfer)) << "byte " << i;
                ASSERT_TRUE(isSameGeometry(asset.scene, original.scene)) << "byte " << i;
            }
            bytes[i] ^= std::byte{1} << bit;
        }
}

std::string nameOf(const StorageForm& form) {
    std::string name(encodingName(form.encoding));
    if (form.vectors) name += "_clusters_of_" + std::string(encodingName(*form.vectors));
    return form.transports == kGlossy ? name + "_matrices" : name;
}

INSTANTIATE_TEST_SUITE_P(
    All, AssetDamageOfEncoding,
    testing::Values(StorageForm{TransferEncoding::float32}, StorageForm{TransferEncoding::unorm16},
                    StorageForm{TransferEncoding::unorm8},
                    StorageForm{TransferEncoding::float32, TransferEncoding::unorm16},
                    StorageForm{TransferEncoding::unorm16, TransferEncoding::unorm8},
                    StorageForm{TransferEncoding::unorm8, TransferEncoding::float32},
                    StorageForm{TransferEncoding::unorm8, std::nullopt, kGlossy},
                    StorageForm{TransferEncoding::unorm8, TransferEncoding::unorm8, kGlossy}),
    [](const auto& parameter) { return nameOf(parameter.param); });

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
        makeAssetBytes());
}

TEST(AssetDamage, LayersThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    expectEachIsRefused(
        {{"twice", [](GlbFile& f) { layerOf(f, 0)["transport"] = "interreflected"; }, "different"},
         {"unknown transport", [](GlbFile& f) { layerOf(f, 0)["transport"] = "subsurface"; },
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
        makeAssetBytes());
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
        makeAssetBytes());
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
                        makeAssetBytes({TransferEncoding::float32}));
}

TEST(AssetDamage, NormalsThatAreNotFiniteAreRefusedEvenWithFittingChecksums) {
    const auto setNormal = [](float value) {
        return [value](GlbFile& file) {
            const std::size_t attribute = primitiveOf(file, 1)["attributes"]["NORMAL"];
            std::memcpy(file.view(attribute).data() + 4 * sizeof(float), &value, sizeof(value));
        };
    };
    expectEachIsRefused(
        {{"NaN", setNormal(std::nanf("")), "normal"}, {"infinity", setNormal(INFINITY), "normal"}},
        makeAssetBytes());
}

// Three bands are nine coefficients in three attributes; the last three
// numbers of the third are padding.
TEST(AssetDamage, PaddingThatIsNotZeroIsRefused) {
    const Scene scene = makeTwoGrids();
    GlbFile file = test::splitGlb(
        encodeAsset(scene, makeTransfer(scene, 3, TransferEncoding::unorm16, {Transport::shadowed}),
                    makeProvenance()));
    const std::size_t attribute = primitiveOf(file, 0)["attributes"]["_PRT_2"];
    file.view(attribute)[7] = std::byte{1};
    repairChecksums(file);
    const std::optional<Error> refusal = refusalOf(test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_NE(std::string(refusal->what()).find("beyond the last"), std::string::npos);
}

TEST(AssetVersions, AnotherMajorVersionIsRefusedInASentenceThatNamesBoth) {
    GlbFile file = test::splitGlb(makeAssetBytes());
    headerOf(file)["version"] = "2.3";
    const std::optional<Error> refusal = refusalOf(test::joinGlb(file));
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->code(), ErrorCode::unsupported);
    EXPECT_NE(std::string(refusal->what()).find("2.3"), std::string::npos);
    EXPECT_NE(std::string(refusal->what()).find("1.2"), std::string::npos);
}

TEST(AssetVersions, TextThatIsNoVersionIsRefused) {
    for (const char* version :
         {"", "1", "1.", ".0", "1.0.0", "1.x", "v1.0", "-1.0", "1.-1", " 1.0", "1.99999999999"}) {
        GlbFile file = test::splitGlb(makeAssetBytes());
        headerOf(file)["version"] = version;
        const std::optional<Error> refusal = refusalOf(test::joinGlb(file));
        ASSERT_TRUE(refusal) << version;
        EXPECT_EQ(refusal->code(), ErrorCode::malformed) << version;
    }
}

TEST(AssetVersions, ANewerMinorVersionIsReadAndWhatItAddsIsPassedOver) {
    Asset original;
    ASSERT_FALSE(refusalOf(makeAssetBytes(), &original));

    GlbFile file = test::splitGlb(makeAssetBytes());
    Json& header = headerOf(file);
    header["version"] = "1.7";
    header["novelty"] = {1, 2, 3};
    header["layers"][1]["novelty"] = true;
    Json unknown = header["layers"][1];
    unknown["transport"] = "subsurface";
    header["layers"].push_back(unknown);
    repairChecksums(file);
    Asset asset;
    ASSERT_FALSE(refusalOf(test::joinGlb(file), &asset));
    EXPECT_TRUE(isSameTransfer(asset.transfer, original.transfer));

    header["layers"] = {unknown};
    EXPECT_TRUE(refusalOf(test::joinGlb(file)));
}

TEST(AssetVersions, AGltfWithoutTheExtensionIsToldFromADamagedAsset) {
    const ScratchFolder folder;
    const std::optional<Error> refusal = refusalOf(encodeGlb(makeTwoGrids()));
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

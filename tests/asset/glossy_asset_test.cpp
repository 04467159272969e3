#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "prt/asset/asset.h"
#include "tests/asset/asset_damage.h"
#include "tests/support/transfer_matrix_checks.h"

namespace prt {
namespace {

using test::expectEachIsRefused;
using test::GlbFile;
using test::headerOf;
using test::layerOf;
using test::makeProvenance;
using test::makeTransfer;
using test::makeTwoGrids;
using test::Mutant;

std::vector<std::byte> makeAssetBytes() {
    const Scene scene = makeTwoGrids();
    return encodeAsset(scene,
                       makeTransfer(scene, 2, TransferEncoding::unorm8,
                                    {Transport::glossyShadowed, Transport::glossy}),
                       makeProvenance());
}

/// An asset of a triangle whose matrices all hold 1/4.
CompressedTransfer makeMatrices(Transport transport, int channelCount, int incidentBandCount,
                                int bandCount) {
    CompressedLayer layer{.transport = transport,
                          .channelCount = channelCount,
                          .incidentBandCount = incidentBandCount};
    const std::size_t count = coefficientsPerReceiver(bandCount, layer);
    layer.table.numbers = makeTable(count, std::vector<float>(3 * count, 0.25f));
    return {bandCount, 3, {0, 1, 2}, {layer}};
}

TEST(GlossyAsset, HundredsOfAttributesComeBack) {
    struct Form {
        int incidentBandCount, bandCount;
        std::size_t attributeCount;
    };
    for (const Form& form : {Form{5, 5, 469}, {5, 6, 675}, {10, 1, 75}, {1, 10, 75}}) {
        const CompressedTransfer transfer =
            makeMatrices(Transport::glossy, 3, form.incidentBandCount, form.bandCount);
        for (const bool meshopt : {false, true}) {
            const std::vector<std::byte> bytes =
                encodeAsset(test::makeTriangle(), transfer, makeProvenance(), {.meshopt = meshopt});
            GlbFile file = test::splitGlb(bytes);
            EXPECT_EQ(layerOf(file, 0)["attributes"]["count"], form.attributeCount);
            EXPECT_TRUE(test::isSameTransfer(decodeAsset(bytes, "asset").transfer, transfer));
        }
    }
}

TEST(GlossyAsset, BandsThatMakeNoSenseAreRefusedEvenWithFittingChecksums) {
    std::vector<Mutant> mutants = {
        {"missing", [](GlbFile& f) { layerOf(f, 0).erase("incidentBands"); }, "incidentBands"},
        {"of no number", [](GlbFile& f) { layerOf(f, 0)["incidentBands"] = "3"; }, "number"}};
    for (const nlohmann::json& count :
         {nlohmann::json(0), nlohmann::json(10), nlohmann::json(11), nlohmann::json(-3),
          nlohmann::json(2.5), nlohmann::json(4294967299u)})
        mutants.push_back({"of a count that no bake has",
                           [count](GlbFile& f) { layerOf(f, 0)["incidentBands"] = count; },
                           "incidentBands"});
    mutants.push_back(
        {"more of light", [](GlbFile& f) { headerOf(f)["bands"] = 9; }, "incidentBands"});
    mutants.push_back(
        {"of another layer", [](GlbFile& f) { layerOf(f, 0)["incidentBands"] = 2; }, "numbers"});
    mutants.push_back(
        {"of vectors", [](GlbFile& f) { layerOf(f, 0)["transport"] = "shadowed"; }, "numbers"});
    expectEachIsRefused(mutants, makeAssetBytes());
}

TEST(GlossyAsset, AVectorLayerIsNoneOfMatrices) {
    const Scene scene = makeTwoGrids();
    expectEachIsRefused(
        {{"without bands", [](GlbFile& f) { layerOf(f, 0)["transport"] = "glossy"; },
          "incidentBands"},
         {"with bands",
          [](GlbFile& f) {
              layerOf(f, 0)["transport"] = "glossy";
              layerOf(f, 0)["incidentBands"] = 2;
          },
          "numbers"}},
        encodeAsset(scene, makeTransfer(scene, 2, TransferEncoding::unorm8, {Transport::shadowed}),
                    makeProvenance()));
}

TEST(GlossyAsset, AFileOfAnEarlierVersionHasNoMatrices) {
    for (const char* version : {"1.0", "1.1"})
        expectEachIsRefused(
            {{version, [&](GlbFile& f) { headerOf(f)["version"] = version; }, version}},
            makeAssetBytes());
}

// An old file must be readable for ever: what its layers' checksums cover stays as it was.
TEST(GlossyAsset, ChecksumsCoverTheBandsOfMatricesAlone) {
    const auto checksumOf = [](Transport transport, int incidentBandCount, int bandCount) {
        GlbFile file = test::splitGlb(encodeAsset(
            test::makeTriangle(), makeMatrices(transport, 1, incidentBandCount, bandCount),
            makeProvenance()));
        return layerOf(file, 0)["checksum"].get<std::string>();
    };
    const auto crcOf = [](const std::string& text) {
        return test::checksumOf(std::as_bytes(std::span(text)));
    };
    EXPECT_EQ(checksumOf(Transport::shadowed, 0, 2), crcOf("shadowed float32 1 2 0 1"));
    EXPECT_EQ(checksumOf(Transport::glossy, 2, 3), crcOf("glossy float32 1 3 0 9 2"));
    // The example of docs/format.md.
    EXPECT_EQ(checksumOf(Transport::glossyShadowed, 2, 2), "38112dd5");
}

// The example of docs/format.md: the open surface whose normal is (2, 3, ±6)/7.
TEST(GlossyAsset, TheMatricesOfTheFormatsExampleAreThoseOfItsFormulas) {
    constexpr double kPrinted = 5.1e-7;  // rounding to six digits, and of the normal to floats
    struct Example {
        double normalZ;
        std::array<double, 16> matrix;
    };
    for (const Example& example :
         {Example{6.0,
                  {0.5, -0.185577, 0.371154, -0.123718, 0, 0.450549, 0.214286, -0.032967, 0.433013,
                   -0.214286, 0.428571, -0.142857, 0, -0.032967, 0.142857, 0.478022}},
          Example{-6.0,
                  {0.5, -0.185577, -0.371154, -0.123718, 0, -0.450549, 0.214286, 0.032967, 0.433013,
                   -0.214286, -0.428571, -0.142857, 0, -0.032967, -0.142857, 0.478022}}}) {
        const Vec3f normal = Vec3f(Vec3d(2.0, 3.0, example.normalZ) / 7.0);
        const std::vector<double> matrix =
            test::sumMatrix(test::hemisphereQuadrature(normal, 2), {2, 2}, normal);
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_NEAR(matrix[i], example.matrix[i], kPrinted) << i;
        // Row (1, 0) times √(4/3π) is the vector of the unshadowed surface.
        const double factor = std::sqrt(4.0 / (3.0 * std::numbers::pi));
        const double toVector = std::sqrt(3.0 / (4.0 * std::numbers::pi)) * 2.0 / 3.0;
        EXPECT_NEAR(factor * matrix[8], 0.5 / std::sqrt(std::numbers::pi), kPrinted);
        EXPECT_NEAR(factor * matrix[10], toVector * example.normalZ / 7.0, kPrinted);
    }
}

}  // namespace
}  // namespace prt

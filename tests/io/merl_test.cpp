#include "prt/io/merl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "prt/base/file.h"
#include "tests/brdf/brdf_samples.h"
#include "tests/io/test_files.h"

namespace prt::test {
namespace {

constexpr std::size_t kHeaderBytes = 12;

/// The database's file of a table of reflectances, [channel][θ_h][θ_d][φ_d].
std::string makeMerlFile(const std::vector<float>& table) {
    constexpr double kScales[] = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
    std::string file;
    file.reserve(kHeaderBytes + 8 * table.size());
    for (const std::int32_t size : {90, 90, 180})
        append(file, size);
    for (std::size_t i = 0; i < table.size(); ++i)
        append(file, static_cast<double>(table[i]) / kScales[i / MeasuredBrdf::kCellCount]);
    return file;
}

/// A small alphabet of cells, good for any damage.
const std::string& grayFile() {
    static const std::string kFile =
        makeMerlFile(std::vector<float>(3 * MeasuredBrdf::kCellCount, 0.25f));
    return kFile;
}

void setValue(std::string& file, std::size_t index, double value) {
    std::memcpy(file.data() + kHeaderBytes + 8 * index, &value, sizeof value);
}

std::string complaintOf(const std::string& file) {
    const Error error = catchError([&] { parseMerlBrdf(asBytes(file), "gold.binary"); });
    EXPECT_EQ(error.code(), ErrorCode::malformed);
    EXPECT_EQ(error.where(), "gold.binary");
    return error.what();
}

TEST(Merl, ALambertTableIsLambertInEveryDirection) {
    constexpr double kFloatRounding = 1e-6;
    const Vec3d albedo(0.8, 0.5, 0.2);
    const TemporaryFolder folder;
    const std::string file = makeMerlFile(
        measureTable([&](const Vec3d&, const Vec3d&) { return albedo * std::numbers::inv_pi; }));
    EXPECT_EQ(file.size(), 34'992'012u);
    const LoadedMerlBrdf loaded = readMerlBrdf(folder.write("paint.binary", file));
    EXPECT_EQ(loaded.negativeCount, 0u);
    RandomStream random(1, 0);
    int checkCount = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        if (std::min(incident.z, view.z) < 0.1) continue;  // cells there reach below the horizon
        EXPECT_NEAR((loaded.brdf->evaluate(incident, view) * std::numbers::pi - albedo).length(),
                    0.0, kFloatRounding);
        ++checkCount;
    }
    EXPECT_GT(checkCount, 1500);
}

TEST(Merl, AGgxTableIsGgxWithinItsCells) {
    constexpr double kCellVariation = 0.12;
    const Brdf metal = makeGltfBrdf(Vec3f(0.9f, 0.6f, 0.3f), {.metallic = 1.0f, .roughness = 0.6f});
    const std::string file =
        makeMerlFile(measureTable([&](const Vec3d& incident, const Vec3d& view) {
            return evaluateBrdf(metal, incident, view);
        }));
    const LoadedMerlBrdf loaded = parseMerlBrdf(asBytes(file), "metal.binary");
    RandomStream random(2, 0);
    for (int i = 0; i < 5000; ++i) {
        const Vec3d incident = drawUpward(random), view = drawUpward(random);
        if (std::min(incident.z, view.z) < 0.1) continue;
        const Vec3d expected = evaluateBrdf(metal, incident, view);
        const Vec3d actual = loaded.brdf->evaluate(incident, view);
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(actual[channel], expected[channel], kCellVariation * expected[channel]);
    }
}

/// Bytes by the tests' own writer; what is read back is the table to the bit.
TEST(Merl, WrittenFilesAreTheDatabasesAndReadBackAsTheTable) {
    std::vector<float> table(3 * MeasuredBrdf::kCellCount);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(i % 9973) * 0.37f;
    table.back() = std::numeric_limits<float>::max();
    const TemporaryFolder folder;
    const auto path = folder.path() / "made.binary";
    writeMerlBrdf(path, MeasuredBrdf(table));
    const std::string expected = makeMerlFile(table);
    EXPECT_TRUE(std::ranges::equal(readFile(path, expected.size()), asBytes(expected)));
    const LoadedMerlBrdf loaded = readMerlBrdf(path);
    EXPECT_TRUE(loaded.brdf->values() == table);
    EXPECT_EQ(loaded.negativeCount, 0u);
    EXPECT_EQ(catchError([&] {
                  writeMerlBrdf(folder.path() / "none" / "made.binary", *loaded.brdf);
              }).code(),
              ErrorCode::writeFailed);
}

TEST(Merl, NegativeValuesMarkWhatWasNotMeasured) {
    std::string file = grayFile();
    setValue(file, 0, -1.0);
    setValue(file, 2 * MeasuredBrdf::kCellCount + 5, -1e-3);
    const LoadedMerlBrdf loaded = parseMerlBrdf(asBytes(file), "gold.binary");
    EXPECT_EQ(loaded.negativeCount, 2u);
    const Vec3d up(0.0, 0.0, 1.0);
    EXPECT_EQ(loaded.brdf->evaluate(up, up).x, 0.0);
    EXPECT_NEAR(loaded.brdf->evaluate(up, up).y, 0.25, 1e-6);
}

TEST(Merl, OtherSizesAreRefusedByWhatTheyAre) {
    const std::string& good = grayFile();
    for (std::size_t size = 0; size < kHeaderBytes; ++size)
        EXPECT_EQ(complaintOf(good.substr(0, size)), "is too short for a MERL BRDF");
    for (const std::size_t size : {kHeaderBytes, kHeaderBytes + 8, good.size() - 1})
        EXPECT_EQ(complaintOf(good.substr(0, size)),
                  "has " + std::to_string(size) + " bytes, where a MERL BRDF has 34992012");
    EXPECT_EQ(complaintOf(good + "x"), "has 34992013 bytes, where a MERL BRDF has 34992012");
}

TEST(Merl, OtherTablesAreRefusedBeforeTheyAreAllocated) {
    for (std::size_t byte = 0; byte < kHeaderBytes; ++byte)
        for (const unsigned change : {1u, 128u, 255u}) {
            std::string file = grayFile().substr(0, 64);
            file[byte] = static_cast<char>(static_cast<unsigned char>(file[byte]) ^ change);
            EXPECT_NE(complaintOf(file).find("where a MERL BRDF has 90 × 90 × 180"),
                      std::string::npos);
        }
}

TEST(Merl, ValuesThatAreNotFiniteAreRefusedByTheirPlace) {
    constexpr std::size_t kLast = 3 * MeasuredBrdf::kCellCount - 1;
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity(), 1e300}) {
        std::string file = grayFile();
        setValue(file, kLast, value);
        EXPECT_EQ(complaintOf(file), "has a value that is not finite, the 4374000th of its table");
    }
}

TEST(Merl, FilesAreRefusedByTheirSizeUnread) {
    const TemporaryFolder folder;
    EXPECT_EQ(catchError([&] { readMerlBrdf(folder.path() / "absent.binary"); }).code(),
              ErrorCode::notFound);
    const auto path = folder.write("huge.binary", "");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 36);
    const Error error = catchError([&] { readMerlBrdf(path); });
    EXPECT_EQ(error.code(), ErrorCode::malformed);
    EXPECT_EQ(error.where(), path.string());
    EXPECT_EQ(std::string(error.what()), "has 68719476736 bytes, where a MERL BRDF has 34992012");
}

}  // namespace
}  // namespace prt::test

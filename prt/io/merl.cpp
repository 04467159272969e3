// Bibliography
//   [Matusik03]  A data-driven reflectance model
#include "prt/io/merl.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "prt/base/byte_stream.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt {
namespace {

constexpr std::size_t kHeaderBytes = 3 * sizeof(std::int32_t);
constexpr std::size_t kFileBytes = kHeaderBytes + 3 * MeasuredBrdf::kCellCount * sizeof(double);

/// What the values of a channel are multiplied by.
constexpr std::array<double, 3> kChannelScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

[[noreturn]] void rejectSize(std::uintmax_t bytes, const std::string& name) {
    throw Error(ErrorCode::malformed,
                "has " + std::to_string(bytes) + " bytes, where a MERL BRDF has " +
                    std::to_string(kFileBytes),
                name);
}

constexpr std::array<std::size_t, 3> kSizes = {MeasuredBrdf::kHalfAngleCount,
                                               MeasuredBrdf::kDifferenceAngleCount,
                                               MeasuredBrdf::kAzimuthCount};

void requireSizes(ByteReader& reader, const std::string& name) {
    std::array<std::int32_t, 3> sizes{};
    for (std::int32_t& size : sizes)
        size = reader.readNumber<std::int32_t>();
    for (std::size_t i = 0; i < sizes.size(); ++i)
        if (sizes[i] != static_cast<std::int32_t>(kSizes[i]))
            throw Error(ErrorCode::malformed,
                        "says that its table has " + std::to_string(sizes[0]) + " × " +
                            std::to_string(sizes[1]) + " × " + std::to_string(sizes[2]) +
                            " cells, where a MERL BRDF has 90 × 90 × 180",
                        name);
}

}  // namespace

LoadedMerlBrdf parseMerlBrdf(std::span<const std::byte> file, const std::string& name) {
    if (file.size() < kHeaderBytes)
        throw Error(ErrorCode::malformed, "is too short for a MERL BRDF", name);
    ByteReader reader(file);
    requireSizes(reader, name);
    if (file.size() != kFileBytes) rejectSize(file.size(), name);
    LoadedMerlBrdf loaded;
    std::vector<float> values(3 * MeasuredBrdf::kCellCount);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double scale = kChannelScales[i / MeasuredBrdf::kCellCount];
        auto value = static_cast<float>(reader.readNumber<double>() * scale);
        if (!std::isfinite(value))
            throw Error(
                ErrorCode::malformed,
                "has a value that is not finite, the " + std::to_string(i + 1) + "th of its table",
                name);
        if (value < 0.0f) {
            value = 0.0f;
            ++loaded.negativeCount;
        }
        values[i] = value;
    }
    loaded.brdf = std::make_shared<const MeasuredBrdf>(std::move(values));
    return loaded;
}

LoadedMerlBrdf readMerlBrdf(const std::filesystem::path& path) {
    std::error_code unknown;
    const std::uintmax_t size = std::filesystem::file_size(path, unknown);
    if (!unknown && size > kFileBytes) rejectSize(size, path.string());
    return parseMerlBrdf(readFile(path, kFileBytes), path.string());
}

void writeMerlBrdf(const std::filesystem::path& path, const MeasuredBrdf& brdf) {
    ByteWriter file(kFileBytes);
    for (const std::size_t size : kSizes)
        file.writeNumber(static_cast<std::int32_t>(size));
    const std::vector<float>& values = brdf.values();
    for (std::size_t i = 0; i < values.size(); ++i)
        file.writeNumber(static_cast<double>(values[i]) /
                         kChannelScales[i / MeasuredBrdf::kCellCount]);
    writeFileAtomically(path, file.bytes());
}

}  // namespace prt

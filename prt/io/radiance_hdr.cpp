// Radiance RGBE pictures [Ward91]. By hand, because the stb_image that Debian 12 ships never
// returns from a truncated run-length encoded file (CVE-2021-42715).

#include "prt/io/radiance_hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "prt/base/error.h"
#include "prt/io/image_format.h"

namespace prt {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int kMinRunLengthWidth = 8;
constexpr int kMaxRunLengthWidth = 32767;

class RadianceReader {
  public:
    RadianceReader(std::span<const std::byte> bytes, const std::string& name)
        : bytes_(bytes), name_(name) {}

    Image read(const ImageLimits& limits) {
        readHeader();
        readResolution(limits);
        Image image;
        image.width = width_;
        image.height = height_;
        // Reserving takes address space only: memory is used as rows
        // arrive, so a short file stays cheap.
        image.pixels.reserve(std::size_t(width_) * std::size_t(height_));
        std::vector<Rgbe> row(static_cast<std::size_t>(width_));
        for (int y = 0; y < height_; ++y) {
            readRow(row);
            std::transform(row.begin(), row.end(), std::back_inserter(image.pixels), decode);
        }
        return image;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed, what, name_);
    }

    std::uint8_t nextByte() {
        if (position_ == bytes_.size()) fail("is a Radiance picture that ends too early");
        return std::to_integer<std::uint8_t>(bytes_[position_++]);
    }

    std::string_view nextLine() {
        const std::size_t first = position_;
        while (nextByte() != '\n') {
        }
        return {reinterpret_cast<const char*>(bytes_.data()) + first, position_ - 1 - first};
    }

    void readHeader() {
        const std::string_view magic = nextLine();
        if (magic != "#?RADIANCE" && magic != "#?RGBE") fail("is not a Radiance picture");
        bool hasFormat = false;
        for (std::string_view line = nextLine(); !line.empty(); line = nextLine()) {
            if (!line.starts_with("FORMAT=")) continue;
            hasFormat = true;
            if (line != "FORMAT=32-bit_rle_rgbe")
                throw Error(ErrorCode::unsupported,
                            "is a Radiance picture of another format than 32-bit_rle_rgbe", name_);
        }
        if (!hasFormat) fail("is a Radiance picture without a FORMAT line");
    }

    void readResolution(const ImageLimits& limits) {
        std::string_view line = nextLine();
        height_ = readExtent(line, "-Y ", limits.maxHeight);
        width_ = readExtent(line, " +X ", limits.maxWidth);
        if (!line.empty()) fail("has a resolution line with something after it");
        checkImageSize(width_, height_, limits, name_);
    }

    /// Takes `prefix` and a number from the front of the line.
    int readExtent(std::string_view& line, std::string_view prefix, int limit) const {
        if (!line.starts_with(prefix))
            throw Error(ErrorCode::unsupported,
                        "is a Radiance picture whose resolution is not given as \"-Y … +X …\"",
                        name_);
        line.remove_prefix(prefix.size());
        int extent = 0;
        const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), extent);
        if (failure == std::errc::result_out_of_range)
            throw Error(ErrorCode::limitExceeded,
                        "is more than " + std::to_string(limit) + " pixels wide or high", name_,
                        "scale it down, or allow more with --max-pixels");
        if (failure != std::errc()) fail("has a resolution that is not a number");
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        return extent;
    }

    void readRow(std::vector<Rgbe>& row) {
        const Rgbe first = nextPixel();
        const bool isRunLengthEncoded = width_ >= kMinRunLengthWidth &&
                                        width_ <= kMaxRunLengthWidth && first[0] == 2 &&
                                        first[1] == 2 && first[2] < 128;
        if (!isRunLengthEncoded) return readFlatRow(row, first);
        if (first[2] * 256 + first[3] != width_) fail("has a row of another width than the image");
        for (std::size_t channel = 0; channel < 4; ++channel)
            readRuns(row, channel);
    }

    Rgbe nextPixel() {
        Rgbe pixel;
        for (std::uint8_t& channel : pixel)
            channel = nextByte();
        return pixel;
    }

    /// Pixels one after the other; the older run-length code repeats the last
    /// pixel n times by (1, 1, 1, n).
    void readFlatRow(std::vector<Rgbe>& row, Rgbe pixel) {
        int repeatShift = 0;
        for (std::size_t x = 0;;) {
            if (x > 0 && pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
                const std::size_t count = std::size_t(pixel[3]) << repeatShift;
                if (repeatShift > 16 || count > row.size() - x)
                    fail("has a run longer than its row");
                for (std::size_t i = 0; i < count; ++i, ++x)
                    row[x] = row[x - 1];
                repeatShift += 8;
            } else {
                row[x++] = pixel;
                repeatShift = 0;
            }
            if (x == row.size()) return;
            pixel = nextPixel();
        }
    }

    /// One channel of a row as runs (128 + count, value) and dumps (count, values …).
    void readRuns(std::vector<Rgbe>& row, std::size_t channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = nextByte();
            const bool isRun = code > 128;
            const std::size_t count = isRun ? code - 128u : code;
            if (count == 0 || count > row.size() - x) fail("has a run longer than its row");
            const std::uint8_t runValue = isRun ? nextByte() : std::uint8_t(0);
            for (std::size_t i = 0; i < count; ++i)
                row[x++][channel] = isRun ? runValue : nextByte();
        }
    }

    static Vec3f decode(const Rgbe& pixel) {
        if (pixel[3] == 0) return Vec3f(0.0f);
        const float scale = std::ldexp(1.0f, pixel[3] - (128 + 8));
        return Vec3f(pixel[0], pixel[1], pixel[2]) * scale;
    }

    std::span<const std::byte> bytes_;
    const std::string& name_;
    std::size_t position_ = 0;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace

Image decodeRadianceHdr(std::span<const std::byte> encoded, const std::string& name,
                        const ImageLimits& limits) {
    return RadianceReader(encoded, name).read(limits);
}

}  // namespace prt

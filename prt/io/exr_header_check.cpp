#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "prt/base/error.h"
#include "prt/io/exr.h"
#include "prt/io/image_format.h"

namespace prt {
namespace {

static_assert(std::endian::native == std::endian::little, "OpenEXR files are little endian");

constexpr std::size_t kMagicAndVersionBytes = 8;
constexpr std::size_t kVersionOffset = 4;
constexpr std::uint32_t kMultipartFlag = 0x1000;
constexpr std::size_t kMaxPartCount = 1024;
constexpr std::int64_t kChunkOffsetBytes = 8;

/// Walks the attributes of each part's header [OpenExrLayout]: name, type, size, value.
class ExrHeaderCheck {
  public:
    ExrHeaderCheck(std::span<const std::byte> bytes, const std::string& name,
                   const ImageLimits& limits)
        : bytes_(bytes), name_(name), limits_(limits) {}

    ExrSize run() {
        if (bytes_.size() < kMagicAndVersionBytes) fail("is too short for an EXR image");
        const bool isMultipart = readAt<std::uint32_t>(kVersionOffset) & kMultipartFlag;
        position_ = kMagicAndVersionBytes;
        const ExrSize size = checkPart();
        if (!isMultipart) return size;
        // The headers of a multipart file end with an empty one.
        std::size_t partCount = 1;
        while (!nextName().empty()) {
            if (++partCount > kMaxPartCount) fail("has too many parts");
            rewindName();
            checkPart();
        }
        return size;
    }

  private:
    struct Window {
        std::int32_t minX, minY, maxX, maxY;
    };
    struct TileSize {
        std::uint32_t width, height;
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed, what, name_);
    }

    template <class Value>
    Value readAt(std::size_t offset) const {
        if (offset > bytes_.size() || sizeof(Value) > bytes_.size() - offset)
            fail("has an EXR header that ends too early");
        Value value;
        std::memcpy(&value, bytes_.data() + offset, sizeof value);
        return value;
    }

    std::string_view nextName() {
        nameStart_ = position_;
        const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + position_,
                                    bytes_.size() - position_);
        const std::size_t length = rest.find('\0');
        if (length == std::string_view::npos) fail("has an EXR header that ends too early");
        position_ += length + 1;
        return rest.substr(0, length);
    }

    void rewindName() { position_ = nameStart_; }

    ExrSize checkPart() {
        std::optional<Window> window;
        std::optional<TileSize> tile;
        for (std::string_view attribute = nextName(); !attribute.empty(); attribute = nextName()) {
            const std::string_view type = nextName();
            const auto valueBytes = readAt<std::int32_t>(position_);
            position_ += sizeof valueBytes;
            if (valueBytes < 0 || std::size_t(valueBytes) > bytes_.size() - position_)
                fail("has an EXR header with an attribute longer than the file");
            if (attribute == "dataWindow" && type == "box2i") window = readAt<Window>(position_);
            if (attribute == "tiles" && type == "tiledesc") tile = readAt<TileSize>(position_);
            position_ += std::size_t(valueBytes);
        }
        if (!window) fail("is an EXR image without a data window");
        return checkSizes(*window, tile);
    }

    ExrSize checkSizes(const Window& window, const std::optional<TileSize>& tile) const {
        const std::int64_t width = std::int64_t(window.maxX) - window.minX + 1;
        const std::int64_t height = std::int64_t(window.maxY) - window.minY + 1;
        checkImageSize(width, height, limits_, name_);
        const ExrSize size{static_cast<int>(width), static_cast<int>(height)};
        if (!tile) return size;
        checkImageSize(tile->width, tile->height, limits_, name_);
        // Each tile has an entry in the table of offsets that follows the headers.
        const std::int64_t tileCount = ((width + tile->width - 1) / tile->width) *
                                       ((height + tile->height - 1) / tile->height);
        if (tileCount * kChunkOffsetBytes > std::int64_t(bytes_.size()))
            fail("is too short for the EXR tiles that it claims");
        return size;
    }

    std::span<const std::byte> bytes_;
    const std::string& name_;
    const ImageLimits& limits_;
    std::size_t position_ = 0;
    std::size_t nameStart_ = 0;
};

}  // namespace

ExrSize checkExrHeaders(std::span<const std::byte> encoded, const std::string& name,
                        const ImageLimits& limits) {
    return ExrHeaderCheck(encoded, name, limits).run();
}

}  // namespace prt

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include "prt/base/error.h"
#include "prt/io/confined.h"
#include "prt/io/exr.h"
#include "prt/io/image_format.h"

namespace prt {
namespace {

// Lines decoded at a time: the largest block of any compression (DWAB),
// so that none is decoded twice.
constexpr int kBlockLineCount = 256;

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::span<const std::byte> bytes) : Imf::IStream("image"), bytes_(bytes) {}

    bool read(char* destination, int byteCount) override {
        if (byteCount < 0 || position_ > bytes_.size() ||
            std::size_t(byteCount) > bytes_.size() - position_)
            throw Iex::InputExc("it ends too early");
        std::memcpy(destination, bytes_.data() + position_, std::size_t(byteCount));
        position_ += std::size_t(byteCount);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::span<const std::byte> bytes_;
    std::uint64_t position_ = 0;
};

/// The channels that become red, green and blue; one and the same for grey.
using ColorChannels = std::array<std::string, 3>;

std::string listChannels(const Imf::ChannelList& channels) {
    std::string names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        names += (names.empty() ? "" : ", ") + std::string(channel.name());
    return names.empty() ? "none" : names;
}

ColorChannels chooseChannels(const Imf::ChannelList& channels, const std::string& name) {
    const auto has = [&](const std::string& channel) {
        return channels.findChannel(channel) != nullptr;
    };
    const auto hasColor = [&](const std::string& layer) {
        return has(layer + "R") && has(layer + "G") && has(layer + "B");
    };
    if (hasColor("")) return {"R", "G", "B"};
    if (has("Y") && !has("RY") && !has("BY")) return {"Y", "Y", "Y"};
    // Channels are sorted by name: the first layer comes first.
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string full = channel.name();
        const std::string layer = full.substr(0, full.rfind('.') + 1);
        if (!layer.empty() && hasColor(layer)) return {layer + "R", layer + "G", layer + "B"};
    }
    // OpenEXR reads a channel that is missing as 0.
    if (has("R") || has("G") || has("B")) return {"R", "G", "B"};
    throw Error(ErrorCode::unsupported,
                "is an EXR image without channels R G B, Y, or a layer with R G B; it has " +
                    listChannels(channels),
                name);
}

void checkSampling(const Imf::ChannelList& channels, const ColorChannels& chosen,
                   const std::string& place) {
    for (const std::string& name : chosen) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel && (channel->xSampling != 1 || channel->ySampling != 1))
            throw Error(ErrorCode::unsupported, "is an EXR image with subsampled colour", place);
    }
}

Imf::FrameBuffer makeFrameBuffer(const ColorChannels& channels, const Imath::Box2i& window,
                                 Vec3f* pixels) {
    const auto width = std::size_t(window.max.x) - std::size_t(window.min.x) + 1;
    const auto slice = [&](float* channel) {
        return Imf::Slice::Make(Imf::FLOAT, channel, window, sizeof(Vec3f), sizeof(Vec3f) * width);
    };
    Imf::FrameBuffer buffer;
    buffer.insert(channels[0], slice(&pixels->x));
    if (channels[1] == channels[0]) return buffer;
    buffer.insert(channels[1], slice(&pixels->y));
    buffer.insert(channels[2], slice(&pixels->z));
    return buffer;
}

void readFirstPart(Imf::MultiPartInputFile& file, const std::string& name, const ExrSize& size,
                   Vec3f* pixels) {
    const Imf::Header& header = file.header(0);
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw Error(ErrorCode::unsupported, "is a deep EXR image", name, "flatten it");
    const ColorChannels channels = chooseChannels(header.channels(), name);
    checkSampling(header.channels(), channels, name);

    const Imath::Box2i window = header.dataWindow();
    if (window.max.x - window.min.x + 1 != size.width ||
        window.max.y - window.min.y + 1 != size.height)
        throw Error(ErrorCode::malformed, "is an EXR image with two data windows", name);
    Imf::InputPart part(file, 0);
    part.setFrameBuffer(makeFrameBuffer(channels, window, pixels));
    for (int y = window.min.y; y <= window.max.y; y += kBlockLineCount)
        part.readPixels(y, std::min(y + kBlockLineCount - 1, window.max.y));
    if (channels[1] == channels[0])
        for (std::size_t i = 0; i < std::size_t(size.width) * std::size_t(size.height); ++i)
            pixels[i] = Vec3f(pixels[i].x);
}

/// OpenEXR's own words without the full stop, to follow a colon.
std::string reasonOf(const std::exception& failure) {
    std::string reason = failure.what();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n'))
        reason.pop_back();
    return reason;
}

/// @param pixels  as many as the size has
void readPixels(std::span<const std::byte> encoded, const std::string& name, const ExrSize& size,
                Vec3f* pixels) {
    try {
        MemoryInput input(encoded);
        constexpr int kOwnThreads = 0;
        constexpr bool kMendMissingOffsets = false;
        Imf::MultiPartInputFile file(input, kOwnThreads, kMendMissingOffsets);
        readFirstPart(file, name, size, pixels);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "does not fit in memory", name);
    } catch (const std::exception& failure) {
        throw Error(ErrorCode::malformed, "is not a valid EXR image: " + reasonOf(failure), name);
    }
}

}  // namespace

Image decodeExr(std::span<const std::byte> encoded, const std::string& name,
                const ImageLimits& limits) {
    const ExrSize size = checkExrHeaders(encoded, name, limits);
    const std::size_t pixelCount = std::size_t(size.width) * std::size_t(size.height);
    const SharedMemory shared(pixelCount * sizeof(Vec3f));
    auto* pixels = reinterpret_cast<Vec3f*>(shared.bytes().data());
    runDecoder([&] { readPixels(encoded, name, size, pixels); }, pixelCount, limits, name);

    Image image;
    image.width = size.width;
    image.height = size.height;
    image.pixels.assign(pixels, pixels + pixelCount);
    return image;
}

}  // namespace prt

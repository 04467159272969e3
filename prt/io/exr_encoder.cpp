#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <cstring>

#include "prt/base/assert.h"
#include "prt/io/exr.h"

namespace prt {
namespace {

/// Grows as it is written; OpenEXR comes back to fill in the table of offsets.
class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("image") {}

    void write(const char* source, int byteCount) override {
        const std::size_t end = position_ + std::size_t(byteCount);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + position_, source, std::size_t(byteCount));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::vector<std::byte> bytes;

  private:
    std::uint64_t position_ = 0;
};

}  // namespace

std::vector<std::byte> encodeExr(const Image& image) {
    PRT_ASSERT(!image.pixels.empty(), "an EXR has at least one pixel");
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    const auto addChannel = [&](const char* name, const float& first) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name,
                      Imf::Slice::Make(Imf::FLOAT, &first, header.dataWindow(), sizeof(Vec3f)));
    };
    const Vec3f& first = image.pixels.front();
    addChannel("R", first.x);
    addChannel("G", first.y);
    addChannel("B", first.z);

    MemoryOutput output;
    {
        Imf::OutputFile file(output, header);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    }
    return std::move(output.bytes);
}

}  // namespace prt

#include "fuzz/exr_seeds.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cstdint>

namespace prt::fuzz {
namespace {

constexpr int kWidth = 20;
constexpr int kHeight = 9;

class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("seed") {}

    void write(const char* bytes, int byteCount) override {
        bytes_.resize(std::max(bytes_.size(), position_ + std::size_t(byteCount)));
        std::copy_n(bytes, byteCount, bytes_.begin() + std::ptrdiff_t(position_));
        position_ += std::size_t(byteCount);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

/// Halves that rise from pixel to pixel, as R, G and B.
struct Ramp {
    std::vector<half> samples;
    Imf::FrameBuffer buffer;

    Ramp() {
        for (int i = 0; i < kWidth * kHeight; ++i)
            samples.push_back(half(0.01f * float(i * i % 97)));
        for (const char* name : {"R", "G", "B"})
            buffer.insert(name, Imf::Slice::Make(Imf::HALF, samples.data(), Imath::V2i(0, 0),
                                                 kWidth, kHeight));
    }
};

Imf::Header makeHeader(Imf::Compression compression) {
    Imf::Header header(kWidth, kHeight, 1.0f, Imath::V2f(0.0f), 1.0f, Imf::INCREASING_Y,
                       compression);
    for (const char* name : {"R", "G", "B"})
        header.channels().insert(name, Imf::Channel(Imf::HALF));
    return header;
}

std::string writeScanLines(Imf::Compression compression) {
    const Ramp ramp;
    MemoryOutput output;
    {
        Imf::OutputFile file(output, makeHeader(compression), 0);
        file.setFrameBuffer(ramp.buffer);
        file.writePixels(kHeight);
    }
    return output.bytes();
}

std::string writeTiles(Imf::LevelMode mode) {
    const Ramp ramp;
    Imf::Header header = makeHeader(Imf::PIZ_COMPRESSION);
    header.setTileDescription(Imf::TileDescription(8, 8, mode));
    MemoryOutput output;
    {
        Imf::TiledOutputFile file(output, header, 0);
        file.setFrameBuffer(ramp.buffer);
        for (int y = 0; y < file.numYLevels(); ++y)
            for (int x = 0; x < file.numXLevels(); ++x)
                if (file.isValidLevel(x, y))
                    file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
    }
    return output.bytes();
}

std::string writeParts() {
    const Ramp ramp;
    std::vector<Imf::Header> headers(2, makeHeader(Imf::ZIPS_COMPRESSION));
    headers[0].setName("first"), headers[1].setName("second");
    for (Imf::Header& header : headers)
        header.setType(Imf::SCANLINEIMAGE);
    MemoryOutput output;
    {
        Imf::MultiPartOutputFile file(output, headers.data(), 2, false, 0);
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            part.setFrameBuffer(ramp.buffer);
            part.writePixels(kHeight);
        }
    }
    return output.bytes();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> makeExrSeeds() {
    std::vector<std::pair<std::string, std::string>> seeds = {
        {"tiles", writeTiles(Imf::ONE_LEVEL)},
        {"mipmap", writeTiles(Imf::MIPMAP_LEVELS)},
        {"ripmap", writeTiles(Imf::RIPMAP_LEVELS)},
        {"parts", writeParts()}};
    for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i)
        seeds.emplace_back("compression_" + std::to_string(i),
                           writeScanLines(static_cast<Imf::Compression>(i)));
    return seeds;
}

}  // namespace prt::fuzz

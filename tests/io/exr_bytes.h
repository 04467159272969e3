#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test_files.h"

namespace prt::test {

/// An uncompressed float scan-line EXR, laid out byte by byte after the published file layout, with
/// no help from OpenEXR. The lies a test wants to tell are fields.
struct ExrBytes {
    std::int32_t minX = 0, minY = 0;
    std::int32_t width = 1, height = 1;
    std::vector<std::string> channels = {"B", "G", "R"};  ///< in alphabetical order
    std::vector<float> samples = {};  ///< of each row: all of the first channel, all of the second,
                                      ///< …; fewer for a short file
    char compression = 0;
    std::string extraAttributes = {};

    static std::string attribute(const std::string& name, const std::string& type,
                                 const std::string& value) {
        std::string bytes = name + '\0' + type + '\0';
        append(bytes, static_cast<std::int32_t>(value.size()));
        return bytes + value;
    }

    std::string header() const {
        std::string list;
        for (const std::string& channel : channels) {
            list += channel + '\0';
            append<std::int32_t>(list, 2);  // FLOAT
            append<std::int32_t>(list, 0);
            append<std::int32_t>(list, 1);
            append<std::int32_t>(list, 1);
        }
        std::string window;
        for (const std::int32_t bound : {minX, minY, minX + width - 1, minY + height - 1})
            append(window, bound);
        std::string one, center(8, '\0');
        append(one, 1.0f);
        return attribute("channels", "chlist", list + '\0') +
               attribute("compression", "compression", std::string(1, compression)) +
               attribute("dataWindow", "box2i", window) +
               attribute("displayWindow", "box2i", window) +
               attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
               attribute("pixelAspectRatio", "float", one) +
               attribute("screenWindowCenter", "v2f", center) +
               attribute("screenWindowWidth", "float", one) + extraAttributes + '\0';
    }

    std::string file() const {
        std::string bytes = "\x76\x2f\x31\x01";
        append<std::int32_t>(bytes, 2);
        bytes += header();
        const std::size_t rowSamples = static_cast<std::size_t>(width) * channels.size();
        const std::size_t rowCount = samples.size() / rowSamples;
        const std::size_t rowBytes = 8 + 4 * rowSamples;
        const std::size_t firstRow = bytes.size() + 8 * rowCount;
        for (std::size_t y = 0; y < rowCount; ++y)
            append<std::uint64_t>(bytes, firstRow + y * rowBytes);
        for (std::size_t y = 0; y < rowCount; ++y) {
            append(bytes, minY + static_cast<std::int32_t>(y));
            append(bytes, static_cast<std::int32_t>(4 * rowSamples));
            for (std::size_t i = 0; i < rowSamples; ++i)
                append(bytes, samples[y * rowSamples + i]);
        }
        return bytes;
    }
};

}  // namespace prt::test

#include "apps/prt/limits.h"

#include <algorithm>

#include "apps/prt/arguments.h"

namespace prt::cli {

ImageLimits ReaderLimits::images() const {
    constexpr std::uintmax_t kMaxBytesPerPixel = 16;  // of EXR with four channels of 32 bits
    const auto side = static_cast<std::uintmax_t>(maxPixels);
    ImageLimits limits;
    limits.maxWidth = maxPixels;
    limits.maxHeight = maxPixels;
    limits.maxFileBytes = std::max(limits.maxFileBytes, kMaxBytesPerPixel * side * side);
    return limits;
}

SceneLimits ReaderLimits::scene() const {
    // A closed mesh has two triangles a vertex.
    constexpr std::size_t kIndicesPerVertex = 6;
    constexpr std::uintmax_t kMaxBytesPerVertex = 128;
    SceneLimits limits;
    limits.textures = images();
    if (maxVertices == 0) return limits;
    limits.gltf.maxVertexCount = maxVertices;
    limits.gltf.maxIndexCount = kIndicesPerVertex * maxVertices;
    limits.gltf.maxFileBytes = std::max(limits.gltf.maxFileBytes, kMaxBytesPerVertex * maxVertices);
    return limits;
}

std::size_t ReaderLimits::refinedVertices() const {
    return maxVertices > 0 ? maxVertices : RefineOptions{}.maxVertexCount;
}

void addPixelLimit(CLI::App& command, ReaderLimits& limits) {
    constexpr int kHighest = 1 << 20;
    addIntegerOption(command, "--max-pixels", limits.maxPixels, 1, kHighest,
                     "refuse images wider or higher than this");
}

void addVertexLimit(CLI::App& command, ReaderLimits& limits) {
    constexpr std::size_t kHighest = 4'000'000'000;
    command
        .add_option("--max-vertices", limits.maxVertices,
                    "refuse scenes of more, and refine to no more [200 million, 20 million]")
        ->check(CLI::Range(std::size_t(1), kHighest).description(""))
        ->type_name("N");
}

}  // namespace prt::cli

#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

#include "prt/io/scene_io.h"
#include "prt/scene/refine.h"

namespace prt::cli {

/// The limits of readers that an honest file can meet, as the user sets them.
struct ReaderLimits {
    int maxPixels = ImageLimits().maxWidth;  ///< along each side of an image
    std::size_t maxVertices = 0;             ///< of a scene; 0 for the readers' own

    ImageLimits images() const;
    SceneLimits scene() const;
    /// Of a scene that is being refined.
    std::size_t refinedVertices() const;
};

/// Adds --max-pixels.
void addPixelLimit(CLI::App& command, ReaderLimits& limits);

/// Adds --max-vertices.
void addVertexLimit(CLI::App& command, ReaderLimits& limits);

}  // namespace prt::cli

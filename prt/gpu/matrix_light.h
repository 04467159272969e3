#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/stored_range.h"

namespace prt {

/// A light for matrices as they are stored: scale and bias of each column are in it.
struct MatrixLight {
    /// A row of a matrix, as shaders/receive.comp has it.
    struct Row {
        Vec3f bias{0.0f, 0.0f, 0.0f};  ///< what the columns' biases make of the light
        std::uint32_t place = 0;       ///< where the result goes among a receiver's
    };
    std::vector<Row> rows;  ///< of all channels, and one more
    /// [panel][colour][4]: what a panel's four numbers are multiplied by for red, green and blue.
    std::vector<float> factors;
};

/// Results are placed by incidentIndex, those of each channel behind one another.
///
/// @param ranges    of each column, [channel][i][j]
/// @param lighting  with at most bandCount bands
MatrixLight foldMatrixLight(std::span<const StoredRange> ranges, int bandCount,
                            int incidentBandCount, const Lighting& lighting);

}  // namespace prt

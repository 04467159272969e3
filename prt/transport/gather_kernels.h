#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/math/isa.h"
#include "prt/math/vector.h"
#include "prt/trace/ray_stream.h"

namespace prt {

/// Vectors of all instruction sets divide this many lanes; arrays the
/// kernels work on are padded to it.
inline constexpr std::size_t kLaneMultiple = 16;

constexpr std::size_t padToLanes(std::size_t count) {
    return (count + kLaneMultiple - 1) / kLaneMultiple * kLaneMultiple;
}

/// The sampling pattern all receivers share, before each scrambles it for itself: Sobol points with
/// their bits reversed, ready for owenScrambleReversed.
struct SamplePattern {
    explicit SamplePattern(std::size_t sampleCount);

    std::vector<std::uint32_t> reversedX;
    std::vector<std::uint32_t> reversedY;
};

/// How one receiver turns the pattern into directions.
struct ReceiverSampling {
    std::uint32_t seedX = 0;
    std::uint32_t seedY = 0;
    Vec3f normal{0.0f, 0.0f, 1.0f};
};

/// One element of the bounce matrix: how much of another receiver's transfer
/// comes back from the hits near it.
struct BounceEntry {
    std::uint32_t receiver = 0;
    Vec3f weight{0.0f, 0.0f,
                 0.0f};  ///< barycentric weight × albedo at the hit / samples, summed over hits
};

/// Some columns of transfer as the bounces see it: of [receiver][channel · n² + coefficient], those
/// from firstColumn on.
struct BounceTransfer {
    const float* values = nullptr;     ///< aligned to 64 bytes
    std::size_t coefficientCount = 0;  ///< n²
    std::size_t firstColumn = 0;
    std::size_t columnCount = 0;  ///< a multiple of kLaneMultiple; beyond the last they are zero
};

/// The inner loops of the gather, for one instruction set.
struct GatherKernels {
    /// Fills the stream's directions: Owen-scrambled points, cosine-distributed about the normal.
    void (*sampleDirections)(const SamplePattern& pattern, const ReceiverSampling& sampling,
                             RayStream& rays);

    /// The same, uniformly distributed over the hemisphere.
    void (*sampleUniformDirections)(const SamplePattern& pattern, const ReceiverSampling& sampling,
                                    RayStream& rays);

    /// Sums y_i over the directions that are not blocked (tFar > 0).
    /// @param sums  n², written
    void (*sumVisible)(const RayStream& rays, int bandCount, std::span<float> sums);

    /// One row of the bounce matrix times the transfer of all receivers.
    /// @param result  one number a column, aligned to 64 bytes, written
    void (*multiplyRow)(std::span<const BounceEntry> row, const BounceTransfer& transfer,
                        float* result);

    /// sums_j += Σ_i factors_i rows_ij.
    ///
    /// @param rows  [i][columnCount], of which padToLanes(columnCount) can be read from each row's
    ///              beginning
    /// @param sums  padToLanes(columnCount) numbers; those beyond the last column mean nothing
    void (*addProduct)(std::span<const float> factors, const float* rows, std::size_t columnCount,
                       float* sums);

    /// sums_ij += factors_i addend_j.
    ///
    /// @param addend  a multiple of kLaneMultiple, as many as sums has columns
    void (*addOuterProduct)(std::span<const float> factors, std::span<const float> addend,
                            float* sums);
};

/// @param isa  at most detectIsa()
GatherKernels selectGatherKernels(Isa isa);

}  // namespace prt

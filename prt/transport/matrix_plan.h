#pragma once

#include <cstddef>
#include <cstdint>

#include "prt/transfer/coefficient_table.h"
#include "prt/transport/bake.h"

namespace prt {

/// How a bake divides the memory it may use while it makes matrices.
struct MatrixPlan {
    TableStorage tables{};
    std::size_t columnsAtOnce = SIZE_MAX;  ///< MatrixBakeOptions
};

/// What a part of a bake takes.
struct BytesTaken {
    std::size_t memory = 0;
    std::size_t scratch = 0;  ///< on disk, for as long as it lasts
    std::size_t files = 0;    ///< of a checkpoint
};

/// What the matrices of all receivers take: nothing if they are not asked for.
struct MatrixBytes {
    std::size_t fronts = 0;
    std::size_t backs = 0;   ///< that bounces see
    std::size_t tables = 0;  ///< visible, and with bounces
    std::size_t column = 0;  ///< of what a bounce gathers from
    std::size_t columnCount = 0;
    std::size_t atWork = 0;   ///< in the threads
    std::size_t windows = 0;  ///< what reading tables on disk brings into memory
    std::size_t units = 0;    ///< in the files of a checkpoint

    std::size_t least() const { return atWork + column + windows; }
};

/// The bytes of a table of floats.
std::size_t countTableBytes(std::size_t rowCount, std::size_t columnCount);

MatrixBytes countMatrixBytes(const BakeOptions& options, std::size_t fronts, std::size_t backs);

/// Divides the memory: first what a bounce gathers from, whose lack would have it trace its rays
/// again and again, then the tables.
///
/// @param roomBytes  at least bytes.least()
/// @param taken      written
MatrixPlan divideMatrixMemory(const BakeOptions& options, const MatrixBytes& bytes,
                              std::size_t roomBytes, BytesTaken& taken);

/// Endless bounces count as ten.
std::uint64_t countMatrixRays(const BakeOptions& options, const MatrixBytes& bytes,
                              const MatrixPlan& plan, std::size_t sampleCount);

}  // namespace prt

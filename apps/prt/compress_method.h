#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/prt/limits.h"
#include "apps/prt/stage_log.h"
#include "prt/compress/compress_transfer.h"

namespace prt::cli {

/// How transfer is stored: --method, and the options that say more of it.
struct MethodArguments {
    std::string byDefault;                ///< the method where nothing is said
    std::optional<std::string> method{};  ///< "cpca" where only options of clusters are given
    std::optional<std::size_t> clusterCount{};
    std::optional<std::size_t> componentCount{};
    std::optional<TransferEncoding> weights{};
    std::optional<TransferEncoding> bases{};
    std::optional<double> bytesPerVertex{};
    std::optional<double> maxError{};
    std::string light{};  ///< LIGHT; empty: none
};

/// Which --method to choose, for the end of a command's help.
extern const char* const kMethodHelp;

/// Adds --method … --weigh-by. @param arguments  with the default
void addMethodOptions(CLI::App& command, MethodArguments& arguments);

/// The options of compressTransfer but its light, and without threads and progress.
///
/// @param seed    of the clusters
/// @throws CLI::ValidationError  where options contradict each other
CompressOptions makeCompressOptions(const MethodArguments& arguments, std::uint64_t seed);

/// The coefficients of the light that errors are weighed by; none without one.
///
/// @throws Error  as loadLight; invalidOption for darkness
std::vector<Vec3d> loadErrorLight(const MethodArguments& arguments, int bandCount,
                                  const ReaderLimits& limits);

/// The method that is meant.
std::string methodName(const MethodArguments& arguments);

/// A command's options that make the same again, without paths: "--method cpca --clusters 64 …".
std::string describeMethod(const MethodArguments& arguments);

/// What a vertex of a layer will take at least, with its share of what is stored for all.
double forecastVertexBytes(const CompressOptions& options, std::size_t coefficientCount,
                           std::size_t vertexCount);

/// Tells what a layer takes and how far it is from what it was.
///
/// @param bytesBefore  a vertex
/// @param light        as options.clusters has it
void tellCompression(const CompressedLayer& layer, const TransferLayer& original,
                     std::size_t bytesBefore, const MethodArguments& arguments,
                     std::span<const Vec3d> light, StageLog& log);

}  // namespace prt::cli

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "apps/prt/brdf_argument.h"
#include "apps/prt/compress_method.h"
#include "apps/prt/limits.h"
#include "prt/asset/asset.h"
#include "prt/transport/bake.h"

namespace prt::cli {

/// A longest edge that leaves all edges as they are.
inline constexpr float kKeepEdges = std::numeric_limits<float>::infinity();

/// Where vertices are to be added; see refineAdaptively.
struct RefineArguments {
    float maxError = 0.0f;       ///< 0: nowhere
    float minEdgeLength = 0.0f;  ///< metres; 0 chooses from the scene
};

/// What `prt bake` and `prt merge` are asked for.
struct BakeArguments {
    std::string scene;
    std::string output;
    std::string stats;
    float maxEdgeLength = 0.0f;  ///< metres; 0 chooses from the scene, or kKeepEdges
    RefineArguments refine;
    MethodArguments method{.byDefault = "float"};
    std::vector<BrdfArgument> brdfs;
    std::vector<std::string> brdfTexts;  ///< the same as they were given
    BakeOptions bake;
    ReaderLimits limits;
};

/// Adds the options that decide what is baked: --transport … --isa.
void addTransportOptions(CLI::App& command, BakeArguments& arguments);

/// Checks that they make sense together, once a command line is read.
///
/// @param command  that was given the options
/// @throws CLI::ValidationError
void checkTransportOptions(const CLI::App& command, const BakeOptions& bake);

/// Adds those that any bake of the same transport may choose anew: --method … --stats.
void addRunOptions(CLI::App& command, BakeArguments& arguments);

/// What decides the bits of a bake beside the options of bakeTransfer. The
/// edge length must have been chosen.
///
/// @param brdfs  of a BakeReflection
std::vector<Setting> callerSettings(const BakeArguments& arguments, const std::string& brdfs);

/// Asks for what the checkpoint in a folder was begun with. @throws Error  as readFolderSettings
void adoptFolderSettings(const std::filesystem::path& folder, BakeArguments& arguments);

/// The options that decide the result, so that the same scene and this command make the same asset.
Provenance makeProvenance(const BakeArguments& arguments, const BakeStats& stats);

}  // namespace prt::cli

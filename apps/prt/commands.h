#pragma once

#include <CLI/CLI.hpp>

namespace prt::cli {

/// Each adds one subcommand with its options; parsing the command line then runs it. A subcommand
/// that cannot do its work throws prt::Error, or CLI::ParseError for wrong usage.
void addBakeCommand(CLI::App& app);
void addMergeCommand(CLI::App& app);
void addCompressCommand(CLI::App& app);
void addLightCommand(CLI::App& app);
void addBrdfCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addExportCommand(CLI::App& app);
void addWebCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addViewCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addCheckCommand(CLI::App& app);
void addSceneCommand(CLI::App& app);

}  // namespace prt::cli

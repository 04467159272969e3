#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/viewer/view_state.h"

namespace prt::viewer {

/// A view as JSON, with all its values; files are named as the view names them.
std::string formatView(const ViewState& view);

/// The reverse. What is not said is as ViewState has it.
///
/// @param where   how to call the text in an error
/// @throws Error  malformed: no JSON, a name that views do not have, a value that does not fit
ViewState parseView(const std::string& text, const std::string& where);

void saveView(const std::filesystem::path& path, const ViewState& view);
ViewState loadView(const std::filesystem::path& path);

/// One step of a scripted run: the view is changed, drawn, and a picture taken.
struct ScriptStep {
    std::string patch{};       ///< JSON; of the view [Hoffman14]
    std::string screenshot{};  ///< .png or .exr; empty for none
};

/// Reads a script: a JSON array of objects {"view": patch, "screenshot": file}, both optional.
///
/// @throws Error  as parseView
std::vector<ScriptStep> loadScript(const std::filesystem::path& path);

/// @throws Error  as parseView
ViewState applyPatch(const ViewState& view, const std::string& patch, const std::string& where);

}  // namespace prt::viewer

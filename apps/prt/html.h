#pragma once

#include <span>
#include <string>
#include <string_view>

#include "prt/image/image.h"

namespace prt::cli {

/// Text that cannot be mistaken for tags.
std::string escapeHtml(std::string_view text);

/// A picture of the report's folder that opens when clicked, and what it shows.
///
/// @param name     without ".png"
/// @param caption  HTML
std::string formatFigure(const std::string& name, const std::string& caption);

/// What the colours of a false-colour picture stand for, from low to high.
std::string formatLegend(std::span<const Rgba8> colors, const std::string& low,
                         const std::string& high);

/// A number to be seen first, and what it means.
std::string formatCard(const std::string& number, const std::string& title,
                       const std::string& meaning);

/// A whole page that needs no network.
///
/// @param title         text
/// @param introduction  HTML, a sentence or two
/// @param body          HTML
std::string formatPage(const std::string& title, const std::string& introduction,
                       const std::string& body);

}  // namespace prt::cli

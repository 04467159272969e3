#pragma once

#include <string_view>

namespace prt::cli {

/// The page that `prt web` fills in, made of web/page when prt is built; empty where there was no
/// Node.js then (cmake/EmbedPage.cmake).
extern const std::string_view kPageTemplate;

/// Where assets and lights go in it.
inline constexpr std::string_view kPageDataMark = "<!-- prt web: assets and lights -->";

}  // namespace prt::cli

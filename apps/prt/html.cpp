#include "apps/prt/html.h"

#include <fmt/format.h>

#include "apps/prt/report_style.h"

namespace prt::cli {

std::string escapeHtml(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '&')
            escaped += "&amp;";
        else if (letter == '<')
            escaped += "&lt;";
        else if (letter == '>')
            escaped += "&gt;";
        else if (letter == '"')
            escaped += "&quot;";
        else
            escaped += letter;
    }
    return escaped;
}

std::string formatFigure(const std::string& name, const std::string& caption) {
    return fmt::format(
        "<figure><a href=\"{0}.png\"><img src=\"{0}.png\" alt=\"\"></a><figcaption>{1}"
        "</figcaption></figure>\n",
        name, caption);
}

std::string formatLegend(std::span<const Rgba8> colors, const std::string& low,
                         const std::string& high) {
    std::string stops;
    for (const Rgba8& color : colors)
        stops += fmt::format(", rgb({} {} {})", color.red, color.green, color.blue);
    return fmt::format(
        "<div class=\"legend\">{}<div style=\"background: linear-gradient(to "
        "right{})\"></div>{}</div>"
        "\n",
        low, stops, high);
}

std::string formatCard(const std::string& number, const std::string& title,
                       const std::string& meaning) {
    return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span><p>{}</p></div>\n", number,
                       title, meaning);
}

std::string formatPage(const std::string& title, const std::string& introduction,
                       const std::string& body) {
    return fmt::format(R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}</title>
<style>{1}</style>
<h1>{0}</h1>
<p class="soft">{2}</p>
{3}<script>{4}</script>
</html>
)",
                       escapeHtml(title), kReportStyle, introduction, body, kReportScript);
}

}  // namespace prt::cli

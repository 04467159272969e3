#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/compress_report.h"
#include "apps/prt/html.h"
#include "apps/prt/plot.h"
#include "prt/image/false_color.h"

namespace prt::cli {
namespace {

// On a plot and in a table, what is less than this counts as nothing.
constexpr double kLeastError = 1e-7;

std::string formatError(double part) {
    return part < kLeastError ? "none" : fmt::format("{:.2g} %", 100.0 * part);
}

std::string formatMilliseconds(double seconds) {
    return fmt::format("{:.3g} ms", 1e3 * seconds);
}

std::string formatCards(const CompressReport& report) {
    const double floatBytes = static_cast<double>(report.dimension * sizeof(float));
    const CompressionTrial& chosen = report.chosen;
    return "<div class=\"cards\">\n" +
           formatCard(
               fmt::format("{:.3g} bytes", chosen.bytes), "a vertex",
               fmt::format("Instead of {:g} as floats: {:.3g} in attributes, and {:.2g} for "
                           "what all vertices share.",
                           floatBytes, chosen.bytes - chosen.sharedBytes, chosen.sharedBytes)) +
           formatCard(formatError(report.relitRmse), "error of the relit vertices",
                      "Root mean square of the radiance's error under this light, over the mean "
                      "radiance.") +
           formatCard(formatDecibels(report.psnr), "the picture",
                      "Peak signal-to-noise ratio of the two pictures below. Above 40 dB they look "
                      "alike.") +
           "</div>\n";
}

std::string formatPictures(const CompressReport& report) {
    const float scale = vertexErrorScale(report);
    std::string html = fmt::format(
        R"(<h2>The same picture</h2>
<div class="slider"><img src="{0}.png" alt="original"><img class="over" src="{1}.png" alt="compressed"><i></i>
<u>compressed</u><u>original</u><input type="range" min="0" max="100" step="0.1"
 aria-label="how much of the compressed picture to show"></div>
<p class="soft">Drag over the picture. Under <code>{2}</code>, exposed by {3:+.2f} stops.</p>
<h2>Where it errs</h2>
<div class="pictures two">
)",
        kOriginalTransfer, kCompressedTransfer, escapeHtml(report.lightName), report.exposureStops);
    html += formatFigure(kVertexErrors, "<b>The error of each vertex</b> under this light");
    std::string rows;
    for (const WorstVertex& vertex : report.worst)
        rows += fmt::format("<tr><td>{}</td><td>{:.4g}, {:.4g}, {:.4g}</td><td>{}</td></tr>\n",
                            vertex.vertex, vertex.position.x, vertex.position.y, vertex.position.z,
                            formatError(vertex.error));
    html +=
        "<div class=\"scroll\"><table><tr><th>worst vertices</th><th>at, in "
        "metres</th><th>error</th></tr>\n" +
        rows + "</table></div></div>\n";
    return html + formatLegend(unitColors(), "0",
                               formatPercent(static_cast<double>(scale)) + " of the mean radiance");
}

std::string formatPlot(const CompressReport& report) {
    std::vector<PlotSeries> series;
    const auto add = [&](const std::string& family, const CompressionTrial& trial,
                         const std::string& label) {
        if (trial.error.seen < kLeastError) return;
        if (series.empty() || series.back().name != family) series.push_back({family, {}});
        series.back().points.push_back({trial.bytes, 100.0 * trial.error.seen,
                                        fmt::format("{}: {:.3g} bytes a vertex, {}", label,
                                                    trial.bytes, formatError(trial.error.seen))});
    };
    for (const CompressionTrial& trial : report.trials)
        add(trial.family, trial, trial.options);
    add("this asset", report.chosen, "this asset");
    if (report.chosen.error.seen >= kLeastError) series.back().isMarked = true;
    if (series.empty()) return "<p>Every method reproduces this transfer.</p>\n";
    return drawLogPlot(series, "bytes a vertex, of attributes and of what vertices share",
                       "error as seen, % of the mean radiance");
}

std::string formatTrialRow(const CompressionTrial& trial, const std::string& name) {
    return fmt::format(
        "<tr><td style=\"white-space:nowrap\">{}</td><td>{:.3g}</td><td>{:.2g}</td><td>{:.3g}</td>"
        "<td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
        name, trial.bytes - trial.sharedBytes, trial.sharedBytes, trial.bytes,
        formatError(trial.error.relativeRmse), formatError(trial.error.seen),
        trial.compressSeconds > 0.0 ? fmt::format("{:.2f} s", trial.compressSeconds) : "",
        formatMilliseconds(trial.relightSeconds),
        formatCount(static_cast<std::uint64_t>(1.0 / std::max(trial.relightSeconds, 1e-9))));
}

std::string formatMethods(const CompressReport& report) {
    std::string rows = formatTrialRow(report.chosen, "<b>this asset</b>");
    for (const CompressionTrial& trial : report.trials)
        rows += formatTrialRow(trial, "<code>" + escapeHtml(trial.options) + "</code>");
    return "<h2>What every method costs</h2>\n<p class=\"soft\">The error as it is seen: the root "
           "mean square of the radiance's error over all vertices, with the light turned at "
           "random, "
           "over the mean radiance. Point at a dot for its options.</p>\n" +
           formatPlot(report) +
           "<p></p><div class=\"scroll\"><table><tr><th>method</th><th>bytes a vertex</th>"
           "<th>shared, a vertex</th><th>in all</th><th>error of the transfer</th><th>error as "
           "seen</th><th>to compress</th><th>to relight, one core</th><th>a second</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string formatFewVectors(const CompressReport& report) {
    const double floatBytes =
        static_cast<double>(report.vertexCount * report.dimension * sizeof(float));
    std::string html = fmt::format(
        "<h2>64 clusters and few vectors</h2>\n<p class=\"soft\">The comparison of Kautz's notes "
        "on "
        "real-time PRT, there with 10 bands, here with {}: how many vectors, the mean of a cluster "
        "counted, it takes until nobody sees the difference. Sizes as published, with weights as "
        "floats and a byte for the cluster.</p>\n<div class=\"pictures two\">\n",
        report.bandCount);
    html += formatFigure(kOriginalTransfer,
                         fmt::format("<b>All {} numbers</b>: {}", report.dimension,
                                     formatBytes(static_cast<std::uint64_t>(floatBytes))));
    std::string rows;
    for (const FewVectorsTrial& trial : report.fewVectors) {
        html += formatFigure(fewVectorsPicture(trial.vectorCount),
                             fmt::format("<b>{} vectors</b>: {}, {}", trial.vectorCount,
                                         formatBytes(trial.bytes), formatDecibels(trial.psnr)));
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.1f} ×</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            trial.vectorCount, formatBytes(trial.bytes),
            floatBytes / static_cast<double>(trial.bytes), formatDecibels(trial.psnr),
            formatError(trial.error.relativeRmse), formatError(trial.error.seen));
    }
    return html +
           "</div>\n<p></p><div class=\"scroll\"><table><tr><th>vectors</th><th>size</th><th>"
           "smaller</th><th>PSNR</th><th>error of the transfer</th><th>error as seen</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string formatFacts(const CompressReport& report) {
    return fmt::format(
        "<h2>How it was made</h2>\n<dl>\n<dt>asset</dt><dd><code>{}</code>, of <code>{}</code>: "
        "{}, "
        "{} transport, {} bands, {} numbers a vertex</dd>\n<dt>this page</dt><dd><code>{}</code>; "
        "numbers in <a "
        "href=\"compression.json\">compression.json</a></dd>\n</dl>\n",
        escapeHtml(report.asset), escapeHtml(report.source),
        formatCount(report.vertexCount, "vertex"), transportName(report.transport),
        report.bandCount, report.dimension, escapeHtml(report.command));
}

}  // namespace

std::string formatCompressPage(const CompressReport& report) {
    const std::string asset = std::filesystem::path(report.asset).filename().string();
    return formatPage(asset + ", compressed",
                      "What storing the transfer in fewer bytes costs: the asset that was written, "
                      "held against the one it was made from, and against every other method.",
                      formatCards(report) + formatPictures(report) + formatMethods(report) +
                          formatFewVectors(report) + formatFacts(report));
}

}  // namespace prt::cli

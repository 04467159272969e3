#include <algorithm>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/html.h"
#include "apps/prt/report.h"
#include "prt/image/false_color.h"

namespace prt::cli {
namespace {

// ── Numbers ──────────────────────────────────────────────────────────────────────────────────────

std::string formatRadiance(double radiance) {
    return fmt::format("{:.3g}", radiance);
}

/// What is left without noise, or what it is below where the noise hides it.
std::string formatExcess(const NoisyError& error) {
    if (error.isSignificant()) return formatRadiance(error.rmseWithoutNoise());
    return "&lt; " + formatRadiance(error.largestRmseWithoutNoise());
}

std::string formatRelativeExcess(const NoisyError& error) {
    if (error.isSignificant()) return formatPercent(error.relative(error.rmseWithoutNoise()));
    return "&lt; " + formatPercent(error.relative(error.largestRmseWithoutNoise()));
}

/// How far the lighting's bands, or all of the light, are from what was relit.
std::string formatRow(const std::string& name, const PictureComparison& comparison,
                      const std::string& more = {}) {
    const NoisyError& error = comparison.error;
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.4f}</td>{}"
        "</tr>\n",
        name, formatRadiance(error.error.rmse), formatRadiance(error.noiseRmse),
        formatExcess(error), formatRelativeExcess(error), formatDecibels(comparison.psnr),
        comparison.meanFlip, more);
}

constexpr const char* kErrorHeads =
    "<th>RMSE</th><th>noise of the truth</th><th>RMSE less noise</th><th>relative</th>"
    "<th>PSNR</th><th>FLIP</th>";

std::string nameReference(const ReportLight& light, bool inBands) {
    return inBands ? fmt::format("the light in {} bands", light.bandCount)
                   : std::string("the light itself");
}

// ── Pictures ─────────────────────────────────────────────────────────────────────────────────────

std::string formatSlider(std::size_t index, const ReportLight& light) {
    const std::string relit = pictureName(index, kRelit);
    const std::string itself = pictureName(index, kItself);
    const std::string sameBands = pictureName(index, kSameBands);
    return fmt::format(
        R"(<div class="slider"><img id="truth{0}" src="{2}.png" alt="path-traced"><img class="over"
 src="{1}.png" alt="relit"><i></i><u>relit</u><u>path-traced</u><input type="range" min="0" max="100" step="0.1"
 aria-label="how much of the relit picture to show"></div>
<div class="choice"><span class="soft">Drag over the picture. The truth beside it is under</span>
<label><input type="radio" name="truth{0}" value="{2}.png" checked> {4}</label>
<label><input type="radio" name="truth{0}" value="{3}.png"> {5}</label></div>
)",
        index, relit, itself, sameBands, nameReference(light, false), nameReference(light, true));
}

std::string formatPictures(std::size_t index, const ReportLight& light) {
    const float scale = differenceScale(light);
    std::string html = "<h3>Side by side</h3>\n<div class=\"pictures\">\n";
    html += formatFigure(pictureName(index, kRelit), "<b>Relit</b> from the asset");
    html += formatFigure(pictureName(index, kSameBands),
                         fmt::format("<b>Path-traced</b> under {}", nameReference(light, true)));
    html += formatFigure(pictureName(index, kItself),
                         fmt::format("<b>Path-traced</b> under {}", nameReference(light, false)));
    if (light.relitInBands)
        html += formatFigure(pictureName(index, kRelitInBands),
                             fmt::format("<b>Relit</b>, mirrors showing {}, as it is held against "
                                         "path tracing under that",
                                         nameReference(light, true)));
    html += "</div>\n<h3>What differs</h3>\n<div class=\"pictures two\">\n";
    for (const bool inBands : {true, false}) {
        const std::string name = pictureName(index, inBands ? kSameBands : kItself);
        html +=
            formatFigure(name + "-difference",
                         fmt::format("<b>Relit less path-traced</b> under {}: red is too bright, "
                                     "blue too dark",
                                     nameReference(light, inBands)));
        html +=
            formatFigure(name + "-flip", fmt::format("<b>FLIP</b>, what a person sees who flips "
                                                     "between the two, under {}",
                                                     nameReference(light, inBands)));
    }
    html += "</div>\n";
    html += formatLegend(
        signedColors(), fmt::format("−{:.3g}", scale),
        fmt::format("+{:.3g} of luminance, a quarter of the truth's root mean square", scale));
    html += formatLegend(unitColors(), "0", "1 FLIP, from no difference to black against white");
    return html;
}

// ── Sections ─────────────────────────────────────────────────────────────────────────────────────

std::string formatCards(const ReportLight& light) {
    const NoisyError& bake = light.sameBands.comparison.error;
    const NoisyError& all = light.itself.comparison.error;
    return "<div class=\"cards\">\n" +
           formatCard(
               formatRelativeExcess(bake), "error of the bake",
               fmt::format("Against path tracing under the light in the same {} bands: what the "
                           "rays of the bake, interpolation between vertices and storage cost.",
                           light.bandCount)) +
           formatCard(
               formatRelativeExcess(all), "error of bake and bands",
               fmt::format("Against path tracing under the light itself: what it costs as well "
                           "to have only {} bands of it.",
                           light.bandCount)) +
           formatCard(
               formatPercent(bake.relative(bake.noiseRmse)), "noise of the truth",
               "What is left of the randomness of paths in the first reference. It is taken out "
               "of the two errors.") +
           "</div>\n";
}

std::string formatErrors(const ReportLight& light) {
    std::string rows;
    for (const bool inBands : {true, false}) {
        const JudgedReference& reference = inBands ? light.sameBands : light.itself;
        const NoisyError& vertices = reference.atVertices;
        rows += formatRow("against " + nameReference(light, inBands), reference.comparison,
                          fmt::format("<td>{}</td><td>{}</td>", formatExcess(vertices),
                                      formatRelativeExcess(vertices)));
    }
    return fmt::format(
        "<h3>Numbers</h3>\n<div class=\"scroll\"><table><tr><th></th>{}<th>RMSE at vertices</th>"
        "<th>relative</th></tr>\n{}</table></div>\n",
        kErrorHeads, rows);
}

std::string formatMaterials(const Report& report, const ReportLight& light) {
    if (report.materials.empty()) return {};
    std::string rows;
    for (std::size_t i = 0; i < light.sameBands.byMaterial.size(); ++i) {
        const MaterialError& inBands = light.sameBands.byMaterial[i];
        const MaterialError& itself = light.itself.byMaterial[i];
        const ReportMaterial& material = report.materials[inBands.material];
        const std::string surface =
            material.isReplaced
                ? "<td colspan=\"2\">another BRDF</td>"
                : fmt::format("<td>{0:.2g}{2}</td><td>{1:.2g}{2}</td>", material.surface.roughness,
                              material.surface.metallic, material.isTextured ? " × texture" : "");
        rows +=
            fmt::format("<tr><td>{}</td>{}<td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escapeHtml(material.name), surface, formatCount(inBands.pixelCount),
                        formatRelativeExcess(inBands.error), formatRelativeExcess(itself.error));
    }
    return fmt::format(
        "<h3>Material by material</h3>\n<p class=\"soft\">The relative RMSE over the pixels that "
        "show one material and nothing else; the noise of the truth is taken out.</p>\n<div "
        "class=\"scroll\"><table><tr><th></th><th>roughness</th><th>metallic</th><th>pixels</th>"
        "<th>under {}</th><th>under {}</th></tr>\n{}</table></div>\n",
        nameReference(light, true), nameReference(light, false), rows);
}

std::string formatTransports(std::size_t index, const ReportLight& light) {
    if (light.byTransport.empty()) return {};
    std::string pictures, rows;
    for (const auto& [transport, judged] : light.byTransport) {
        const std::string name(shownTransportName(transport));
        pictures += formatFigure(
            pictureName(index, name),
            fmt::format("<b>{}</b>, {} off", name, formatRelativeExcess(judged.comparison.error)));
        rows += formatRow(name, judged.comparison);
    }
    return fmt::format(
        "<h3>What each kind of transport is worth</h3>\n<p class=\"soft\">The same "
        "asset with ever more of its transport, each against path tracing under {}."
        "</p>\n<div class=\"pictures\">\n{}</div>\n<p></p>\n<div "
        "class=\"scroll\"><table><tr><th></th>{}"
        "</tr>\n{}</table></div>\n",
        nameReference(light, true), pictures, kErrorHeads, rows);
}

std::string formatLight(const Report& report, std::size_t index) {
    const ReportLight& light = report.lights[index];
    return fmt::format("<h2>Light: <code>{}</code></h2>\n", escapeHtml(light.name)) +
           formatCards(light) + formatSlider(index, light) + formatPictures(index, light) +
           formatErrors(light) + formatMaterials(report, light) + formatTransports(index, light);
}

/// Lights down, bands across, the truth at the end: how sharp a light each number of bands can
/// hold.
std::string formatBandTable(const Report& report) {
    if (report.lights.front().byBandCount.empty()) return {};
    std::string html =
        "<h2>How many bands a light needs</h2>\n<p class=\"soft\">Relit with ever more bands of "
        "each light. The number is the relative RMSE against path tracing under the light itself, "
        "which stands last; its noise is taken out.</p>\n<div class=\"scroll\"><table "
        "class=\"matrix\"><tr><th></th>";
    for (const auto& [bandCount, judged] : report.lights.front().byBandCount)
        html += fmt::format("<td>{} {}</td>", bandCount, bandCount == 1 ? "band" : "bands");
    html += "<td>truth</td></tr>\n";
    const auto cell = [](const std::string& name, const std::string& caption) {
        return fmt::format("<td><a href=\"{0}.png\"><img src=\"{0}.png\" alt=\"\"></a>{1}</td>",
                           name, caption);
    };
    for (std::size_t i = 0; i < report.lights.size(); ++i) {
        html += fmt::format("<tr><td><code>{}</code></td>", escapeHtml(report.lights[i].name));
        for (const auto& [bandCount, judged] : report.lights[i].byBandCount)
            html += cell(pictureName(i, bandPictureKind(bandCount)),
                         formatRelativeExcess(judged.comparison.error));
        html += cell(pictureName(i, kItself), "path-traced") + "</tr>\n";
    }
    return html + "</table></div>\n";
}

constexpr const char* kHowToRead = R"(<h2>How to read the numbers</h2>
<dl>
<dt>RMSE</dt><dd>The root of the mean squared difference of radiance, over all pixels and channels, in W·sr⁻¹·m⁻².
 Pixels where no surface is seen agree.</dd>
<dt>noise of the truth</dt><dd>The RMSE that the path-traced picture has by chance alone, from the variance of its paths.
 More <code>--reference-samples</code> make it smaller, by 2 for 4 times as many.</dd>
<dt>RMSE less noise</dt><dd>√(RMSE² − noise²), the fault of the asset. Where the noise may
 explain it all, “&lt;” and the most that it may be, by two standard deviations.</dd>
<dt>relative</dt><dd>That, over the root mean square of the truth: 1 % is hard to see, 10 % is plain.</dd>
<dt>PSNR</dt><dd>Of the 8-bit pictures, noise included. Above 40 dB they look alike; each 6 dB less is twice the error.</dd>
<dt>FLIP</dt><dd>The mean of the FLIP map, noise included: 0 if nobody could tell the pictures apart, 1 for black against white,
 on a screen of 67 pixels a degree.</dd>
<dt>RMSE at vertices</dt><dd>The same for the light that arrives at vertices, before the surface's colour. There nothing is
 interpolated: what is more in the picture than here is for want of smaller triangles.</dd>
</dl>
)";

std::string formatFacts(const Report& report) {
    const auto fact = [](std::string_view name, const std::string& value) {
        return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
    };
    std::string times;
    for (const auto& [stage, seconds] : report.seconds)
        times += fmt::format("{}{} {:.2f} s", times.empty() ? "" : " · ", stage, seconds);
    const Provenance& provenance = report.provenance;
    return "<h2>How it was made</h2>\n<dl>\n" +
           fact("asset",
                fmt::format("<code>{}</code>: {}, {}; {}, {} a vertex as shown",
                            escapeHtml(report.asset), formatCount(report.vertexCount, "vertex"),
                            formatCount(report.triangleCount, "triangle"),
                            formatBytes(report.assetBytes),
                            formatCount(report.bytesPerVertex, "byte"))) +
           fact("baked with",
                fmt::format(
                    "<code>{}</code>, by {}; {} made", escapeHtml(provenance.command),
                    escapeHtml(provenance.generator),
                    formatCount(static_cast<std::uint64_t>(provenance.bounceCount), "bounce"))) +
           fact("shown",
                fmt::format("{} transport; exposure {:+g} stops, tone curve {}",
                            shownTransportName(report.transport), report.display.exposureStops,
                            toneCurveName(report.display.toneCurve))) +
           fact("truth",
                fmt::format(
                    "{} paths a pixel, {}",
                    formatCount(static_cast<std::uint64_t>(report.referenceSamples)),
                    report.bounceCount == kUnlimitedBounces
                        ? "bounces without end"
                        : formatCount(static_cast<std::uint64_t>(report.bounceCount), "bounce"))) +
           fact("times", times) +
           fact("this page", fmt::format("<code>{}</code>; numbers in <a href=\"comparison.json\">"
                                         "comparison.json</a>, radiance in the .exr files",
                                         escapeHtml(report.command))) +
           "</dl>\n";
}

}  // namespace

std::string formatReportPage(const Report& report) {
    std::string lights;
    for (std::size_t i = 0; i < report.lights.size(); ++i)
        lights += formatLight(report, i);
    const std::string asset = std::filesystem::path(report.asset).filename().string();
    return formatPage(
        asset + " against the truth",
        "What the baked asset shows when it is relit, held against pictures by a path tracer, "
        "which "
        "knows no bands and no vertices. Both look along the same rays, so only light can differ.",
        formatBandTable(report) + lights + kHowToRead + formatFacts(report));
}

}  // namespace prt::cli

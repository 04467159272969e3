#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/html.h"
#include "apps/prt/light_report.h"
#include "prt/image/false_color.h"
#include "prt/image/tone_curve.h"

namespace prt::cli {
namespace {

std::string formatTriple(const Vec3d& value) {
    return fmt::format("{:.4g}, {:.4g}, {:.4g}", value.x, value.y, value.z);
}

std::string formatBands(int bandCount) {
    return formatCount(static_cast<std::uint64_t>(bandCount), "band");
}

std::string formatNumber(int bandCount) {
    return formatCount(static_cast<std::uint64_t>(shCoefficientCount(bandCount)), "number");
}

// ── The light, and what bands hold of it ─────────────────────────────────────────────────────────

std::string formatCards(const LightReport& report, const LightFindings& findings) {
    const int bandCount = report.printed.bandCount;
    const BandFinding* held =
        findings.bands.empty() ? nullptr : &findings.bands[static_cast<std::size_t>(bandCount - 1)];
    return "<div class=\"cards\">\n" +
           formatCard(held ? formatPercent(held->error) : "none",
                      fmt::format("missing in {}", formatBands(bandCount)),
                      "Relative root mean square of the radiance that these bands do not hold, "
                      "before any window.") +
           formatCard(held ? fmt::format("{:.2g} ×", -std::min(held->lowestRadiance, 0.0)) : "none",
                      "below zero",
                      "How far the same bands ring into negative light, in units of the mean "
                      "radiance.") +
           formatCard(formatPercent(findings.irradiance[2].mean), "error of diffuse light",
                      "Mean error of irradiance from nine coefficients, as a part of the largest "
                      "irradiance.") +
           "</div>\n";
}

std::string formatReconstructions(const LightFindings& findings) {
    std::string html =
        "<h2>In ever more bands</h2>\n<p class=\"soft\">What n bands of spherical harmonics hold "
        "of "
        "the light, all pictures under the same exposure; black where radiance is below 0.</p>\n"
        "<div class=\"pictures\">\n" +
        formatFigure(kOriginalPicture, "<b>The light itself</b>");
    for (const int bandCount : kPicturedBandCounts) {
        std::string error;
        if (!findings.bands.empty())
            error = fmt::format(
                ": {} missing",
                formatPercent(findings.bands[static_cast<std::size_t>(bandCount - 1)].error));
        html += formatFigure(bandsPicture(bandCount),
                             fmt::format("<b>{}</b>, {} a channel{}", formatBands(bandCount),
                                         formatNumber(bandCount), error));
    }
    return html + "</div>\n";
}

std::string formatWavelets(const LightFindings& findings) {
    std::string html =
        "<h2>In wavelets instead</h2>\n<p class=\"soft\">The largest of the 24,576 Haar wavelets "
        "of "
        "a cube of 64 × 64 texels a face, chosen for this light. 100 numbers are as many as 10 "
        "bands "
        "have, 1,024 as many as 32. They keep small lights sharp and leave the dark coarse.</p>\n"
        "<div class=\"pictures\">\n";
    for (std::size_t k = 0; k < std::size(kPicturedWaveletCounts); ++k)
        html += formatFigure(waveletsPicture(kPicturedWaveletCounts[k]),
                             fmt::format("<b>{}</b> a channel: {} missing",
                                         formatCount(kPicturedWaveletCounts[k], "wavelet"),
                                         formatPercent(findings.waveletErrors[k])));
    return html + "</div>\n";
}

/// Bars on a logarithmic scale, from 1e-6 to 1.
std::string drawEnergyBars(const std::vector<BandFinding>& bands) {
    constexpr int kBarWidth = 30, kHeight = 220, kTop = 10, kLeft = 60;
    constexpr double kDecades = 6.0;
    const int width = kLeft + kBarWidth * static_cast<int>(bands.size()) + 10;
    const auto yOf = [](double energy) {
        const double decades = -std::log10(std::max(energy, 1e-30));
        return kTop + kHeight * std::min(decades / kDecades, 1.0);
    };
    std::string svg = fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"energy by degree\" "
        "style=\"width:100%;background:var(--card);border:1px solid "
        "var(--line);border-radius:10px\" font-size=\"12\" fill=\"#5c6675\">\n",
        width, kHeight + kTop + 40);
    for (int decade = 0; decade <= static_cast<int>(kDecades); ++decade) {
        const double y = yOf(std::pow(10.0, -decade));
        svg += fmt::format(
            "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#dfe3ea\"/>"
            "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
            kLeft, width - 10, y, kLeft - 8, y + 4,
            decade == 0 ? std::string("1") : fmt::format("1e-{}", decade));
    }
    for (std::size_t k = 0; k < bands.size(); ++k) {
        const double y = yOf(bands[k].energy);
        const int x = kLeft + kBarWidth * static_cast<int>(k);
        svg += fmt::format(
            "<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"#1f6feb\">"
            "<title>degree {}: {:.3g} of the energy</title></rect>"
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
            x + 3, y, kBarWidth - 6, kTop + kHeight - y, k, bands[k].energy, x + kBarWidth / 2,
            kTop + kHeight + 18, k);
    }
    return svg + "</svg>\n";
}

std::string formatEnergy(const LightFindings& findings) {
    if (findings.bands.empty()) return {};
    std::string rows;
    double held = 0.0;
    for (const BandFinding& band : findings.bands) {
        held += band.energy;
        if (std::find(std::begin(kPicturedBandCounts), std::end(kPicturedBandCounts),
                      band.bandCount) == std::end(kPicturedBandCounts) &&
            band.bandCount > 10)
            continue;
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.3g}</td><td>{}</td><td>{}</td><td>{:.3f}</td></tr>\n",
            band.bandCount, shCoefficientCount(band.bandCount), band.energy, formatPercent(held),
            formatPercent(band.error), band.lowestRadiance);
    }
    return "<h2>Energy by degree</h2>\n<p class=\"soft\">Σ<sub>m</sub> |L<sub>lm</sub>|² over "
           "∫ |L|² dω. A light whose energy falls slowly is small or sharp, and wants many "
           "bands.</p>\n" +
           drawEnergyBars(findings.bands) +
           "<p></p><div class=\"scroll\"><table><tr><th>bands</th><th>coefficients</th><th>energy "
           "of "
           "the last degree</th><th>held</th><th>relative RMS missing</th><th>lowest radiance / "
           "mean</th></tr>\n" +
           rows + "</table></div>\n";
}

// ── Ringing ──────────────────────────────────────────────────────────────────────────────────────

std::string formatRinging(const LightReport& report, const LightFindings& findings) {
    std::string rows;
    for (const RingingFinding& row : findings.ringing)
        rows += fmt::format(
            "<tr><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td>"
            "<td>{:.3f}</td></tr>\n",
            row.bandCount, row.plain, row.hann, row.lanczos, row.automatic + 0.0, row.lastFactor);
    const std::string bands = formatBands(report.printed.bandCount);
    return "<h2>Ringing</h2>\n<p class=\"soft\">A sharp light in few bands overshoots and goes "
           "below "
           "zero. A window lowers the higher bands; the automatic one just so much that nothing is "
           "negative in any channel, with the mean and the hue kept. Radiance over the mean "
           "radiance.</p>\n<div class=\"pictures two\">\n" +
           formatFigure(kPlainSigns, fmt::format("<b>{} as they are</b>", bands)) +
           formatFigure(kPrintedSigns,
                        fmt::format("<b>{} under the window “{}”</b>, which was asked for", bands,
                                    escapeHtml(report.window))) +
           "</div>\n" +
           formatLegend(signedColors(), "−1 mean",
                        "+1 mean: red is light, blue is negative light") +
           "<div class=\"scroll\"><table><tr><th>bands</th><th>lowest, no window</th><th>Hann</th>"
           "<th>Lanczos</th><th>automatic</th><th>its factor of the last band</th></tr>\n" +
           rows + "</table></div>\n";
}

// ── What it lights ───────────────────────────────────────────────────────────────────────────────

std::string formatSpheres(const LightReport& report) {
    std::string html =
        "<h2>What it lights</h2>\n<p class=\"soft\">A mirror and white diffuse spheres, seen along "
        "−z with +y up.</p>\n<div class=\"pictures\">\n" +
        formatFigure(kMirrorSphere, "<b>Mirror</b>: the light itself") +
        formatFigure(kExactSphere, fmt::format("<b>Diffuse</b>, {}", formatBands(kMaxBandCount)));
    for (const int bandCount : {1, 2, 3})
        html += formatFigure(bandsSphere(bandCount),
                             fmt::format("<b>Diffuse, {}</b>", formatBands(bandCount)));
    return html +
           formatFigure(
               kPrintedSphere,
               fmt::format("<b>Diffuse, {}, window “{}”</b>: the coefficients below",
                           formatBands(report.printed.bandCount), escapeHtml(report.window))) +
           "</div>\n";
}

std::string formatIrradiance(const LightFindings& findings) {
    const char* const claims[] = {"25 %", "8 %", "1 %; mean below 3 % of any light", "", ""};
    std::string rows;
    for (std::size_t k = 0; k < findings.irradiance.size(); ++k) {
        const IrradianceError& here = findings.irradiance[k];
        const IrradianceError& worst = findings.worstIrradiance[k];
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td><td>{}</td></tr>\n",
            here.bandCount, shCoefficientCount(here.bandCount), formatPercent(here.mean),
            formatPercent(here.rms), formatPercent(here.largest), formatPercent(worst.mean),
            formatPercent(worst.rms), formatPercent(worst.largest), claims[k]);
    }
    return "<h3>Irradiance</h3>\n<p class=\"soft\">What few bands leave of diffuse light, over all "
           "normals, as a part of the largest irradiance: of this light, and of the worst, which "
           "comes from one direction. Beside them the RMS errors that Ramamoorthi and Hanrahan "
           "found on their probes.</p>\n<div class=\"scroll\"><table><tr><th>bands</th>"
           "<th>coefficients</th><th>mean</th><th>RMS</th><th>largest</th><th>worst light: "
           "mean</th>"
           "<th>RMS</th><th>largest</th><th>published</th></tr>\n" +
           rows + "</table></div>\n";
}

// ── Coefficients ─────────────────────────────────────────────────────────────────────────────────

std::string formatCoefficientTable(const Lighting& lighting) {
    std::string rows;
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i) {
        const int index = static_cast<int>(i), l = shDegree(index);
        const Vec3d& value = lighting.coefficients[i];
        rows += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.6f}</td><td>{:.6f}</td><td>{:.6f}</td>"
            "</tr>\n",
            index, l, index - shIndex(l, 0), value.x + 0.0, value.y + 0.0, value.z + 0.0);
    }
    return "<div class=\"scroll\"><table><tr><th>index</th><th>l</th><th>m</th><th>R</th><th>G</th>"
           "<th>B</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string formatCoefficients(const LightReport& report) {
    std::string html = fmt::format(
        "<h2>Coefficients</h2>\n<p class=\"soft\">{}, window “{}”. Also in <a "
        "href=\"lighting.json\">lighting.json</a>, which every command takes as a light.</p>\n",
        formatBands(report.printed.bandCount), escapeHtml(report.window));
    for (const ShConvention convention : allShConventions()) {
        const int bandCount = std::min(report.printed.bandCount, maxBandCount(convention));
        const Lighting converted = convertTo(convention, truncate(report.printed, bandCount));
        html += fmt::format(
            "<details{}><summary><b>{}</b> <span class=\"soft\">{}: {}</span></summary>\n{}"
            "</details>\n",
            convention == ShConvention::cs ? " open" : "", shConventionName(convention),
            formatBands(bandCount), escapeHtml(describeShConvention(convention)),
            formatCoefficientTable(converted));
    }
    return html;
}

std::string formatFacts(const LightReport& report, const LightFindings& findings) {
    const double mean = luminance(findings.meanRadiance);
    return fmt::format(
        "<h2>The light</h2>\n<dl>\n<dt>mean radiance</dt><dd>{} W·sr⁻¹·m⁻²</dd>\n"
        "<dt>brightest texel</dt><dd>luminance {:.4g}, {:.4g} times the mean</dd>\n"
        "<dt>exposure of the pictures</dt><dd>{:+.2f} stops, so that the bright side of a white "
        "sphere comes to 0.8; ACES tone curve</dd>\n"
        "<dt>this page</dt><dd><code>{}</code></dd>\n</dl>\n",
        formatTriple(findings.meanRadiance), findings.largestLuminance,
        mean > 0.0 ? findings.largestLuminance / mean : 0.0, findings.exposureStops,
        escapeHtml(report.command));
}

}  // namespace

std::string formatLightPage(const LightReport& report, const LightFindings& findings) {
    return formatPage(
        report.name + " as a light",
        "What the light is, what so many bands of spherical harmonics hold of it, and "
        "what that does to the things it lights.",
        formatCards(report, findings) + formatReconstructions(findings) + formatWavelets(findings) +
            formatEnergy(findings) + formatRinging(report, findings) + formatSpheres(report) +
            formatIrradiance(findings) + formatCoefficients(report) +
            formatFacts(report, findings));
}

}  // namespace prt::cli

#include "apps/prt/report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "prt/base/file.h"
#include "prt/image/false_color.h"
#include "prt/io/image_io.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Both forms of a picture: for the screen, and as linear radiance.
void writeBoth(const fs::path& folder, const std::string& name, const Image& radiance,
               const DisplayOptions& display) {
    writePng(folder / (name + ".png"), encodeForDisplay(radiance, display));
    writeExr(folder / (name + ".exr"), radiance);
}

void writeMaps(const fs::path& folder, const std::string& name, const PictureComparison& comparison,
               float scale) {
    writePng(folder / (name + "-difference.png"),
             drawFalseColors(comparison.luminanceChange, -scale, scale, signedColors()));
    writePng(folder / (name + "-flip.png"),
             drawFalseColors(comparison.flip, 0.0f, 1.0f, unitColors()));
}

void writePictures(const fs::path& folder, std::size_t index, const ReportLight& light,
                   const DisplayOptions& display) {
    const float scale = differenceScale(light);
    writeBoth(folder, pictureName(index, kRelit), light.relit, display);
    if (light.relitInBands)
        writeBoth(folder, pictureName(index, kRelitInBands), *light.relitInBands, display);
    writeBoth(folder, pictureName(index, kSameBands), light.sameBands.radiance, display);
    writeBoth(folder, pictureName(index, kItself), light.itself.radiance, display);
    writeMaps(folder, pictureName(index, kSameBands), light.sameBands.comparison, scale);
    writeMaps(folder, pictureName(index, kItself), light.itself.comparison, scale);
    for (const auto& [bandCount, judged] : light.byBandCount)
        writeBoth(folder, pictureName(index, bandPictureKind(bandCount)), judged.picture, display);
    for (const auto& [transport, judged] : light.byTransport)
        writeBoth(folder, pictureName(index, std::string(shownTransportName(transport))),
                  judged.picture, display);
}

Json describeError(const NoisyError& error) {
    return {
        {"rmse", error.error.rmse},
        {"relative_rmse", error.error.relativeRmse},
        {"noise_rmse", error.noiseRmse},
        {"rmse_without_noise", error.rmseWithoutNoise()},
        {"relative_rmse_without_noise", error.relative(error.rmseWithoutNoise())},
        {"largest_relative_rmse_without_noise", error.relative(error.largestRmseWithoutNoise())}};
}

Json describe(const PictureComparison& comparison) {
    Json json = describeError(comparison.error);
    // Equal pictures have no finite PSNR, and JSON no infinity.
    json["psnr_db"] = std::isfinite(comparison.psnr) ? Json(comparison.psnr) : Json();
    json["flip"] = comparison.meanFlip;
    return json;
}

Json describe(const JudgedReference& reference) {
    Json json = describe(reference.comparison);
    json["at_vertices"] = describeError(reference.atVertices);
    json["at_vertices"]["count"] = reference.vertexCount;
    return json;
}

/// A row for each material that is seen.
Json describeMaterials(const Report& report, const ReportLight& light) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < light.sameBands.byMaterial.size(); ++i) {
        const MaterialError& inBands = light.sameBands.byMaterial[i];
        const ReportMaterial& material = report.materials[inBands.material];
        rows.push_back({{"material", material.name},
                        {"metallic", withDigitsOf(material.surface.metallic)},
                        {"roughness", withDigitsOf(material.surface.roughness)},
                        {"textured", material.isTextured},
                        {"replaced", material.isReplaced},
                        {"pixels", inBands.pixelCount},
                        {"against",
                         {{"the_light_in_its_bands", describeError(inBands.error)},
                          {"the_light_itself", describeError(light.itself.byMaterial[i].error)}}}});
    }
    return rows;
}

Json describe(const Report& report, const ReportLight& light) {
    Json json = {{"light", light.name},
                 {"bands", light.bandCount},
                 {"against",
                  {{"the_light_in_its_bands", describe(light.sameBands)},
                   {"the_light_itself", describe(light.itself)}}}};
    if (!report.materials.empty()) json["by_material"] = describeMaterials(report, light);
    for (const auto& [bandCount, judged] : light.byBandCount) {
        Json row = {{"bands", bandCount}};
        row.update(describe(judged.comparison));
        json["by_band_count"].push_back(row);
    }
    for (const auto& [transport, judged] : light.byTransport) {
        Json row = {{"transport", shownTransportName(transport)}};
        row.update(describe(judged.comparison));
        json["by_transport"].push_back(row);
    }
    return json;
}

}  // namespace

std::string pictureName(std::size_t lightIndex, const std::string& kind) {
    return fmt::format("light{}-{}", lightIndex + 1, kind);
}

std::string bandPictureKind(int bandCount) {
    return fmt::format("relit-{}-bands", bandCount);
}

float differenceScale(const ReportLight& light) {
    constexpr double kPartOfBrightness = 0.25;
    double squares = 0.0;
    for (const Vec3f& pixel : light.itself.radiance.pixels)
        squares += std::pow(static_cast<double>(luminance(pixel)), 2);
    const double rootMeanSquare =
        std::sqrt(squares / static_cast<double>(light.itself.radiance.pixels.size()));
    return rootMeanSquare > 0.0 ? static_cast<float>(kPartOfBrightness * rootMeanSquare) : 1.0f;
}

std::string formatReportNumbers(const Report& report) {
    Json json = {{"asset", report.asset},
                 {"baked_with", report.provenance.command},
                 {"transport", shownTransportName(report.transport)},
                 {"vertices", report.vertexCount},
                 {"bytes_per_vertex", report.bytesPerVertex},
                 {"reference_samples", report.referenceSamples},
                 {"bounces",
                  report.bounceCount == kUnlimitedBounces ? Json("inf") : Json(report.bounceCount)},
                 {"lights", Json::array()}};
    for (const ReportLight& light : report.lights)
        json["lights"].push_back(describe(report, light));
    for (const auto& [stage, seconds] : report.seconds)
        json["seconds"][stage] = seconds;
    return json.dump(2) + "\n";
}

void writeReport(const fs::path& folder, const Report& report) {
    for (std::size_t i = 0; i < report.lights.size(); ++i)
        writePictures(folder, i, report.lights[i], report.display);
    writeFileAtomically(folder / "comparison.json", formatReportNumbers(report));
    writeFileAtomically(folder / "index.html", formatReportPage(report));
}

}  // namespace prt::cli

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/picture.h"
#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "apps/prt/brdf_argument.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/lobe_picture.h"
#include "prt/base/file.h"
#include "prt/basis/sh.h"
#include "prt/brdf/band_limit.h"
#include "prt/brdf/tabulate_brdf.h"
#include "prt/io/merl.h"

namespace prt::cli {
namespace {

constexpr std::array kViewDegrees = {0.0, 30.0, 45.0, 60.0, 75.0, 85.0};

struct BrdfCommandArguments {
    std::string spec;
    int bandCount = 5;
    std::optional<int> viewBandCount;
    bool json = false;
    std::string picture;
    std::string merl;
};

/// What is told of a BRDF.
struct BrdfSummary {
    std::vector<Vec3d> albedos;          ///< one a view of kViewDegrees
    std::vector<BandLimitError> errors;  ///< of 1, 2, … bands
    std::optional<double> leastRoughness;
};

/// What is reflected of light 1 from everywhere: f_00 is y_00 times that.
Vec3d measureAlbedo(const Brdf& brdf, double degrees) {
    const double radians = degrees * std::numbers::pi / 180.0;
    const auto response =
        projectBrdfView(brdf, Vec3d(std::sin(radians), 0.0, std::cos(radians)), 1);
    return Vec3d(response[0][0], response[1][0], response[2][0]) * (2.0 / std::numbers::inv_sqrtpi);
}

BrdfSummary summarise(const BrdfSource& source, int bandCount) {
    BrdfSummary summary;
    for (const double degrees : kViewDegrees)
        summary.albedos.push_back(measureAlbedo(source.brdf, degrees));
    for (int n = 1; n <= kMaxBandCount; ++n) {
        stopIfInterrupted();
        summary.errors.push_back(
            measureBandLimitError(source.brdf, {.incidentBandCount = n, .viewBandCount = n}));
    }
    if (source.ggxRoughness) summary.leastRoughness = leastRoughnessHeld(bandCount);
    return summary;
}

void printSummary(const BrdfCommandArguments& arguments, const BrdfSource& source,
                  const BrdfSummary& summary) {
    if (source.negativeCount > 0)
        fmt::print("{} of the file became 0: they could not be measured\n\n",
                   formatCount(source.negativeCount, "value"));
    fmt::print("{:<16} {:>8} {:>8} {:>8}\n", "seen at", "red", "green", "blue");
    for (std::size_t i = 0; i < kViewDegrees.size(); ++i)
        fmt::print("{:<16} {:>8.4f} {:>8.4f} {:>8.4f}\n",
                   fmt::format("{} degrees", kViewDegrees[i]), summary.albedos[i].x,
                   summary.albedos[i].y, summary.albedos[i].z);
    fmt::print("\n{:<16} {:>8} {:>8}\n", "error in bands", "of light", "of both");
    for (std::size_t i = 0; i < summary.errors.size(); ++i)
        fmt::print("{:<16} {:>8} {:>8}\n", i + 1, formatPercent(summary.errors[i].incident),
                   formatPercent(summary.errors[i].matrix));
    if (summary.leastRoughness)
        fmt::print("\nin {} such a lobe is like a mirror below roughness {:.2f}\n",
                   formatCount(static_cast<std::uint64_t>(arguments.bandCount), "band"),
                   *summary.leastRoughness);
}

/// [channel][incident][view]
nlohmann::ordered_json describeMatrices(const Brdf& brdf, const BrdfProjectionOptions& options) {
    const auto columnCount = static_cast<std::ptrdiff_t>(shCoefficientCount(options.viewBandCount));
    auto channels = nlohmann::ordered_json::array();
    for (const BrdfMatrix& matrix : projectBrdf(brdf, options)) {
        const std::vector<double> elements = expandBrdfMatrix(matrix);
        auto rows = nlohmann::ordered_json::array();
        for (auto row = elements.begin(); row != elements.end(); row += columnCount)
            rows.push_back(std::vector<double>(row, row + columnCount));
        channels.push_back(std::move(rows));
    }
    return channels;
}

void printJson(const BrdfCommandArguments& arguments, const BrdfSource& source,
               const BrdfSummary& summary) {
    const BrdfProjectionOptions options{
        .incidentBandCount = arguments.bandCount,
        .viewBandCount = arguments.viewBandCount.value_or(arguments.bandCount)};
    nlohmann::ordered_json json = {{"brdf", arguments.spec}};
    for (std::size_t i = 0; i < kViewDegrees.size(); ++i) {
        const Vec3d& albedo = summary.albedos[i];
        json["albedos"].push_back(
            {{"degrees", kViewDegrees[i]}, {"albedo", {albedo.x, albedo.y, albedo.z}}});
    }
    for (std::size_t i = 0; i < summary.errors.size(); ++i)
        json["errors"].push_back({{"bands", i + 1},
                                  {"light", summary.errors[i].incident},
                                  {"both", summary.errors[i].matrix}});
    if (summary.leastRoughness) json["least_roughness"] = *summary.leastRoughness;
    json["incident_bands"] = options.incidentBandCount;
    json["view_bands"] = options.viewBandCount;
    json["matrix"] = describeMatrices(source.brdf, options);
    fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void runBrdf(const BrdfCommandArguments& arguments) {
    if (!arguments.picture.empty()) requireSuffix(arguments.picture, kPictureSuffixes);
    if (!arguments.merl.empty()) {
        requireSuffix(arguments.merl, ".binary");
        checkWritable(arguments.merl);
    }
    const BrdfSource source = loadBrdf(arguments.spec);
    const BrdfSummary summary = summarise(source, arguments.bandCount);
    if (!arguments.picture.empty()) {
        const Image picture = drawLobe(source.brdf, arguments.bandCount);
        const DeferInterrupts whileWriting;
        writePicture(arguments.picture, picture, {.toneCurve = ToneCurve::none});
    }
    if (!arguments.merl.empty()) {
        const MeasuredBrdf table = tabulateBrdf(source.brdf);
        const DeferInterrupts whileWriting;
        writeMerlBrdf(arguments.merl, table);
    }
    arguments.json ? printJson(arguments, source, summary)
                   : printSummary(arguments, source, summary);
}

constexpr const char* kFooter =
    R"(The table tells what is reflected of light 1 from everywhere, seen at angles to the normal; then
what n bands miss: of a lobe above the horizon, with bands for the light, as relighting has it; and
of the whole matrix of --json, with bands for the light and for the eye.
Examples: prt brdf ggx:1,0.78,0.34,0.4
          prt brdf merl:gold-paint.binary --bands 8 --picture gold-paint.png
          prt brdf gltf:0.8,0.2,0.1,0,0.4 --merl plastic.binary
          prt brdf phong:0.5,0.5,0.5,20 --bands 5 --view-bands 3 --json
)";

}  // namespace

void addBrdfCommand(CLI::App& app) {
    const auto arguments = std::make_shared<BrdfCommandArguments>();
    CLI::App* command =
        app.add_subcommand("brdf", "Show what a material reflects, and what bands make of it");
    command->footer(kFooter + std::string(kBrdfHelp));
    command->add_option("SPEC", arguments->spec, "the material, as below")->required();
    addIntegerOption(*command, "--bands", arguments->bandCount, 1, kMaxBandCount,
                     "of light, in the picture and in JSON; 1 to 10");
    command
        ->add_option("--view-bands", arguments->viewBandCount,
                     "of the eye in the matrix; 1 to 10 [as many]")
        ->check(CLI::Range(1, kMaxBandCount).description(""))
        ->type_name("N");
    command->add_flag("--json", arguments->json,
                      "the same as JSON, with the matrix [channel][light][eye]");
    command
        ->add_option("--picture", arguments->picture,
                     "also draw the lobe of an eye at 45 degrees, as it is and in bands")
        ->type_name("OUT.png|exr");
    command
        ->add_option("--merl", arguments->merl,
                     "also write it as a file of the MERL database, 35 MB")
        ->type_name("OUT.binary");
    command->callback([arguments] { runBrdf(*arguments); });
}

}  // namespace prt::cli

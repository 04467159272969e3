#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/picture.h"
#include "apps/prt/arguments.h"
#include "apps/prt/coefficient_format.h"
#include "apps/prt/commands.h"
#include "apps/prt/environment_output.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_report.h"
#include "apps/prt/light_sum.h"
#include "apps/prt/light_window.h"
#include "apps/prt/staged_folder.h"
#include "prt/base/error.h"

namespace prt::cli {
namespace {

struct LightArguments {
    std::vector<std::string> lights;
    std::string command;  // that would do this again
    int bandCount = 5;
    LightSumOptions sum;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    WindowArguments window;
    ShConvention convention = ShConvention::cs;
    CoefficientFormat format = CoefficientFormat::table;
    std::string reconstruction;
    EnvironmentOutput environment;
    std::string report;
};

std::optional<Vec3d> parseFactor(std::string_view text) {
    if (const std::optional<double> factor = parseNumber(text)) return Vec3d(*factor);
    return parseTriple(text);
}

std::string conventionNames() {
    std::vector<std::string_view> names;
    for (const ShConvention convention : allShConventions())
        names.push_back(shConventionName(convention));
    return fmt::format("{}", fmt::join(names, "|"));
}

/// For --help.
std::string describeConventions() {
    std::string text = "\nCONVENTION is one of\n";
    for (const ShConvention convention : allShConventions())
        text += fmt::format("  {:<9} {}\n", shConventionName(convention),
                            describeShConvention(convention));
    return text;
}

void writeReconstruction(const Lighting& lighting, const std::string& path) {
    constexpr int kWidth = 1024;
    const Image image = reconstructLatLong(lighting, kWidth);
    const DeferInterrupts whileWriting;
    writePicture(path, image);
}

void writeReportFolder(const LightArguments& arguments, const LightSum& sum,
                       const Lighting& printed) {
    constexpr int kPictureHeight = 512;
    std::vector<std::string> names;
    for (const std::string& light : arguments.lights)
        names.push_back(std::filesystem::path(light).filename().string());
    const LightReport report{
        .name = fmt::format("{}", fmt::join(names, " + ")),
        .command = arguments.command,
        .window = describeWindow(arguments.window),
        .picture = drawLights(sum, SphereMap::latLong, kPictureHeight).radiance,
        .lighting = sum.lighting,
        .printed = printed};
    const DeferInterrupts whileWriting;
    StagedFolder folder(arguments.report);
    writeLightReport(folder.path(), report);
    stopIfInterrupted();
    folder.commit();
}

void checkBandCount(int bandCount, int largest, const std::string& option) {
    if (bandCount > largest)
        throw Error(ErrorCode::invalidOption, fmt::format("holds at most {} bands", largest),
                    option, fmt::format("add --bands {}", largest));
}

/// Finds out before the work what would make it fail at its end.
void checkArguments(const LightArguments& arguments) {
    if (!arguments.reconstruction.empty())
        requireSuffix(arguments.reconstruction, kPictureSuffixes);
    checkEnvironmentOutput(arguments.environment);
    checkBandCount(arguments.bandCount, maxBandCount(arguments.convention),
                   fmt::format("--convention {}", shConventionName(arguments.convention)));
    if (arguments.window.window == "auto")
        checkBandCount(arguments.bandCount, kMaxBandCount, "--window auto");
    if (!arguments.report.empty()) {
        checkBandCount(arguments.bandCount, kReportBandCount, "--report");
        const DeferInterrupts whileProbing;
        StagedFolder::check(arguments.report);
    }
    stopIfInterrupted();
}

void runLight(LightArguments arguments) {
    checkArguments(arguments);
    arguments.sum.rotation = rotationFromDegrees(arguments.rotationDegrees);
    const bool reports = !arguments.report.empty();
    const LightSum sum = sumLights(arguments.lights, arguments.sum,
                                   reports ? kReportBandCount : arguments.bandCount);
    for (const DiscLight& sun : sum.suns)
        fmt::print(stderr, "prt: took out {}\n", describeSun(sun));
    if (arguments.sum.withoutSuns && sum.suns.empty())
        fmt::print(stderr, "prt: there was no sun to take out\n");

    const int bandCount = std::min(arguments.bandCount, sum.knownBandCount);
    const Lighting lighting = lowerRinging(truncate(sum.lighting, bandCount), arguments.window);
    if (!arguments.reconstruction.empty()) writeReconstruction(lighting, arguments.reconstruction);
    writeEnvironmentOutput(sum, arguments.environment);
    if (reports) writeReportFolder(arguments, sum, lighting);
    fmt::print("{}", formatCoefficients(lighting, arguments.format, arguments.convention));
}

void addInputOptions(CLI::App& command, LightArguments& arguments) {
    command.add_option("LIGHT", arguments.lights, "the light, as below; the sum of several")
        ->required();
    addParsedOption(command, "--map", arguments.sum.map, parseSphereMap, sphereMapNames(),
                    "an image's layout [told by its shape]");
    addPixelLimit(command, arguments.sum.limits);
    addParsedOption(command, "--rotate", arguments.rotationDegrees, parseTriple, "X,Y,Z",
                    "turn about the world's x axis, then y, then z, degrees")
        ->default_str("0,0,0");
    addParsedOption(command, "--scale", arguments.sum.factor, parseFactor, "S|R,G,B",
                    "multiply every light by a factor, or one a channel")
        ->default_str("1");
    command.add_flag("--split-sun", arguments.sum.withoutSuns,
                     "take the sun out of images first, and say where it was and what it gave");
}

constexpr const char* kExamples =
    R"(Examples: prt light museum.exr --bands 3 --window auto --format glsl
          prt light museum.exr sun:120,40,1 --scale 0.5 --report museum-light
          prt light museum.exr --environment cube.exr --layout vertical-strip --size 256
)";

}  // namespace

void addLightCommand(CLI::App& app) {
    const auto arguments = std::make_shared<LightArguments>();
    CLI::App* command = app.add_subcommand(
        "light", "Project a light onto spherical harmonics and print the coefficients");
    command->footer(kExamples + std::string(kLightHelp) + describeConventions());
    addInputOptions(*command, *arguments);
    addIntegerOption(*command, "--bands", arguments->bandCount, 1, kMaxLightingBandCount,
                     "n bands, n*n coefficients; 1 to 64; at most those of a JSON");
    addWindowOptions(*command, arguments->window);
    addParsedOption(*command, "--convention", arguments->convention, parseShConvention,
                    conventionNames(), "for whom to print, as below")
        ->default_str("cs");
    addParsedOption(*command, "--format", arguments->format, parseCoefficientFormat,
                    "table|json|c|glsl|hlsl|wgsl", "how to print them")
        ->default_str("table");
    command
        ->add_option("--reconstruct", arguments->reconstruction,
                     "also draw what they stand for as a lat-long picture")
        ->type_name("OUT.exr|png");
    addEnvironmentOptions(*command, arguments->environment);
    command
        ->add_option("--report", arguments->report,
                     "also make a page about the light: bands, energy, ringing, what it lights")
        ->type_name("DIR");
    command->callback([arguments, command] {
        arguments->command = describeCommand(
            fmt::format("prt light {}", fmt::join(arguments->lights, " ")), *command, "report");
        runLight(*arguments);
    });
}

}  // namespace prt::cli

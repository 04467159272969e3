#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/coefficient_format.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_argument.h"
#include "apps/prt/light_report.h"
#include "apps/prt/light_window.h"
#include "apps/prt/limits.h"
#include "apps/prt/picture.h"
#include "apps/prt/staged_folder.h"
#include "prt/base/error.h"

namespace prt::cli {
namespace {

struct LightArguments {
    std::vector<std::string> lights;
    std::string command;  // that would do this again
    int bandCount = 5;
    std::optional<SphereMap> map;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    Vec3d factor{1.0, 1.0, 1.0};
    WindowArguments window;
    ShConvention convention = ShConvention::cs;
    CoefficientFormat format = CoefficientFormat::table;
    std::string reconstruction;
    std::string report;
    ReaderLimits limits;
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

/// All the lights that were named, each turned and scaled, as one.
struct LightSum {
    Lighting lighting;
    Image picture;           ///< of the lights themselves, where it is wanted
    int knownBandCount = 0;  ///< bands that at least one of them has
};

LightSum loadLights(const LightArguments& arguments, int bandCount, int pictureWidth) {
    const Mat3d rotation = rotationFromDegrees(arguments.rotationDegrees);
    LightSum sum{Lighting(bandCount), Image(pictureWidth, pictureWidth / 2), 0};
    for (const std::string& name : arguments.lights) {
        const LightSource light =
            loadLight(name, bandCount, arguments.map, arguments.limits.images());
        if (const auto mending = describeMending(light.mended))
            fmt::print(stderr, "prt: warning: {}: {}\n", name, *mending);
        const Lighting turned = scale(rotate(light.lighting, rotation), arguments.factor);
        // Coefficients from a file may have fewer bands; those that they lack are 0.
        sum.knownBandCount = std::max(sum.knownBandCount, turned.bandCount);
        for (std::size_t i = 0; i < turned.coefficients.size(); ++i)
            sum.lighting.coefficients[i] += turned.coefficients[i];
        if (pictureWidth == 0) continue;
        const Image picture = drawLight(light, rotation, pictureWidth);
        for (std::size_t i = 0; i < picture.pixels.size(); ++i)
            sum.picture.pixels[i] += picture.pixels[i] * Vec3f(arguments.factor);
    }
    return sum;
}

void writeReconstruction(const Lighting& lighting, const std::string& path) {
    constexpr int kWidth = 1024;
    const Image image = reconstructLatLong(lighting, kWidth);
    const DeferInterrupts whileWriting;
    writePicture(path, image);
}

void writeReportFolder(const LightArguments& arguments, LightSum sum, const Lighting& printed) {
    std::vector<std::string> names;
    for (const std::string& light : arguments.lights)
        names.push_back(std::filesystem::path(light).filename().string());
    const LightReport report{.name = fmt::format("{}", fmt::join(names, " + ")),
                             .command = arguments.command,
                             .window = arguments.window.window,
                             .picture = std::move(sum.picture),
                             .lighting = std::move(sum.lighting),
                             .printed = printed};
    const DeferInterrupts whileWriting;
    StagedFolder folder(arguments.report);
    writeLightReport(folder.path(), report);
    stopIfInterrupted();
    folder.commit();
}

void runLight(const LightArguments& arguments) {
    if (!arguments.reconstruction.empty())
        requireSuffix(arguments.reconstruction, kPictureSuffixes);
    if (arguments.bandCount > maxBandCount(arguments.convention))
        throw Error(ErrorCode::invalidOption,
                    fmt::format("holds at most {} bands", maxBandCount(arguments.convention)),
                    fmt::format("--convention {}", shConventionName(arguments.convention)),
                    fmt::format("add --bands {}", maxBandCount(arguments.convention)));
    const bool reports = !arguments.report.empty();
    if (reports) {
        const DeferInterrupts whileProbing;
        StagedFolder::check(arguments.report);
    }
    stopIfInterrupted();

    constexpr int kReportPictureWidth = 1024;
    LightSum sum = loadLights(arguments, reports ? kReportBandCount : arguments.bandCount,
                              reports ? kReportPictureWidth : 0);
    const int bandCount = std::min(arguments.bandCount, sum.knownBandCount);
    const Lighting lighting = lowerRinging(truncate(sum.lighting, bandCount), arguments.window);

    if (!arguments.reconstruction.empty()) writeReconstruction(lighting, arguments.reconstruction);
    if (reports) writeReportFolder(arguments, std::move(sum), lighting);
    fmt::print("{}", formatCoefficients(lighting, arguments.format, arguments.convention));
}

}  // namespace

void addLightCommand(CLI::App& app) {
    const auto arguments = std::make_shared<LightArguments>();
    CLI::App* command = app.add_subcommand(
        "light", "Project a light onto spherical harmonics and print the coefficients");
    command->footer(
        std::string(
            "Examples: prt light museum.exr --bands 3 --window auto --format glsl\n"
            "          prt light museum.exr sun:120,40,1 --scale 0.5 --report museum-light\n") +
        kLightHelp + describeConventions());
    command->add_option("LIGHT", arguments->lights, "the light, as below; the sum of several")
        ->required();
    addIntegerOption(*command, "--bands", arguments->bandCount, 1, kMaxBandCount,
                     "n bands, n*n coefficients; 1 to 10; at most those of a JSON");
    addParsedOption(*command, "--map", arguments->map, parseSphereMap, sphereMapNames(),
                    "the image's layout [told by its shape]");
    addPixelLimit(*command, arguments->limits);
    addParsedOption(*command, "--rotate", arguments->rotationDegrees, parseTriple, "X,Y,Z",
                    "turn about the world's x axis, then y, then z, degrees")
        ->default_str("0,0,0");
    addParsedOption(*command, "--scale", arguments->factor, parseFactor, "S|R,G,B",
                    "multiply every light by a factor, or one a channel")
        ->default_str("1");
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
    command
        ->add_option(
            "--report", arguments->report,
            "also make a folder with a page about the light: in 1 to 32 bands, its energy, "
            "ringing, what it lights")
        ->type_name("DIR");
    command->callback([arguments, command] {
        arguments->command = describeCommand(
            fmt::format("prt light {}", fmt::join(arguments->lights, " ")), *command, "report");
        runLight(*arguments);
    });
}

}  // namespace prt::cli

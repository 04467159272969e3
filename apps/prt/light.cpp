#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/coefficient_format.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_argument.h"
#include "apps/prt/limits.h"
#include "apps/prt/picture.h"

namespace prt::cli {
namespace {

enum class WindowChoice { automatic, none, hann, lanczos };

struct LightArguments {
    std::string light;
    int bandCount = 5;
    std::optional<SphereMap> map;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    WindowChoice window = WindowChoice::none;
    ShConvention convention = ShConvention::cs;
    CoefficientFormat format = CoefficientFormat::table;
    std::string reconstruction;
    ReaderLimits limits;
};

std::optional<WindowChoice> parseWindow(std::string_view name) {
    if (name == "auto") return WindowChoice::automatic;
    if (name == "none") return WindowChoice::none;
    if (name == "hann") return WindowChoice::hann;
    if (name == "lanczos") return WindowChoice::lanczos;
    return std::nullopt;
}

Lighting lowerRinging(const Lighting& lighting, WindowChoice window) {
    switch (window) {
        case WindowChoice::automatic:
            return applyWindow(lighting, deringingFactors(lighting));
        case WindowChoice::hann:
            return applyWindow(lighting, windowFactors(ShWindow::hann, lighting.bandCount));
        case WindowChoice::lanczos:
            return applyWindow(lighting, windowFactors(ShWindow::lanczos, lighting.bandCount));
        case WindowChoice::none:
            break;
    }
    return lighting;
}

void writeReconstruction(const Lighting& lighting, const std::string& path) {
    constexpr int kWidth = 1024;
    const Image image = reconstructLatLong(lighting, kWidth);
    const DeferInterrupts whileWriting;
    writePicture(path, image);
}

void runLight(const LightArguments& arguments) {
    if (!arguments.reconstruction.empty())
        requireSuffix(arguments.reconstruction, kPictureSuffixes);

    const LightSource light =
        loadLight(arguments.light, arguments.bandCount, arguments.map, arguments.limits.images());
    if (const auto mending = describeMending(light.mended))
        fmt::print(stderr, "prt: warning: {}: {}\n", arguments.light, *mending);
    const Lighting turned = rotate(light.lighting, rotationFromDegrees(arguments.rotationDegrees));
    const Lighting lighting = lowerRinging(turned, arguments.window);

    if (!arguments.reconstruction.empty()) writeReconstruction(lighting, arguments.reconstruction);
    fmt::print("{}", formatCoefficients(lighting, arguments.format, arguments.convention));
}

}  // namespace

void addLightCommand(CLI::App& app) {
    const auto arguments = std::make_shared<LightArguments>();
    CLI::App* command = app.add_subcommand(
        "light", "Project a light onto spherical harmonics and print the coefficients");
    command->footer(
        std::string("Example: prt light museum.exr --bands 3 --window auto --format glsl\n") +
        kLightHelp);
    command->add_option("LIGHT", arguments->light, "the light, as below")->required();
    addIntegerOption(*command, "--bands", arguments->bandCount, 1, kMaxBandCount,
                     "n bands, n*n coefficients; 1 to 10; at most those of a JSON");
    addParsedOption(*command, "--map", arguments->map, parseSphereMap, sphereMapNames(),
                    "the image's layout [told by its shape]");
    addPixelLimit(*command, arguments->limits);
    addParsedOption(*command, "--rotate", arguments->rotationDegrees, parseTriple, "X,Y,Z",
                    "turn about the world's x axis, then y, then z, degrees")
        ->default_str("0,0,0");
    addParsedOption(*command, "--window", arguments->window, parseWindow, "auto|none|hann|lanczos",
                    "lower ringing; auto: just so much that nothing is negative")
        ->default_str("none");
    addParsedOption(*command, "--convention", arguments->convention, parseShConvention,
                    "cs|rh|d3dx|three", "signs of the printed coefficients")
        ->default_str("cs");
    addParsedOption(*command, "--format", arguments->format, parseCoefficientFormat,
                    "table|json|glsl|hlsl|c", "how to print them")
        ->default_str("table");
    command
        ->add_option("--reconstruct", arguments->reconstruction,
                     "also draw what they stand for as a lat-long picture")
        ->type_name("OUT.exr|png");
    command->callback([arguments] { runLight(*arguments); });
}

}  // namespace prt::cli

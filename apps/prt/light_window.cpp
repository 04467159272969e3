#include "apps/prt/light_window.h"

#include <fmt/format.h>

#include "apps/common/relit_asset.h"
#include "prt/base/error.h"
#include "prt/light/deringing.h"

namespace prt::cli {
namespace {

std::vector<double> deringForFile(const Lighting& lighting, const std::string& path) {
    const Asset asset = readAsset(path);
    if (lighting.bandCount > asset.transfer.bandCount)
        throw Error(ErrorCode::invalidOption,
                    fmt::format("was baked in {} bands, the light has {}", asset.transfer.bandCount,
                                lighting.bandCount),
                    path, fmt::format("add --bands {}", asset.transfer.bandCount));
    return deringForAsset(asset, path, lighting);
}

/// The factors of --nonnegative.
std::vector<double> deringFor(const std::string& nonNegative, const Lighting& lighting) {
    if (nonNegative == "radiance") return deringingFactors(lighting);
    if (nonNegative == "irradiance")
        return deringingFactors(lighting, {.nonNegative = NonNegative::irradiance});
    return deringForFile(lighting, nonNegative);
}

}  // namespace

void addWindowOption(CLI::App& command, std::string& window, const std::string& help) {
    command.add_option("--window", window, help)
        ->check(CLI::IsMember(std::vector<std::string>(kWindowNames.begin(), kWindowNames.end()))
                    .description(""))
        ->type_name("auto|none|hann|lanczos")
        ->capture_default_str();
}

void addWindowOptions(CLI::App& command, WindowArguments& arguments) {
    addWindowOption(command, arguments.window, "lower ringing; auto: just as much as is needed");
    command
        .add_option("--nonnegative", arguments.nonNegative,
                    "what auto keeps so: the light, irradiance, what ASSET reflects")
        ->type_name("radiance|irradiance|ASSET")
        ->capture_default_str();
}

std::string describeWindow(const WindowArguments& arguments) {
    if (arguments.nonNegative == "radiance") return arguments.window;
    return fmt::format("{} for {}", arguments.window, arguments.nonNegative);
}

Lighting lowerRinging(const Lighting& lighting, const WindowArguments& arguments) {
    if (arguments.window != "auto" && arguments.nonNegative != "radiance")
        throw Error(ErrorCode::invalidOption, "only means something with --window auto",
                    "--nonnegative");
    return lowerRinging(lighting, arguments.window,
                        [&] { return deringFor(arguments.nonNegative, lighting); });
}

}  // namespace prt::cli

#include "apps/prt/light_window.h"

#include <fmt/format.h>

#include "apps/prt/relit_asset.h"
#include "prt/base/error.h"
#include "prt/light/deringing.h"
#include "prt/relight/receiver_deringing.h"

namespace prt::cli {
namespace {

std::vector<double> deringForAsset(const Lighting& lighting, const std::string& path) {
    const Asset asset = readAsset(path);
    if (lighting.bandCount > asset.transfer.bandCount)
        throw Error(ErrorCode::invalidOption,
                    fmt::format("was baked in {} bands, the light has {}", asset.transfer.bandCount,
                                lighting.bandCount),
                    path, fmt::format("add --bands {}", asset.transfer.bandCount));
    return deringingFactors(Relighter(asset.transfer, fullestTransport(asset.transfer)), lighting);
}

std::vector<double> chooseFactors(const Lighting& lighting, const WindowArguments& arguments) {
    if (arguments.window == "hann") return windowFactors(ShWindow::hann, lighting.bandCount);
    if (arguments.window == "lanczos") return windowFactors(ShWindow::lanczos, lighting.bandCount);
    if (arguments.nonNegative == "radiance") return deringingFactors(lighting);
    if (arguments.nonNegative == "irradiance")
        return deringingFactors(lighting, {.nonNegative = NonNegative::irradiance});
    return deringForAsset(lighting, arguments.nonNegative);
}

}  // namespace

void addWindowOptions(CLI::App& command, WindowArguments& arguments) {
    command
        .add_option("--window", arguments.window, "lower ringing; auto: just as much as is needed")
        ->check(CLI::IsMember({"auto", "none", "hann", "lanczos"}).description(""))
        ->type_name("auto|none|hann|lanczos")
        ->capture_default_str();
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
    if (arguments.window == "none") return lighting;
    return applyWindow(lighting, chooseFactors(lighting, arguments));
}

}  // namespace prt::cli

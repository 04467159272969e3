#include "apps/prt/prepared_asset.h"

#include "apps/common/parse.h"
#include "apps/common/relit_asset.h"
#include "apps/common/ringing.h"
#include "apps/prt/light_window.h"
#include "apps/prt/view_options.h"

namespace prt::cli {

Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log) {
    const Stopwatch watch;
    Asset asset = readShownAsset(path, limits);
    for (const std::string& warning : asset.scene.warnings)
        log.warn(path + ": " + warning);
    log.finishStage("load", watch.seconds(), path);
    return asset;
}

void addLightingOptions(CLI::App& command, LightingArguments& arguments) {
    addRotationOption(command, arguments.rotationDegrees);
    addWindowOption(command, arguments.window,
                    "lower ringing; auto: as little as leaves no negative reflection");
}

Lighting prepareLighting(const Lighting& lighting, const LightingArguments& arguments,
                         const Asset& asset, const std::string& path, ShownTransport shown) {
    const Lighting turned = rotate(lighting, rotationFromDegrees(arguments.rotationDegrees));
    return lowerRinging(turned, arguments.window,
                        [&] { return deringForAsset(asset, path, shown, turned); });
}

}  // namespace prt::cli

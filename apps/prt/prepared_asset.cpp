#include "apps/prt/prepared_asset.h"

#include "apps/common/relit_asset.h"

namespace prt::cli {

Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log) {
    const Stopwatch watch;
    Asset asset = readShownAsset(path, limits);
    for (const std::string& warning : asset.scene.warnings)
        log.warn(path + ": " + warning);
    log.finishStage("load", watch.seconds(), path);
    return asset;
}

}  // namespace prt::cli

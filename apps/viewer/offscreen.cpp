#include "apps/viewer/offscreen.h"

#include <algorithm>

#include "apps/common/parse.h"
#include "apps/common/picture.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"
#include "prt/io/image_io.h"

namespace prt::viewer {

void writeScreenshot(Stage& stage, const ViewState& view, const OffscreenOptions& options,
                     const std::string& path) {
    const GpuTarget& radiance = stage.draw(view, options.width, options.height,
                                           options.sampleCount.value_or(kRestingSampleCount));
    if (cli::isExr(path)) {
        cli::writePicture(path, radiance.readRadiance());
        return;
    }
    const GpuTarget shown(options.width, options.height, 1, TargetFormat::codeValues);
    shown.beginDrawing();
    stage.present(view);
    shown.finishDrawing();
    writePng(path, shown.readCodeValues());
}

std::vector<std::string> runOffscreen(const ViewState& view, const std::vector<ScriptStep>& script,
                                      const OffscreenOptions& options) {
    for (const ScriptStep& step : script)
        if (!step.screenshot.empty()) cli::requireSuffix(step.screenshot, cli::kPictureSuffixes);
    const GlContext context;
    Stage stage(options.stage);
    std::vector<std::string> faults;
    ViewState current = view;
    for (const ScriptStep& step : script) {
        current = applyPatch(current, step.patch, "the script");
        stage.finishLoading(current);
        for (const std::string& fault : stage.describeFaults())
            if (std::find(faults.begin(), faults.end(), fault) == faults.end())
                faults.push_back(fault);
        stage.requireSomethingToShow();
        if (!step.screenshot.empty()) writeScreenshot(stage, current, options, step.screenshot);
    }
    return faults;
}

}  // namespace prt::viewer

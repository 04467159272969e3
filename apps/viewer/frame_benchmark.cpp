#include "apps/viewer/frame_benchmark.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/viewer/frame_times.h"
#include "prt/gpu/gl_context.h"

namespace prt::viewer {
namespace {

using nlohmann::ordered_json;

/// How far the light turns from one frame to the next.
constexpr double kDegreesPerFrame = 3.0;

ordered_json describeTimes(const std::vector<double>& milliseconds) {
    double sum = 0.0;
    for (const double time : milliseconds)
        sum += time;
    return {{"mean", sum / static_cast<double>(milliseconds.size())},
            {"least", findPercentile(milliseconds, 0.0)},
            {"median", findPercentile(milliseconds, 0.5)},
            {"p90", findPercentile(milliseconds, 0.9)},
            {"p99", findPercentile(milliseconds, 0.99)},
            {"most", findPercentile(milliseconds, 1.0)}};
}

}  // namespace

std::vector<double> timeFrames(ViewState view, int frameCount,
                               const std::function<void(const ViewState&)>& draw) {
    const int uncounted = 1 + frameCount / 10;
    std::vector<double> milliseconds;
    for (int i = -uncounted; i < frameCount; ++i) {
        view.lightRotationDegrees.y =
            std::remainder(view.lightRotationDegrees.y + kDegreesPerFrame, 360.0);
        const auto start = std::chrono::steady_clock::now();
        draw(view);
        finishGpuWork();
        const std::chrono::duration<double, std::milli> elapsed =
            std::chrono::steady_clock::now() - start;
        if (i >= 0) milliseconds.push_back(elapsed.count());
    }
    return milliseconds;
}

std::string reportFrames(const Stage& stage, const FrameSetting& setting,
                         const std::vector<double>& milliseconds) {
    ordered_json times = describeTimes(milliseconds);
    const ordered_json report = {{"renderer", setting.renderer},
                                 {"relit_by", stage.relightsOnCard() ? "opengl" : "cpu"},
                                 {"in_window", setting.inWindow},
                                 {"width", setting.width},
                                 {"height", setting.height},
                                 {"samples_per_pixel", setting.sampleCount},
                                 {"objects", stage.objects().statuses().size()},
                                 {"vertices", stage.vertexCount()},
                                 {"triangles", stage.triangleCount()},
                                 {"frames", milliseconds.size()},
                                 {"frames_per_second", 1000.0 / times["mean"].get<double>()},
                                 {"milliseconds", std::move(times)}};
    return report.dump(2) + "\n";
}

std::string benchmarkOffscreen(const ViewState& view, int frameCount,
                               const OffscreenOptions& options) {
    const GlContext context;
    Stage stage(options.stage);
    stage.finishLoading(view);
    stage.requireSomethingToShow();
    const int sampleCount = options.sampleCount.value_or(movingSampleCount());
    const GpuTarget screen(options.width, options.height, 1, TargetFormat::codeValues);
    const std::vector<double> milliseconds =
        timeFrames(view, frameCount, [&](const ViewState& frame) {
            stage.update(frame);
            stage.draw(frame, options.width, options.height, sampleCount);
            screen.beginDrawing();
            stage.present(frame);
            screen.finishDrawing();
        });
    return reportFrames(stage,
                        {.renderer = describeDriver(),
                         .width = options.width,
                         .height = options.height,
                         .sampleCount = sampleCount},
                        milliseconds);
}

}  // namespace prt::viewer

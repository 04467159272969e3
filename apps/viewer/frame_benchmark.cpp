#include "apps/viewer/frame_benchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"

namespace prt::viewer {
namespace {

using nlohmann::ordered_json;

/// How far the light turns from one frame to the next.
constexpr double kDegreesPerFrame = 3.0;

/// Draws one frame after the other.
class FrameTimer {
  public:
    FrameTimer(Stage& stage, ViewState view, const OffscreenOptions& options)
        : stage_(stage),
          view_(std::move(view)),
          options_(options),
          screen_(options.width, options.height, 1, TargetFormat::codeValues) {}

    double timeFrame() {
        const auto start = std::chrono::steady_clock::now();
        view_.lightRotationDegrees.y =
            std::remainder(view_.lightRotationDegrees.y + kDegreesPerFrame, 360.0);
        stage_.update(view_);
        stage_.draw(view_, options_.width, options_.height, options_.sampleCount);
        screen_.beginDrawing();
        stage_.present(view_);
        screen_.finishDrawing();
        finishGpuWork();
        const std::chrono::duration<double, std::milli> elapsed =
            std::chrono::steady_clock::now() - start;
        return elapsed.count();
    }

  private:
    Stage& stage_;
    ViewState view_;
    OffscreenOptions options_;
    GpuTarget screen_;
};

ordered_json describeTimes(std::vector<double> milliseconds) {
    std::ranges::sort(milliseconds);
    // The least time that so many of the frames do not exceed.
    const auto percentile = [&](double share) {
        const auto count = static_cast<double>(milliseconds.size());
        return milliseconds[static_cast<std::size_t>(std::max(std::ceil(share * count), 1.0)) - 1];
    };
    double sum = 0.0;
    for (const double time : milliseconds)
        sum += time;
    return {{"mean", sum / static_cast<double>(milliseconds.size())},
            {"least", milliseconds.front()},
            {"median", percentile(0.5)},
            {"p90", percentile(0.9)},
            {"p99", percentile(0.99)},
            {"most", milliseconds.back()}};
}

}  // namespace

std::string benchmarkFrames(const ViewState& view, int frameCount,
                            const OffscreenOptions& options) {
    const GlContext context;
    Stage stage(options.stage);
    stage.finishLoading(view);
    if (!stage.showsAnything()) throw Error(ErrorCode::malformed, stage.describeFaults().front());
    FrameTimer timer(stage, view, options);
    for (int i = 0; i < 1 + frameCount / 10; ++i)
        timer.timeFrame();
    std::vector<double> milliseconds;
    for (int i = 0; i < frameCount; ++i)
        milliseconds.push_back(timer.timeFrame());

    ordered_json times = describeTimes(std::move(milliseconds));
    const ordered_json report = {{"renderer", context.description()},
                                 {"relit_by", stage.relightsOnCard() ? "opengl" : "cpu"},
                                 {"width", options.width},
                                 {"height", options.height},
                                 {"samples_per_pixel", options.sampleCount},
                                 {"objects", view.objects.size()},
                                 {"vertices", stage.vertexCount()},
                                 {"triangles", stage.triangleCount()},
                                 {"frames", frameCount},
                                 {"frames_per_second", 1000.0 / times["mean"].get<double>()},
                                 {"milliseconds", std::move(times)}};
    return report.dump(2) + "\n";
}

}  // namespace prt::viewer

#include "apps/viewer/window.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

#include <imgui.h>

#include "apps/viewer/desk.h"
#include "apps/viewer/dropped_files.h"
#include "apps/viewer/frame_benchmark.h"
#include "apps/viewer/glfw_window.h"
#include "apps/viewer/interface.h"
#include "apps/viewer/key_bindings.h"
#include "apps/viewer/panels.h"
#include "apps/viewer/pointer.h"
#include "apps/viewer/window_picture.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"
#include "prt/io/image_io.h"

namespace prt::viewer {
namespace {

constexpr const char* kTitle = "OpenPRT";
constexpr double kRestSeconds = 0.6;  ///< without a change, until pictures are fine again
constexpr double kLeastWaitSeconds = 1e-3;
constexpr int kFramesAfterEvent = 3;  ///< that panels need to find their size

enum class Use { person, script, benchmark };

/// A view in a window, and all that is done to it there.
class Session {
  public:
    Session(const ViewState& view, const WindowOptions& options, Use use)
        : window_(options.width, options.height, kTitle, use == Use::person),
          stage_(options.stage),
          interface_(window_),
          isScripted_(use == Use::script),
          movingSampleCount_(isScripted_ ? kRestingSampleCount : movingSampleCount()),
          view_(view) {
        desk_.isPanelOpen = options.isPanelOpen;
    }

    ViewState run();
    ViewState runScript(const std::vector<ScriptStep>& script);
    std::string runBenchmark(int frameCount);

  private:
    void waitForEvents();
    double secondsToWait() const;

    /// @param picturePath  for a picture of the window as it then is; empty for none
    void frame(const std::string& picturePath = {});
    void handleDrops();
    void handleKeys();
    void fly(double seconds);
    void layPanels();
    /// @return whether it was another than before
    bool drawPicture(int width, int height);
    void doWhatIsWanted(int width, int height);
    void takeScreenshot(int width, int height);
    template <class Work>
    void attempt(const Work& work);

    // The context stands before all that lives in it, and goes after it.
    GlfwWindow window_;
    Stage stage_;
    Interface interface_;
    bool isScripted_;
    int movingSampleCount_;  ///< a pixel
    Picker picker_;
    LightFolder folder_;
    ViewState view_;
    Desk desk_;

    const GpuTarget* picture_ = nullptr;
    std::string drawnView_;      ///< what the picture shows
    StageRevision drawnFrom_{};  ///< what it was made of
    std::pair<int, int> drawnSize_{};
    int sampleCount_ = 0;
    double movedSeconds_ = 0.0;  ///< when the view changed last
    int framesToCome_ = 0;       ///< until panels have come to rest
    bool isFlying_ = false;
};

/// What goes wrong while somebody works is told, and ends nothing.
template <class Work>
void Session::attempt(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        if (isScripted_) throw;
        desk_.tell(error.message());
    } catch (const std::filesystem::filesystem_error& failure) {
        if (isScripted_) throw;
        desk_.tell(failure.what());
    }
}

ViewState Session::run() {
    while (!window_.isClosing()) {
        waitForEvents();
        frame();
    }
    window_.hide();  // what is being read or prefiltered is waited for
    return view_;
}

ViewState Session::runScript(const std::vector<ScriptStep>& script) {
    for (const ScriptStep& step : script) {
        view_ = applyPatch(view_, step.patch, "the script");
        stage_.finishLoading(view_);
        window_.waitForEvents(0.0);
        for (int i = 0; i < kFramesAfterEvent; ++i)
            frame();
        if (!step.screenshot.empty()) frame(step.screenshot);
        if (window_.isClosing()) break;
    }
    return view_;
}

double Session::secondsToWait() const {
    constexpr double kLongest = 10.0, kWhileBusy = 0.05;
    if (isFlying_ || framesToCome_ > 0 || !picture_) return 0.0;
    double seconds = stage_.isBusy() || folder_.isBusy() ? kWhileBusy : kLongest;
    for (const Toast& toast : desk_.toasts)
        seconds = std::min(seconds, toast.endSeconds - desk_.seconds);
    if (sampleCount_ < kRestingSampleCount)
        seconds = std::min(seconds, movedSeconds_ + kRestSeconds - desk_.seconds);
    return std::max(seconds, kLeastWaitSeconds);
}

std::string Session::runBenchmark(int frameCount) {
    stage_.finishLoading(view_);
    stage_.requireSomethingToShow();
    const std::vector<double> milliseconds =
        timeFrames(view_, frameCount, [this](const ViewState& view) {
            view_ = view;
            window_.waitForEvents(0.0);
            frame();
        });
    const auto [width, height] = window_.pixelSize();
    return reportFrames(stage_,
                        {.renderer = describeDriver(),
                         .inWindow = true,
                         .width = width,
                         .height = height,
                         .sampleCount = sampleCount_},
                        milliseconds);
}

void Session::waitForEvents() {
    const bool hasHappened = window_.waitForEvents(secondsToWait());
    framesToCome_ = hasHappened ? kFramesAfterEvent : std::max(framesToCome_ - 1, 0);
}

void Session::handleDrops() {
    const std::vector<std::string> files = window_.takeDroppedFiles();
    if (files.empty()) return;
    for (std::string& told : dropFiles(view_, files, {.replacesLights = desk_.dropsReplaceLights}))
        desk_.tell(std::move(told));
}

void Session::handleKeys() {
    const std::vector<KeyPress> presses = window_.takeKeys();
    if (ImGui::GetIO().WantTextInput) return;
    const Choices choices = findChoices(stage_, view_.objects.size());
    for (const KeyPress& press : presses)
        applyKey(view_, desk_, press, paneAt(view_, mousePoint().x), choices);
}

void Session::fly(double seconds) {
    constexpr double kLongestStep = 0.1;
    const ImGuiIO& io = ImGui::GetIO();
    const Flight flight = io.WantTextInput || io.KeyCtrl
                              ? Flight{}
                              : findFlight([&](int key) { return window_.isHeld(key); });
    if (isFlying_) {
        const CameraPose pose = stage_.cameraPose(
            view_, static_cast<double>(io.DisplaySize.x) / static_cast<double>(io.DisplaySize.y));
        applyFlight(view_, flight, std::min(seconds, kLongestStep), io.KeyShift, pose);
    }
    isFlying_ = flight != Flight{};
}

void Session::layPanels() {
    drawSplitLine(view_, stage_);
    drawPanel(view_, desk_, stage_, folder_);
    drawMessages(desk_, stage_);
    drawHint(desk_);
    drawFrameTile(desk_);
    drawHelp(desk_);
}

bool Session::drawPicture(int width, int height) {
    std::string view = formatView(view_);
    StageRevision from = stage_.revision();
    const bool isMoving = view != drawnView_;
    if (isMoving) movedSeconds_ = desk_.seconds;
    const bool moves = desk_.seconds < movedSeconds_ + kRestSeconds;
    const int sampleCount = moves ? movingSampleCount_ : kRestingSampleCount;
    const std::pair size(width, height);
    if (!isMoving && from == drawnFrom_ && size == drawnSize_ && sampleCount == sampleCount_)
        return false;
    drawnView_ = std::move(view);
    drawnFrom_ = std::move(from);
    drawnSize_ = size;
    sampleCount_ = sampleCount;
    attempt([&] { picture_ = &stage_.draw(view_, width, height, sampleCount); });
    return true;
}

void Session::frame(const std::string& picturePath) {
    const auto [width, height] = window_.pixelSize();
    if (width == 0 || height == 0) return;
    const double start = window_.secondsSinceStart();
    interface_.begin();
    handleDrops();
    handleKeys();
    fly(start - std::exchange(desk_.seconds, start));
    attempt([&] { followMouse(view_, desk_, stage_, picker_); });
    layPanels();
    const bool wasBusy = stage_.isBusy();
    stage_.update(view_);
    if (wasBusy != stage_.isBusy()) framesToCome_ = kFramesAfterEvent;
    const bool isNew = drawPicture(width, height);
    window_.beginDrawing();
    attempt([&] { stage_.present(view_); });
    doWhatIsWanted(width, height);
    interface_.draw();
    if (!picturePath.empty()) writePng(picturePath, readWindow(width, height));
    window_.swap();
    if (isNew) desk_.frameTimes.add((window_.secondsSinceStart() - start) * 1000.0);
}

void Session::doWhatIsWanted(int width, int height) {
    if (std::exchange(desk_.wantsScreenshot, false))
        attempt([&] { takeScreenshot(width, height); });
    if (std::exchange(desk_.wantsSave, false))
        attempt([&] {
            saveView(desk_.viewFile, view_);
            desk_.tell("view saved as " + desk_.viewFile);
        });
    if (std::exchange(desk_.wantsLoad, false))
        attempt([&] {
            view_ = loadView(desk_.viewFile);
            desk_.tell("view loaded from " + desk_.viewFile);
        });
    if (std::exchange(desk_.wantsClose, false)) window_.close();
}

void Session::takeScreenshot(int width, int height) {
    const std::string stem = nextScreenshot(std::filesystem::current_path()).string();
    writePng(stem + ".png", readWindow(width, height));
    if (picture_) writeExr(stem + ".exr", picture_->readRadiance());
    desk_.tell("screenshot: " + stem + ".png and .exr");
}

}  // namespace

ViewState runWindow(const ViewState& view, const WindowOptions& options) {
    if (options.script.empty()) return Session(view, options, Use::person).run();
    return Session(view, options, Use::script).runScript(options.script);
}

std::string benchmarkWindow(const ViewState& view, int frameCount, const WindowOptions& options) {
    return Session(view, options, Use::benchmark).runBenchmark(frameCount);
}

}  // namespace prt::viewer

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/shown_transport.h"
#include "apps/viewer/frame_times.h"
#include "apps/viewer/input.h"
#include "apps/viewer/stage.h"
#include "prt/basis/sh.h"

namespace prt::viewer {

/// A sentence that is shown for a while.
struct Toast {
    std::string text;
    double endSeconds = 0.0;  ///< of the window's clock
};

/// What all objects of a view together can be asked for.
struct Choices {
    int bandCount = kMaxBandCount;  ///< the most that one of them has
    std::vector<cli::ShownTransport> transports{};
};

Choices findChoices(const Stage& stage, std::size_t objectCount);

/// A button that is held.
struct HeldButton {
    MouseButton button = MouseButton::left;
    Drag drag = Drag::orbit;
    double travel = 0.0;  ///< so far, heights of the picture
};

/// What lies about a view while somebody works on it, and is not saved with it.
struct Desk {
    bool isPanelOpen = false;
    bool isHelpOpen = false;
    bool showsFrameTimes = false;
    bool showsHint = true;
    bool dropsReplaceLights = true;  ///< rather than add to them
    std::size_t selectedObject = 0;
    std::string viewFile = "view.json";

    // What has been asked for, until it is done.
    bool wantsScreenshot = false;  ///< of the picture without what lies over it
    bool wantsSave = false;
    bool wantsLoad = false;
    bool wantsClose = false;

    std::optional<HeldButton> held{};
    FrameTimes frameTimes{};
    double seconds = 0.0;  ///< of the window's clock
    std::vector<Toast> toasts{};

    /// Shows a sentence.
    void tell(std::string text) {
        constexpr double kSecondsShown = 6.0;
        std::erase_if(toasts, [&](const Toast& toast) { return toast.text == text; });
        toasts.push_back({std::move(text), seconds + kSecondsShown});
    }
};

}  // namespace prt::viewer

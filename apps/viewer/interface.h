#pragma once

#include "apps/viewer/glfw_window.h"

namespace prt::viewer {

/// Dear ImGui in a window.
class Interface {
  public:
    /// @param window  must outlive this; its callbacks have been set
    explicit Interface(const GlfwWindow& window);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    /// Panels are laid out from here on.
    void begin();
    /// And drawn over what is in the window.
    void draw();
};

}  // namespace prt::viewer

#pragma once

#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace prt::viewer {

/// A key that went down.
struct KeyPress {
    int key = 0;  ///< as GLFW numbers keys: letters and digits are their capital ASCII
    bool shift = false;
    bool control = false;
};

/// A window with an OpenGL 4.3 core context, which is current on this thread as long as it stands.
/// One at a time.
class GlfwWindow {
  public:
    /// @param isPaced  whether frames wait for the screen
    /// @throws Error   unsupported without a display or OpenGL 4.3
    GlfwWindow(int width, int height, const char* title, bool isPaced);
    ~GlfwWindow();
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;

    GLFWwindow* handle() const { return window_; }

    bool isClosing() const;
    void close();
    void hide();

    /// Width and height of what is drawn; 0 while the window is an icon.
    std::pair<int, int> pixelSize() const;
    /// How large text should be on its screen, 1 for some 96 pixels an inch.
    float contentScale() const;

    /// Returns when something happened, or after so long.
    ///
    /// @param seconds  0: at once
    /// @return         whether something happened
    bool waitForEvents(double seconds);
    bool isHeld(int key) const;
    double secondsSinceStart() const;

    /// Since the last time that it was asked for.
    std::vector<KeyPress> takeKeys() { return std::exchange(keys_, {}); }
    std::vector<std::string> takeDroppedFiles() { return std::exchange(droppedFiles_, {}); }

    /// What is drawn from here on comes to the window, in place of all that was there.
    void beginDrawing() const;
    /// Shows what was drawn.
    void swap() const;

  private:
    void listen();
    static GlfwWindow& of(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    bool hasHappened_ = false;  ///< something, since it was last waited for
    std::vector<KeyPress> keys_;
    std::vector<std::string> droppedFiles_;
};

}  // namespace prt::viewer

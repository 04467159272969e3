#include "apps/viewer/glfw_window.h"

#include <algorithm>

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "prt/base/error.h"

namespace prt::viewer {
namespace {

[[noreturn]] void refuse() {
    const char* description = nullptr;
    const int code = glfwGetError(&description);
    const std::string why = description ? description : "GLFW does not say why";
    glfwTerminate();
    if (code == GLFW_VERSION_UNAVAILABLE || code == GLFW_API_UNAVAILABLE)
        throw Error(ErrorCode::unsupported, "no window can be opened: there is no OpenGL 4.3", {},
                    why + "; update the driver, or use --offscreen");
    throw Error(ErrorCode::unsupported, "no window can be opened: " + why, {},
                "set DISPLAY, or use --offscreen");
}

GLFWwindow* openWindow(int width, int height, const char* title) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the picture comes with a depth of its own
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(width, height, title, nullptr, nullptr);
}

}  // namespace

GlfwWindow::GlfwWindow(int width, int height, const char* title, bool isPaced) {
    if (!glfwInit()) refuse();
    window_ = openWindow(width, height, title);
    if (!window_) refuse();
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(isPaced ? 1 : 0);
    listen();
}

GlfwWindow::~GlfwWindow() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

GlfwWindow& GlfwWindow::of(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
}

void GlfwWindow::listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        of(window).hasHappened_ = true;
        if (action != GLFW_PRESS) return;
        of(window).keys_.push_back({.key = key,
                                    .shift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                    .control = (modifiers & GLFW_MOD_CONTROL) != 0});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        of(window).hasHappened_ = true;
        auto& files = of(window).droppedFiles_;
        files.insert(files.end(), paths, paths + count);
    });
    // Of all else it is enough to know that it happened.
    constexpr auto kTwoNumbers = [](GLFWwindow* window, double, double) {
        of(window).hasHappened_ = true;
    };
    constexpr auto kOneNumber = [](GLFWwindow* window, int) { of(window).hasHappened_ = true; };
    glfwSetCursorPosCallback(window_, kTwoNumbers);
    glfwSetScrollCallback(window_, kTwoNumbers);
    glfwSetCursorEnterCallback(window_, kOneNumber);
    glfwSetWindowFocusCallback(window_, kOneNumber);
    glfwSetMouseButtonCallback(
        window_, [](GLFWwindow* window, int, int, int) { of(window).hasHappened_ = true; });
    glfwSetFramebufferSizeCallback(
        window_, [](GLFWwindow* window, int, int) { of(window).hasHappened_ = true; });
    glfwSetWindowRefreshCallback(window_,
                                 [](GLFWwindow* window) { of(window).hasHappened_ = true; });
}

bool GlfwWindow::isClosing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void GlfwWindow::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void GlfwWindow::hide() {
    glfwHideWindow(window_);
}

std::pair<int, int> GlfwWindow::pixelSize() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

float GlfwWindow::contentScale() const {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(std::max(x, y), 1.0f, 4.0f);
}

bool GlfwWindow::waitForEvents(double seconds) {
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    return std::exchange(hasHappened_, false);
}

bool GlfwWindow::isHeld(int key) const {
    return glfwGetKey(window_, key) == GLFW_PRESS;
}

double GlfwWindow::secondsSinceStart() const {
    return glfwGetTime();
}

void GlfwWindow::beginDrawing() const {
    const auto [width, height] = pixelSize();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

void GlfwWindow::swap() const {
    glfwSwapBuffers(window_);
}

}  // namespace prt::viewer

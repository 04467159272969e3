#include "prt/gpu/gl_context.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "prt/base/error.h"

namespace prt {
namespace {

constexpr int kGlVersion = 43;  ///< as epoxy counts

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::unsupported, what, {},
                "install a driver, as of Debian's libegl1 and libgl1-mesa-dri, or draw on the CPU");
}

/// Displays that need no window system: graphics cards first, then Mesa's own and the default.
std::vector<EGLDisplay> findDisplays() {
    constexpr EGLint kMostDevices = 16;
    std::vector<EGLDisplay> displays;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
        std::array<EGLDeviceEXT, kMostDevices> devices{};
        EGLint count = 0;
        if (!eglQueryDevicesEXT(kMostDevices, devices.data(), &count)) count = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            displays.push_back(
                eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        displays.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    std::erase(displays, EGL_NO_DISPLAY);
    return displays;
}

}  // namespace

struct GlContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLSurface surface = EGL_NO_SURFACE;  ///< one pixel, which nothing is drawn to
    EGLContext context = EGL_NO_CONTEXT;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    /// The display stays for other contexts of the process, which may share it.
    ~Handles() {
        if (display == EGL_NO_DISPLAY) return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    }

    bool makeCurrent() const { return eglMakeCurrent(display, surface, surface, context); }

    /// Whether this display gives a context that is good enough, current on this thread then.
    bool open(EGLDisplay candidate) {
        if (!eglInitialize(candidate, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
            return false;
        display = candidate;
        constexpr std::array<EGLint, 5> kConfig = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                                   EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count) || count == 0)
            return false;
        constexpr std::array<EGLint, 7> kContext = {EGL_CONTEXT_MAJOR_VERSION,
                                                    4,
                                                    EGL_CONTEXT_MINOR_VERSION,
                                                    3,
                                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                    EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
        if (context == EGL_NO_CONTEXT) return false;
        constexpr std::array<EGLint, 5> kOnePixel = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, kOnePixel.data());
        return surface != EGL_NO_SURFACE && makeCurrent() && epoxy_gl_version() >= kGlVersion;
    }
};

GlContext::GlContext() {
    if (!epoxy_has_egl()) refuse("there is no EGL library, through which OpenGL is reached");
    for (EGLDisplay display : findDisplays()) {
        handles_ = std::make_unique<Handles>();
        if (handles_->open(display)) return;
    }
    refuse("there is no OpenGL 4.3");
}

GlContext::~GlContext() = default;

void GlContext::makeCurrent() const {
    if (!handles_->makeCurrent()) refuse("the driver does not let this thread use its context");
}

std::string describeDriver() {
    const auto text = [](GLenum name) {
        return std::string(reinterpret_cast<const char*>(glGetString(name)));
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

bool isSoftwareRasteriser() {
    constexpr std::array<std::string_view, 5> kNames = {"llvmpipe", "softpipe", "SWR",
                                                        "SwiftShader", "Software Rasterizer"};
    const std::string_view renderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    return std::ranges::any_of(kNames, [&](std::string_view name) {
        return renderer.find(name) != std::string_view::npos;
    });
}

void finishGpuWork() {
    glFinish();
}

}  // namespace prt

#pragma once

#include <memory>
#include <string>

namespace prt {

/// An OpenGL 4.3 core context without a display or a window, through EGL. All else of this module
/// works in the context that is current on its thread, of this class or of a window.
class GlContext {
  public:
    /// Current on this thread from here on. Takes the first of the machine's devices that has
    /// OpenGL 4.3, or else a rasteriser on the CPU.
    ///
    /// @throws Error  unsupported where EGL or OpenGL 4.3 is missing
    GlContext();
    /// Whatever was made in the context must have gone before.
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// @throws Error  unsupported if the driver refuses
    void makeCurrent() const;

  private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

/// The driver's names of itself and its version, in the context that is current.
std::string describeDriver();

/// Whether what draws in the context that is current runs on the CPU, by the driver's name of
/// itself: Relighter is faster there than shaders are, and samples of a pixel are dear.
bool isSoftwareRasteriser();

/// Waits until all that was asked of the current context has been done.
void finishGpuWork();

}  // namespace prt

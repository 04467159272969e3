#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/prt/arguments.h"
#include "prt/image/tone_curve.h"
#include "prt/scene/scene.h"

namespace prt::cli {

/// From where a picture is taken, and how large it is.
struct ViewArguments {
    std::string camera{};
    std::optional<Vec3d> eye{};
    Vec3d target{0.0, 0.0, 0.0};
    double fovDegrees = 45.0;
    PictureSize size{};
};

/// --camera, --eye, --target and --fov.
void addCameraOptions(CLI::App& command, ViewArguments& view);

/// The same and --size.
void addViewOptions(CLI::App& command, ViewArguments& view);

/// --rotate
void addRotationOption(CLI::App& command, Vec3d& rotationDegrees);

/// --exposure and --tone, which say how radiance becomes a picture for the screen.
struct DisplayOptionHandles {
    CLI::Option* exposure;
    CLI::Option* tone;
};
DisplayOptionHandles addDisplayOptions(CLI::App& command, DisplayOptions& display,
                                       const std::string& note = {});

/// --tone alone, whose default is the curve's value.
CLI::Option* addToneOption(CLI::App& command, ToneCurve& toneCurve, const std::string& help);

/// The camera that the options ask for.
///
/// @param asset   how to call the scene in an error
/// @throws Error  invalidOption if the scene has no camera of that name
Camera chooseCamera(const ViewArguments& view, const Scene& scene, const std::string& asset);

}  // namespace prt::cli

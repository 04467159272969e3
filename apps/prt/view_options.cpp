#include "apps/prt/view_options.h"

#include <numbers>
#include <vector>

#include "prt/base/error.h"
#include "prt/scene/framing.h"

namespace prt::cli {

void addCameraOptions(CLI::App& command, ViewArguments& view) {
    CLI::Option* camera = command.add_option(
        "--camera", view.camera, "a camera of the scene [its first, else all of it in view]");
    camera->type_name("NAME");
    CLI::Option* eye = addParsedOption(command, "--eye", view.eye, parseTriple, "X,Y,Z",
                                       "where the camera stands, world metres");
    CLI::Option* target = addParsedOption(command, "--target", view.target, parseTriple, "X,Y,Z",
                                          "what it looks at, world metres");
    CLI::Option* fov = command.add_option("--fov", view.fovDegrees,
                                          "its vertical field of view, degrees; 1 to 170");
    fov->check(CLI::Range(1.0, 170.0).description(""))->type_name("DEG")->capture_default_str();
    eye->needs(target)->excludes(camera);
    target->needs(eye);
    fov->needs(eye);
}

void addViewOptions(CLI::App& command, ViewArguments& view) {
    addCameraOptions(command, view);
    addParsedOption(command, "--size", view.size, parsePictureSize, "WxH", "of the picture, pixels")
        ->default_str(fmt::format("{}x{}", view.size.width, view.size.height));
}

void addRotationOption(CLI::App& command, Vec3d& rotationDegrees) {
    addParsedOption(command, "--rotate", rotationDegrees, parseTriple, "X,Y,Z",
                    "turn the light about the world's x axis, then y, then z, degrees")
        ->default_str("0,0,0");
}

DisplayOptionHandles addDisplayOptions(CLI::App& command, DisplayOptions& display,
                                       const std::string& note) {
    CLI::Option* exposure =
        command.add_option("--exposure", display.exposureStops, "brighten by so many stops" + note);
    exposure->check(CLI::Range(-100.0, 100.0).description(""))
        ->type_name("EV")
        ->capture_default_str();
    return {exposure, addToneOption(command, display.toneCurve, "tone curve" + note)};
}

CLI::Option* addToneOption(CLI::App& command, ToneCurve& toneCurve, const std::string& help) {
    return addParsedOption(command, "--tone", toneCurve, parseToneCurve, "none|aces|neutral", help)
        ->default_str(std::string(toneCurveName(toneCurve)));
}

Camera chooseCamera(const ViewArguments& view, const Scene& scene, const std::string& asset) {
    if (view.eye) {
        const double fovRadians = view.fovDegrees * std::numbers::pi / 180.0;
        return lookAt(Vec3f(*view.eye), Vec3f(view.target), static_cast<float>(fovRadians));
    }
    if (view.camera.empty()) {
        const float aspectRatio =
            static_cast<float>(view.size.width) / static_cast<float>(view.size.height);
        return scene.cameras.empty() ? frameScene(scene, aspectRatio) : scene.cameras.front();
    }
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == view.camera) return camera;
        names.push_back(camera.name);
    }
    throw Error(ErrorCode::invalidOption, fmt::format("has no camera named '{}'", view.camera),
                asset,
                names.empty() ? "it has no camera; use --eye and --target"
                              : fmt::format("its cameras: {}", fmt::join(names, ", ")));
}

}  // namespace prt::cli

#include "prt/io/scene_io.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "prt/base/error.h"
#include "prt/scene/check_scene.h"

namespace prt {
namespace {

std::string lowerCaseSuffix(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

Scene readScene(const std::filesystem::path& path, const SceneLimits& limits) {
    const std::string suffix = lowerCaseSuffix(path);
    if (suffix == ".gltf" || suffix == ".glb") return readGltf(path, limits.gltf);
    if (suffix == ".obj") return readObj(path);
    if (suffix == ".ply") return readPly(path);
    throw Error(ErrorCode::unsupported, "is not a scene file that we read", path.string(),
                "scenes are .gltf, .glb, .obj or .ply");
}

}  // namespace

Scene loadScene(const std::filesystem::path& path, const SceneLimits& limits) {
    Scene scene = readScene(path, limits);
    decodeTextures(scene, limits.textures);
    const std::vector<std::string> problems = findSceneProblems(scene);
    scene.warnings.insert(scene.warnings.end(), problems.begin(), problems.end());
    return scene;
}

}  // namespace prt

#include "prt/io/scene_io.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "prt/base/error.h"
#include "prt/gltf/gltf_scene.h"
#include "prt/io/image_io.h"

namespace prt {
namespace {

std::string lowerCaseSuffix(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

Scene readScene(const std::filesystem::path& path) {
    const std::string suffix = lowerCaseSuffix(path);
    if (suffix == ".gltf" || suffix == ".glb") return readGltf(path);
    if (suffix == ".obj") return readObj(path);
    if (suffix == ".ply") return readPly(path);
    throw Error(ErrorCode::unsupported, "is not a scene file that we read", path.string(),
                "scenes are .gltf, .glb, .obj or .ply");
}

}  // namespace

Scene loadScene(const std::filesystem::path& path) {
    Scene scene = readScene(path);
    decodeTextures(scene);
    return scene;
}

}  // namespace prt

#include "prt/gltf/model.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "prt/base/error.h"
#include "prt/gltf/meshopt.h"

namespace prt::gltf {
namespace {

constexpr std::string_view kQuantization = "KHR_mesh_quantization";

// Extensions that are read, or that change neither geometry nor base colour.
constexpr std::array<std::string_view, 20> kHarmlessExtensions = {
    kQuantization,
    kMeshoptExtension,
    "KHR_animation_pointer",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "OPENPRT_radiance_transfer",
};

bool isHarmless(const std::string& extension) {
    return std::find(kHarmlessExtensions.begin(), kHarmlessExtensions.end(), extension) !=
           kHarmlessExtensions.end();
}

/// The major version of "2.0"; anything else is not one of ours.
void checkVersion(const JsonCursor& root) {
    const JsonCursor asset = root.at("asset");
    const std::string& version = asset.at("version").toString();
    const bool isTwo = version.starts_with("2.") && version.size() > 2 &&
                       version.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!isTwo)
        throw Error(ErrorCode::unsupported, "is glTF of version \"" + version + "\", not 2");
    if (asset.stringOr("minVersion", "2.0") != "2.0")
        throw Error(ErrorCode::unsupported, "asks for a reader of a later version than glTF 2.0");
}

std::vector<std::string> parseNames(const JsonCursor& root, const char* key) {
    return parseEach(root, key, [](const JsonCursor& name) { return name.toString(); });
}

void checkExtensions(const JsonCursor& root, Warnings& warnings) {
    for (const std::string& name : parseNames(root, "extensionsRequired")) {
        if (isHarmless(name)) continue;
        const bool isCompression = name.find("compression") != std::string::npos;
        throw Error(ErrorCode::unsupported, "requires the extension \"" + name + "\"", {},
                    isCompression ? "store its meshes without compression"
                                  : "export it without that extension");
    }
    for (const std::string& name : parseNames(root, "extensionsUsed"))
        if (!isHarmless(name)) warnings.add("the extension \"" + name + "\" was left out");
}

/// How much may still be loaded after the glTF itself.
std::uintmax_t bytesLeft(const GltfLimits& limits, std::size_t fileBytes) {
    if (fileBytes > limits.maxFileBytes)
        throw Error(ErrorCode::limitExceeded, "has " + std::to_string(fileBytes) +
                                                  " bytes, more than the limit of " +
                                                  std::to_string(limits.maxFileBytes));
    return limits.maxFileBytes - fileBytes;
}

bool usesQuantization(const JsonCursor& root) {
    const std::vector<std::string> names = parseNames(root, "extensionsUsed");
    return std::find(names.begin(), names.end(), kQuantization) != names.end();
}

}  // namespace

Model::Model(std::vector<std::byte> fileBytes, const std::filesystem::path& folder,
             const GltfLimits& modelLimits)
    : limits(modelLimits),
      file(std::move(fileBytes)),
      json(parseJson(file.json)),
      loader(folder, bytesLeft(limits, file.bytes.size())) {
    checkVersion(root());
    if (file.trailingByteCount > 0)
        warnings.add(std::to_string(file.trailingByteCount) +
                     " bytes after the end that the header states were left out");
    checkExtensions(root(), warnings);
    buffers = loadBuffers(root(), file, loader);
    accessors = parseAccessors(root(), buffers.views, limits);
    materials = parseMaterials(root(), warnings);
    meshes = parseMeshes(root(), accessors, usesQuantization(root()));
    cameras = parseCameras(root());
    nodeTree = parseNodes(root());
    if (countElements(root(), "animations") > 0) warnings.add("animations were left out");
}

}  // namespace prt::gltf

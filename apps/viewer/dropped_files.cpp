#include "apps/viewer/dropped_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "apps/common/light_argument.h"
#include "apps/common/parse.h"
#include "apps/viewer/view_file.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::viewer {
namespace {

enum class FileUse { light, object, view };

/// Coefficients of a light are JSON as views are.
FileUse tellJson(const std::string& path) {
    constexpr std::uintmax_t kMaxJsonBytes = 16 << 20;
    const std::vector<std::byte> bytes = readFile(path, kMaxJsonBytes);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.find("\"coefficients\"") == std::string::npos ? FileUse::view : FileUse::light;
}

/// A folder with the faces of a cube is a light; of any other the first image by name is, beside
/// which the panel shows the rest.
std::string findLight(const std::string& path) {
    namespace fs = std::filesystem;
    if (!fs::is_directory(path)) return path;
    std::vector<std::string> images;
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
        const fs::path stem = entry.path().stem();
        if (stem == "px" || stem == "posx") return path;
        if (cli::isImageName(entry.path())) images.push_back(entry.path().string());
    }
    if (images.empty())
        throw Error(ErrorCode::unsupported, "has no image (.exr .hdr .png .jpg)", path);
    return *std::ranges::min_element(images);
}

std::optional<FileUse> tellUse(const std::string& path) {
    if (std::filesystem::is_directory(path)) return FileUse::light;
    const std::string suffix = cli::lowerSuffix(path);
    if (suffix == ".json") return tellJson(path);
    if (suffix == ".glb" || suffix == ".gltf") return FileUse::object;
    return cli::isImageName(path) ? std::optional(FileUse::light) : std::nullopt;
}

/// @param replacesLights  no longer, once a light has
std::string drop(ViewState& view, const std::string& path, const std::string& name,
                 bool& replacesLights) {
    const std::optional<FileUse> use = tellUse(path);
    if (!use)
        return name + " is neither an image (.exr .hdr .png .jpg), a baked asset (.glb) nor a " +
               "view (.json)";
    if (*use == FileUse::view) {
        view = loadView(path);
        return name + " is the view";
    }
    if (*use == FileUse::object) {
        view.objects.push_back({.asset = path});
        view.camera.reset();
        return name + " is added to the objects";
    }
    const std::string source = findLight(path);
    const std::string sourceName = std::filesystem::path(source).filename().string();
    if (!std::exchange(replacesLights, false)) {
        view.lights.push_back({.source = source});
        return sourceName + " is added to the light";
    }
    view.lights = {{.source = source}};
    return sourceName + " is the light";
}

}  // namespace

std::vector<std::string> dropFiles(ViewState& view, std::span<const std::string> files,
                                   const DropOptions& options) {
    std::vector<std::string> told;
    bool replacesLights = options.replacesLights;
    for (const std::string& path : files) {
        const std::string name = std::filesystem::path(path).filename().string();
        try {
            told.push_back(drop(view, path, name, replacesLights));
        } catch (const Error& error) {
            told.push_back(error.message());
        } catch (const std::filesystem::filesystem_error& failure) {
            told.push_back(name + ": " + failure.code().message());
        }
    }
    return told;
}

}  // namespace prt::viewer

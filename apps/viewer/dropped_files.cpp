#include "apps/viewer/dropped_files.h"

#include <filesystem>
#include <optional>
#include <utility>

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

std::optional<FileUse> tellUse(const std::string& path) {
    if (std::filesystem::is_directory(path)) return FileUse::light;
    const std::string suffix = cli::lowerSuffix(path);
    if (suffix == ".json") return tellJson(path);
    if (suffix == ".glb" || suffix == ".gltf") return FileUse::object;
    for (const char* image : {".exr", ".hdr", ".png", ".jpg", ".jpeg"})
        if (suffix == image) return FileUse::light;
    return std::nullopt;
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
    if (!std::exchange(replacesLights, false)) {
        view.lights.push_back({.source = path});
        return name + " is added to the light";
    }
    view.lights = {{.source = path}};
    return name + " is the light";
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

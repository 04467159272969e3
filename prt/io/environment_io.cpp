#include "prt/io/environment_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>
#include <system_error>

#include "prt/base/error.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

struct FaceName {
    std::string_view brief;
    std::string_view full;
};
// In the order of a strip (SphereMap::horizontalStrip).
constexpr std::array<FaceName, 6> kFaceNames = {{{"px", "posx"},
                                                 {"nx", "negx"},
                                                 {"py", "posy"},
                                                 {"ny", "negy"},
                                                 {"pz", "posz"},
                                                 {"nz", "negz"}}};
constexpr std::array<std::string_view, 5> kImageSuffixes = {".exr", ".hdr", ".png", ".jpg",
                                                            ".jpeg"};

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// The images of a folder by their lower-case names without suffix; of two
/// with one name the first in order.
std::map<std::string, fs::path> listImages(const fs::path& folder) {
    std::map<std::string, fs::path> images;
    std::error_code failure;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
        const std::string suffix = lowerCase(entry.path().extension().string());
        if (std::find(kImageSuffixes.begin(), kImageSuffixes.end(), suffix) == kImageSuffixes.end())
            continue;
        const auto [known, isNew] =
            images.try_emplace(lowerCase(entry.path().stem().string()), entry.path());
        if (!isNew) known->second = std::min(known->second, entry.path());
    }
    if (failure) throw Error(ErrorCode::unreadable, failure.message(), folder.string());
    return images;
}

fs::path findFace(const std::map<std::string, fs::path>& images, const FaceName& face,
                  const fs::path& folder) {
    for (const std::string_view name : {face.brief, face.full}) {
        const auto found = images.find(std::string(name));
        if (found != images.end()) return found->second;
    }
    throw Error(
        ErrorCode::notFound,
        "has no image of the face " + std::string(face.brief) + " or " + std::string(face.full),
        folder.string(), "name six square images px nx py ny pz nz");
}

Image readFaces(const fs::path& folder, const ImageLimits& limits) {
    const std::map<std::string, fs::path> images = listImages(folder);
    Image strip;
    for (std::size_t i = 0; i < kFaceNames.size(); ++i) {
        const fs::path path = findFace(images, kFaceNames[i], folder);
        const Image face = readImage(path, limits);
        if (face.width != face.height)
            throw Error(ErrorCode::malformed, "is not square, as a cube's face is", path.string());
        if (i == 0) strip = Image(6 * face.width, face.height, Vec3f(0.0f));
        if (face.height != strip.height)
            throw Error(ErrorCode::malformed, "is not as large as the first face", path.string());
        for (int y = 0; y < face.height; ++y)
            std::copy_n(&face.at(0, y), face.width, &strip.at(int(i) * face.width, y));
    }
    return strip;
}

SphereMap chooseMap(const Image& image, std::optional<SphereMap> wanted, const std::string& name) {
    if (wanted && fitsSphereMap(*wanted, image.width, image.height)) return *wanted;
    const std::optional<SphereMap> recognised = recogniseSphereMap(image.width, image.height);
    if (recognised && !wanted) return *recognised;
    const std::string shape =
        "has " + std::to_string(image.width) + " × " + std::to_string(image.height) + " pixels, ";
    if (wanted)
        throw Error(
            ErrorCode::malformed,
            shape + "which is not the shape of the layout " + std::string(sphereMapName(*wanted)),
            name);
    throw Error(ErrorCode::malformed, shape + "the shape of no environment layout", name,
                "lat-long images are 2 : 1, angular and octahedral maps square, crosses 3 : 4 or 4 "
                ": 3, strips "
                "1 : 6 or 6 : 1");
}

}  // namespace

LoadedEnvironment loadEnvironment(const std::filesystem::path& path, std::optional<SphereMap> map,
                                  const ImageLimits& limits) {
    LoadedEnvironment loaded;
    std::error_code failure;
    if (fs::is_directory(path, failure)) {
        if (map && *map != SphereMap::horizontalStrip)
            throw Error(ErrorCode::invalidOption, "is a folder of faces, which has its own layout",
                        path.string());
        loaded.environment = {SphereMap::horizontalStrip, readFaces(path, limits)};
    } else {
        loaded.environment.radiance = readImage(path, limits);
        loaded.environment.map = chooseMap(loaded.environment.radiance, map, path.string());
    }
    loaded.mended = sanitise(loaded.environment.radiance);
    return loaded;
}

}  // namespace prt

#include "prt/io/obj_materials.h"

#include <algorithm>
#include <system_error>

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/io/image_format.h"
#include "prt/io/text_parsing.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxLibraryBytes = std::uintmax_t(64) << 20;

bool liesWithin(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
           folder.end();
}

float clampToUnit(float value) {
    return std::clamp(value, 0.0f, 1.0f);
}

}  // namespace

void ObjMaterials::addLibraries(std::string_view fileNames) {
    // A name may hold blanks, and a statement may hold several names.
    if (addLibrary(trim(fileNames))) return;
    for (std::string_view name = takeWord(fileNames); !name.empty(); name = takeWord(fileNames))
        if (!addLibrary(name))
            scene_.warnings.push_back("the material library \"" + std::string(name) +
                                      "\" is not in the folder of the OBJ and was left out");
}

bool ObjMaterials::addLibrary(std::string_view fileName) {
    const std::optional<fs::path> path = findNeighbour(fileName);
    if (!path) return false;
    const std::vector<std::byte> bytes = readFile(*path, kMaxLibraryBytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (MtlMaterial& material : parseMtl(text, path->string()))
        libraryMaterials_.try_emplace(material.name, std::move(material));
    return true;
}

std::size_t ObjMaterials::use(const std::string& name) {
    const auto [entry, isNew] = usedMaterials_.try_emplace(name, scene_.materials.size());
    if (!isNew) return entry->second;
    const auto found = libraryMaterials_.find(name);
    if (found == libraryMaterials_.end() && !name.empty())
        scene_.warnings.push_back("the material \"" + name +
                                  "\" is in no library and became white");
    Material material;
    material.name = name.empty() ? "default" : name;
    if (found != libraryMaterials_.end()) convert(found->second, material);
    scene_.materials.push_back(std::move(material));
    return entry->second;
}

void ObjMaterials::convert(const MtlMaterial& source, Material& material) {
    material.emissiveFactor = source.emission;
    const Vec3f diffuse = source.diffuse.value_or(Vec3f(1.0f));
    material.baseColorFactor =
        Vec4f(clampToUnit(diffuse.x), clampToUnit(diffuse.y), clampToUnit(diffuse.z), 1.0f);
    if (source.isTransparent)
        scene_.warnings.push_back("the transparency of material \"" + source.name +
                                  "\" was left out");
    if (source.diffuseTexture.empty()) return;
    if (const std::optional<std::size_t> image = loadTexture(source.diffuseTexture)) {
        const TextureWrap wrap =
            source.clampsTexture ? TextureWrap::clampToEdge : TextureWrap::repeat;
        material.baseColorTexture = TextureUse{.image = *image, .wrapU = wrap, .wrapV = wrap};
    }
}

std::optional<std::size_t> ObjMaterials::loadTexture(const std::string& fileName) {
    const auto leaveOut = [&](const std::string& why) {
        scene_.warnings.push_back("the texture \"" + fileName + "\" " + why + " and was left out");
        return std::nullopt;
    };
    const std::optional<fs::path> path = findNeighbour(fileName);
    if (!path) return leaveOut("is not in the folder of the OBJ");
    const auto [entry, isNew] = usedImages_.try_emplace(*path, scene_.images.size());
    if (!isNew) return entry->second;

    TextureImage image;
    image.name = fileName;
    image.encoded = readFile(*path, ImageLimits().maxFileBytes);
    const std::optional<ImageFormat> format = recogniseImageFormat(image.encoded);
    if (format != ImageFormat::png && format != ImageFormat::jpeg) {
        usedImages_.erase(entry);
        return leaveOut("is neither PNG nor JPEG");
    }
    image.mimeType = format == ImageFormat::png ? "image/png" : "image/jpeg";
    scene_.images.push_back(std::move(image));
    return scene_.images.size() - 1;
}

/// The file of this name in the folder of the OBJ or below it; nothing if there
/// is none, or if it is elsewhere.
std::optional<fs::path> ObjMaterials::findNeighbour(std::string_view fileName) const {
    std::string name(fileName);
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.empty() || name.find('\0') != std::string::npos) return std::nullopt;
    // Canonical paths show where "..", absolute names and symbolic links really lead.
    std::error_code failure;
    const fs::path folder = fs::canonical(folder_, failure);
    if (failure) return std::nullopt;
    const fs::path file = fs::canonical(folder_ / name, failure);
    if (failure || !liesWithin(folder, file) || !fs::is_regular_file(file, failure))
        return std::nullopt;
    return file;
}

}  // namespace prt

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "prt/io/mtl_parser.h"
#include "prt/scene/scene.h"

namespace prt {

/// The materials of an OBJ file, brought into a scene as they are used.
///
/// Kd becomes the base colour (linear, clamped to [0, 1]; white if absent), Ke the
/// emission, and map_Kd the base colour texture. Transparency is left out. So is a library
/// or texture that is missing, or not of a format we read, or outside the folder of the
/// OBJ. The scene's warnings say so.
class ObjMaterials {
  public:
    /// @param folder  where the OBJ lies
    /// @param scene   receives materials, images and warnings
    ObjMaterials(const std::filesystem::path& folder, Scene& scene)
        : folder_(folder.empty() ? std::filesystem::path(".") : folder), scene_(scene) {}

    /// Reads the libraries that an mtllib statement names.
    ///
    /// @throws Error  malformed, naming the library
    void addLibraries(std::string_view fileNames);

    /// The index in the scene of the material with this name; of a
    /// default one if no library has it.
    std::size_t use(const std::string& name);

  private:
    bool addLibrary(std::string_view fileName);
    void convert(const MtlMaterial& source, Material& material);
    std::optional<std::size_t> loadTexture(const std::string& fileName);
    std::optional<std::filesystem::path> findNeighbour(std::string_view fileName) const;

    std::filesystem::path folder_;
    Scene& scene_;
    std::map<std::string, MtlMaterial> libraryMaterials_;
    std::map<std::string, std::size_t> usedMaterials_;
    std::map<std::filesystem::path, std::size_t> usedImages_;
};

}  // namespace prt

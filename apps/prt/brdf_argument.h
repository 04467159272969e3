#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/common/given_brdfs.h"
#include "prt/brdf/brdf.h"
#include "prt/scene/scene.h"

namespace prt::cli {

/// The forms of SPEC, for --help.
inline constexpr const char* kBrdfHelp = R"(SPEC is one of
  lambert:r,g,b            a matt surface of this albedo
  phong:r,g,b,exponent     a Phong lobe that reflects this much of white light along the normal
  ggx:r,g,b,roughness      GGX microfacets of this reflectance along the normal (F0)
  gltf:r,g,b,metallic,roughness
                           a glTF material of this base colour
  merl:FILE.binary         as measured: a file of the MERL database
where r, g, b, metallic and roughness are from 0 to 1)";

/// What a SPEC stands for.
struct BrdfSource {
    Brdf brdf;
    std::size_t negativeCount = 0;         ///< values of a measured one that became 0
    std::optional<double> ggxRoughness{};  ///< where it is a GGX lobe alone
};

/// Reads a SPEC.
///
/// @throws Error  invalidOption for a malformed one; as readMerlBrdf
BrdfSource loadBrdf(const std::string& spec);

/// One --brdf: what a material is made of in place of what its file says.
struct BrdfArgument {
    std::optional<std::string> material{};  ///< its name; none: all that no other argument names
    Brdf brdf;
};

/// Adds --brdf, which may be given again and reads the files it names.
void addBrdfOption(CLI::App& command, std::vector<BrdfArgument>& arguments);

/// What each material of a scene is made of, where an argument says it: one a material, or nothing
/// at all without arguments.
///
/// @param scenePath  how to call the scene in an error
/// @throws Error     invalidOption if no material has a name, or a name comes twice
GivenBrdfs resolveBrdfs(const Scene& scene, std::span<const BrdfArgument> arguments,
                        const std::string& scenePath);

}  // namespace prt::cli

#pragma once

#include <string>

#include "apps/prt/bake_options.h"
#include "prt/scene/scene.h"
#include "prt/transport/reflection.h"

namespace prt::cli {

/// How surfaces reflect with --brdf, as a checkpoint knows it again.
struct BakeReflection {
    SurfaceReflection reflection{};  ///< empty: as the scene says
    std::string setting{};           ///< the options, and a fingerprint of what they mean
};

/// @param scene    must outlive it
/// @throws Error   as resolveBrdfs
BakeReflection makeBakeReflection(const Scene& scene, const BakeArguments& arguments);

/// The options again, each with a space before it: of a file the name without its folder.
std::string describeBrdfs(const BakeArguments& arguments);

}  // namespace prt::cli

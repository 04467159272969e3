#pragma once

#include <string>
#include <vector>

#include "prt/scene/scene.h"

namespace prt {

/// What is odd in a scene that can be baked all the same, one sentence with a count each; empty for
/// a sound one: triangles without area, which no ray meets; triangles that lie exactly on others;
/// vertices of no triangle with an area, which are baked as points that face along their normals.
std::vector<std::string> findSceneProblems(const Scene& scene);

}  // namespace prt

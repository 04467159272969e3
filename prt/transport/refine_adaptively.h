#pragma once

#include <cstdint>
#include <optional>

#include "prt/math/isa.h"
#include "prt/parallel/progress.h"
#include "prt/scene/scene.h"

namespace prt {

struct AdaptiveRefineOptions {
    float maxError = 0.05f;      ///< of the transfer of an open surface; see refineAdaptively
    float minEdgeLength = 0.0f;  ///< metres; no shorter edge is made; 0: defaultMinEdgeLength
    std::size_t maxVertexCount = 20'000'000;  ///< stop, worst edges first, before there are more
    int bandCount = 5;                        ///< those of the bake to come
    int sampleCount = 1024;                   ///< rays a tested point, 16 … 65536
    std::uint64_t seed = 1;
    int threadCount = 0;       ///< 0: one a core
    std::optional<Isa> isa{};  ///< pins the instruction set (C10)
    ProgressCallback progress{};
};

/// What adaptive refinement did.
struct AdaptiveRefineStats {
    int passCount = 0;
    std::size_t testedEdgeCount = 0;
    bool ranOutOfVertices = false;  ///< maxVertexCount ended it, not maxError or minEdgeLength
};

/// A 256th of the radius of the scene's bounds.
float defaultMinEdgeLength(const Scene& scene);

/// Puts vertices where transfer is not linear: at the edges of shadows, in corners, at contacts.
///
/// Shadowed transfer is computed in the middle of every edge (a, b) and compared with what a
/// renderer would interpolate there. The edge is halved where
///
///   ‖T(m) − ½ (T(a) + T(b))‖ > maxError ‖T_open‖                            [Krivanek04]
///
/// with T_open the transfer of a surface that sees the whole sky; the new edges are tested in
/// turn. With each edge the longest of its triangles are halved too, so that angles do not become
/// ever smaller [Rivara84]. An edge is judged by its end positions alone, as in refineEdges, so
/// that no cracks open. Bounces are smoother than direct light and are not looked at.
///
/// @param scene    as its reader promises; its edges short enough for no shadow to be missed
///                 between the ends and the middle of one (refineEdges)
/// @throws Error   invalidOption, cancelled
Scene refineAdaptively(const Scene& scene, const AdaptiveRefineOptions& options = {},
                       AdaptiveRefineStats* stats = nullptr);

}  // namespace prt

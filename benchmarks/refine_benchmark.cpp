// What a vertex is worth: the error of interpolated transfer over a scene's surface against the
// number of vertices, for edges of one greatest length and for adaptive refinement.
//
//   refine_benchmark [SCENE]        default: the procedural teapot

#include <cmath>
#include <cstdio>

#include "prt/base/error.h"
#include "prt/io/scene_io.h"
#include "prt/scene/procedural.h"
#include "prt/scene/refine.h"
#include "prt/transport/bake.h"
#include "prt/transport/interpolation_error.h"
#include "prt/transport/refine_adaptively.h"

namespace {

using namespace prt;

void printError(const char* method, double limit, const Scene& scene) {
    const TransferField field = bakeTransfer(scene, {.transport = Transport::shadowed});
    const InterpolationError error = measureInterpolationError(scene, field);
    std::printf("%-9s %9.4f %9zu %9.4f %9.4f\n", method, limit, scene.vertexCount(), error.rms,
                error.percentile99);
    std::fflush(stdout);
}

void compare(const Scene& scene) {
    const float coarse = defaultMaxEdgeLength(scene);
    const Scene start = refineEdges(scene, {.maxEdgeLength = coarse});
    std::printf("method        limit  vertices       rms      99 %%   of open transfer\n");
    for (int i = 0; i <= 6; ++i) {
        const float length = coarse * std::exp2(-0.5f * static_cast<float>(i));
        printError("uniform", length, refineEdges(scene, {.maxEdgeLength = length}));
    }
    for (const float error : {0.2f, 0.1f, 0.05f, 0.025f})
        printError("adaptive", error, refineAdaptively(start, {.maxError = error}));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        compare(argc > 1 ? loadScene(argv[1]) : makeProceduralScene("teapot"));
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}

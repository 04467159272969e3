#pragma once

#include <cstdint>
#include <vector>

#include "prt/base/random.h"
#include "prt/transport/gather_kernels.h"
#include "prt/transport/receivers.h"
#include "prt/transport/transfer_matrices.h"

namespace prt::test {

/// A receiver's 1024 rays, blocked or not, as matrices are gathered along them.
inline RayStream traceUniformRays(const RayScene& rays, const Receiver& site, std::uint64_t seed) {
    RandomStream random(seed, site.randomStream);
    const std::uint32_t seedX = random.nextBits();
    RayStream stream(1024);
    selectGatherKernels(detectIsa())
        .sampleUniformDirections(SamplePattern(1024), {seedX, random.nextBits(), site.normal},
                                 stream);
    stream.restart(site.origin);
    rays.findOccluded(stream);
    return stream;
}

inline Vec3f directionOf(const RayStream& rays, std::size_t ray) {
    return {rays.directionX[ray], rays.directionY[ray], rays.directionZ[ray]};
}

inline std::vector<float> matrixOfVertex(const TransferMatrices& baked, std::size_t vertex) {
    std::vector<float> matrix(baked.matrices.columnCount());
    baked.matrices.readRow(baked.receiverOfVertex[vertex], std::span(matrix));
    return matrix;
}

}  // namespace prt::test

#include "prt/transport/matrix_gatherer.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/frame.h"
#include "prt/transport/stopwatch.h"

namespace prt {
namespace {

constexpr std::size_t kChannelCount = 3;

std::size_t countCoefficients(int bandCount) {
    return static_cast<std::size_t>(shCoefficientCount(bandCount));
}

}  // namespace

MatrixGatherer::MatrixGatherer(const MatrixGatherScene& shared)
    : shared_(shared),
      rowCount_(countCoefficients(shared.visibilityMatrix.incidentBandCount())),
      columnCount_(countCoefficients(shared.visibilityMatrix.bandCount())),
      rays_(shared.pattern.reversedX.size()),
      visibility_(countCoefficients(shared.visibilityMatrix.visibilityBandCount())),
      scratch_(shared.visibilityMatrix.elementCount()),
      stride_(padToLanes(columnCount_)),
      response_(kChannelCount * rowCount_),
      cornerResponse_(kChannelCount * rowCount_),
      radiance_(kChannelCount * stride_),
      basis_(rowCount_),
      reflected_(kChannelCount * rowCount_ * stride_) {
    firstTriangle_.push_back(0);
    for (const Mesh& mesh : shared.scene.scene.meshes)
        firstTriangle_.push_back(firstTriangle_.back() + mesh.triangleCount());
}

void MatrixGatherer::gatherVisible(std::uint32_t receiver, std::span<float> matrix) {
    const Receiver& site = receiverSite(shared_.scene.receivers, receiver);
    {
        const Stopwatch watch(counts_.accumulateSeconds);
        RandomStream random(shared_.seed, site.randomStream);
        const std::uint32_t seedX = random.nextBits();
        shared_.kernels.sampleUniformDirections(shared_.pattern,
                                                {seedX, random.nextBits(), site.normal}, rays_);
        rays_.restart(site.origin);
    }
    {
        const Stopwatch watch(counts_.traceSeconds);
        counts_.rayCount += rays_.size();
        counts_.invalidRayCount += shared_.scene.rays.findOccluded(rays_);
    }
    const Stopwatch watch(counts_.accumulateSeconds);
    // v_k = 2π E[V y_k], for uniform directions have the density 1/2π.
    shared_.kernels.sumVisible(rays_, shared_.visibilityMatrix.visibilityBandCount(), visibility_);
    const float weight = 2.0f * std::numbers::pi_v<float> / static_cast<float>(rays_.size());
    for (float& coefficient : visibility_)
        coefficient *= weight;
    shared_.visibilityMatrix.make(visibility_, site.normal, scratch_, matrix);
}

/// Looks for the surfaces along blocked rays.
void MatrixGatherer::findHits() {
    const Stopwatch watch(counts_.traceSeconds);
    blockedRays_.clear();
    for (std::uint32_t i = 0; i < rays_.size(); ++i)
        if (rays_.tFar[i] < 0.0f) blockedRays_.push_back(i);
    hits_.resize(blockedRays_.size());
    shared_.scene.rays.findClosest(rays_, blockedRays_, hits_);
    counts_.hitCount += hits_.size();
}

void MatrixGatherer::addReflected(std::uint32_t receiver, std::span<const float> sources,
                                  std::span<float> matrix) {
    PRT_ASSERT(matrix.size() == kChannelCount * rowCount_ * columnCount_, "one matrix a channel");
    findHits();
    const Stopwatch watch(counts_.accumulateSeconds);
    const Frame<float> frame =
        frameFromNormal(receiverSite(shared_.scene.receivers, receiver).normal);
    const std::size_t channelSize = rowCount_ * stride_;
    std::fill(reflected_.begin(), reflected_.end(), 0.0f);
    for (std::size_t h = 0; h < hits_.size(); ++h) {
        const std::uint32_t ray = blockedRays_[h];
        const Vec3f direction(rays_.directionX[ray], rays_.directionY[ray], rays_.directionZ[ray]);
        if (!findRadiance(hits_[h], direction, sources)) continue;
        evaluateSh(frame.localFromWorld(direction), shared_.visibilityMatrix.incidentBandCount(),
                   basis_);
        for (std::size_t channel = 0; channel < kChannelCount; ++channel)
            shared_.kernels.addOuterProduct(
                basis_, std::span(radiance_).subspan(channel * stride_, stride_),
                reflected_.data() + channel * channelSize);
    }
    const float weight = 2.0f * std::numbers::pi_v<float> / static_cast<float>(rays_.size());
    for (std::size_t row = 0; row < kChannelCount * rowCount_; ++row)
        for (std::size_t j = 0; j < columnCount_; ++j)
            matrix[row * columnCount_ + j] += weight * reflected_[row * stride_ + j];
}

/// Writes what a surface sends back along a ray, interpolated between its corners, each of which
/// has a frame of its own.
///
/// @return  whether it reflects at all
bool MatrixGatherer::findRadiance(const Hit& hit, const Vec3f& direction,
                                  std::span<const float> sources) {
    if (hit.escaped) return false;  // not finite, or lost between the two queries: dark
    const GatherScene& scene = shared_.scene;
    const Mesh& mesh = scene.scene.meshes[hit.point.mesh];
    if (hit.backFace && !scene.scene.materials[mesh.material].doubleSided) return false;  // C11

    std::fill(radiance_.begin(), radiance_.end(), 0.0f);
    const std::array<float, 3> weights = {1.0f - hit.point.u - hit.point.v, hit.point.u,
                                          hit.point.v};
    const std::array<std::uint32_t, 3>& fronts =
        scene.receivers.frontsOfTriangle[firstTriangle_[hit.point.mesh] + hit.point.triangle];
    Vec3f lastNormal(0.0f, 0.0f, 0.0f);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner =
            hit.backFace ? backReceiver(scene.receivers, fronts[k]) : fronts[k];
        const Vec3f& normal = receiverSite(scene.receivers, corner).normal;
        if (k == 0 || normal != lastNormal) {
            std::fill(response_.begin(), response_.end(), 0.0f);
            shared_.reflection(hit.point, frameFromNormal(normal).localFromWorld(-direction),
                               response_);
        }
        lastNormal = normal;
        std::transform(response_.begin(), response_.end(), cornerResponse_.begin(),
                       [&](float coefficient) { return weights[k] * coefficient; });
        for (std::size_t channel = 0; channel < kChannelCount; ++channel)
            shared_.kernels.addProduct(
                std::span(cornerResponse_).subspan(channel * rowCount_, rowCount_),
                sources.data() + (corner * kChannelCount + channel) * rowCount_ * columnCount_,
                columnCount_, radiance_.data() + channel * stride_);
    }
    return true;
}

}  // namespace prt

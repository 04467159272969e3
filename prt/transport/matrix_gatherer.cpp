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

/// sum += factor · addend.
void addScaled(float factor, std::span<const float> addend, float* sum) {
    for (std::size_t i = 0; i < addend.size(); ++i)
        sum[i] += factor * addend[i];
}

}  // namespace

MatrixGatherer::MatrixGatherer(const MatrixGatherScene& shared)
    : shared_(shared),
      rowCount_(countCoefficients(shared.visibilityMatrix.incidentBandCount())),
      columnCount_(countCoefficients(shared.visibilityMatrix.bandCount())),
      rays_(shared.pattern.reversedX.size()),
      visibility_(countCoefficients(shared.visibilityMatrix.visibilityBandCount())),
      scratch_(shared.visibilityMatrix.elementCount()),
      response_(kChannelCount * rowCount_),
      radiance_(kChannelCount * columnCount_),
      basis_(rowCount_) {
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

void MatrixGatherer::addReflected(std::uint32_t receiver, std::span<const float> sources,
                                  std::span<float> matrix) {
    PRT_ASSERT(matrix.size() == kChannelCount * rowCount_ * columnCount_, "one matrix a channel");
    const Frame<float> frame =
        frameFromNormal(receiverSite(shared_.scene.receivers, receiver).normal);
    {
        const Stopwatch watch(counts_.traceSeconds);
        blockedRays_.clear();
        for (std::uint32_t i = 0; i < rays_.size(); ++i)
            if (rays_.tFar[i] < 0.0f) blockedRays_.push_back(i);
        hits_.resize(blockedRays_.size());
        shared_.scene.rays.findClosest(rays_, blockedRays_, hits_);
        counts_.hitCount += hits_.size();
    }
    const Stopwatch watch(counts_.accumulateSeconds);
    const float weight = 2.0f * std::numbers::pi_v<float> / static_cast<float>(rays_.size());
    for (std::size_t h = 0; h < hits_.size(); ++h) {
        const std::uint32_t ray = blockedRays_[h];
        const Vec3f direction(rays_.directionX[ray], rays_.directionY[ray], rays_.directionZ[ray]);
        if (!findRadiance(hits_[h], direction, sources)) continue;
        evaluateSh(frame.localFromWorld(direction), shared_.visibilityMatrix.incidentBandCount(),
                   basis_);
        for (std::size_t channel = 0; channel < kChannelCount; ++channel) {
            const auto radiance =
                std::span(radiance_).subspan(channel * columnCount_, columnCount_);
            for (std::size_t i = 0; i < rowCount_; ++i)
                addScaled(weight * basis_[i], radiance,
                          matrix.data() + (channel * rowCount_ + i) * columnCount_);
        }
    }
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
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner =
            hit.backFace ? backReceiver(scene.receivers, fronts[k]) : fronts[k];
        const Frame<float> frame = frameFromNormal(receiverSite(scene.receivers, corner).normal);
        std::fill(response_.begin(), response_.end(), 0.0f);
        shared_.reflection(hit.point, frame.localFromWorld(-direction), response_);
        // Rows of all channels and coefficients lie one after the other, as responses do.
        const float* row = sources.data() + corner * response_.size() * columnCount_;
        for (std::size_t i = 0; i < response_.size(); ++i, row += columnCount_)
            if (response_[i] != 0.0f)
                addScaled(weights[k] * response_[i], std::span(row, columnCount_),
                          radiance_.data() + i / rowCount_ * columnCount_);
    }
    return true;
}

}  // namespace prt

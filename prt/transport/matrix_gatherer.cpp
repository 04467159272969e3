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
      rays_(shared.pattern.reversedX.size()),
      visibility_(countCoefficients(shared.visibilityMatrix.visibilityBandCount())),
      scratch_(shared.visibilityMatrix.elementCount()),
      response_(kChannelCount * rowCount_),
      cornerResponse_(kChannelCount * rowCount_),
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

bool MatrixGatherer::reflects(const Hit& hit) const {
    if (hit.escaped) return false;  // not finite, or lost between the two queries: dark
    const Scene& scene = shared_.scene.scene;
    const Mesh& mesh = scene.meshes[hit.point.mesh];
    return !hit.backFace || scene.materials[mesh.material].doubleSided;  // C11
}

const std::array<std::uint32_t, 3>& MatrixGatherer::frontsAt(const Hit& hit) const {
    return shared_.scene.receivers
        .frontsOfTriangle[firstTriangle_[hit.point.mesh] + hit.point.triangle];
}

void MatrixGatherer::appendBacksMet(std::vector<std::uint32_t>& backs) {
    findHits();
    for (const Hit& hit : hits_)
        if (hit.backFace && reflects(hit))
            backs.insert(backs.end(), frontsAt(hit).begin(), frontsAt(hit).end());
}

void MatrixGatherer::addReflected(std::uint32_t receiver, const MatrixSources& sources,
                                  std::span<float> matrix) {
    const std::size_t columnCount = sources.columns.count();
    PRT_ASSERT(matrix.size() == kChannelCount * rowCount_ * columnCount, "one matrix a channel");
    findHits();
    const Stopwatch watch(counts_.accumulateSeconds);
    const Frame<float> frame =
        frameFromNormal(receiverSite(shared_.scene.receivers, receiver).normal);
    const std::size_t stride = padToLanes(columnCount);
    const std::size_t channelSize = rowCount_ * stride;
    radiance_.resize(kChannelCount * stride);
    reflected_.assign(kChannelCount * channelSize, 0.0f);
    for (std::size_t h = 0; h < hits_.size(); ++h) {
        if (h + 1 < hits_.size()) prefetchSources(hits_[h + 1], sources);
        if (!reflects(hits_[h])) continue;
        const std::uint32_t ray = blockedRays_[h];
        const Vec3f direction(rays_.directionX[ray], rays_.directionY[ray], rays_.directionZ[ray]);
        findRadiance(hits_[h], direction, sources, stride);
        evaluateSh(frame.localFromWorld(direction), shared_.visibilityMatrix.incidentBandCount(),
                   basis_);
        for (std::size_t channel = 0; channel < kChannelCount; ++channel)
            shared_.kernels.addOuterProduct(basis_,
                                            std::span(radiance_).subspan(channel * stride, stride),
                                            reflected_.data() + channel * channelSize);
    }
    const float weight = 2.0f * std::numbers::pi_v<float> / static_cast<float>(rays_.size());
    for (std::size_t row = 0; row < kChannelCount * rowCount_; ++row)
        for (std::size_t j = 0; j < columnCount; ++j)
            matrix[row * columnCount + j] += weight * reflected_[row * stride + j];
}

/// Has the memory under way while the hit before is at work: it is what a bounce waits for.
void MatrixGatherer::prefetchSources(const Hit& hit, const MatrixSources& sources) const {
    constexpr std::size_t kCacheLine = 64 / sizeof(float);
    if (!reflects(hit)) return;
    const std::size_t length = kChannelCount * rowCount_ * sources.columns.count();
    for (const std::uint32_t front : frontsAt(hit)) {
        const std::uint32_t row = hit.backFace ? sources.rowOfBack[front] : front;
        if (row == kNoRow) continue;
        for (std::size_t i = 0; i < length; i += kCacheLine)
            __builtin_prefetch(sources.values + row * length + i, 0, 2);  // into L2
    }
}

/// Writes what a surface sends back along a ray, interpolated between its corners, each of which
/// has a frame of its own.
void MatrixGatherer::findRadiance(const Hit& hit, const Vec3f& direction,
                                  const MatrixSources& sources, std::size_t stride) {
    const Receivers& receivers = shared_.scene.receivers;
    const std::size_t columnCount = sources.columns.count();
    std::fill(radiance_.begin(), radiance_.end(), 0.0f);
    const std::array<float, 3> weights = {1.0f - hit.point.u - hit.point.v, hit.point.u,
                                          hit.point.v};
    Vec3f lastNormal(0.0f, 0.0f, 0.0f);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t front = frontsAt(hit)[k];
        const std::uint32_t row = hit.backFace ? sources.rowOfBack[front] : front;
        if (row == kNoRow) continue;
        const std::uint32_t corner = hit.backFace ? backReceiver(receivers, front) : front;
        const Vec3f& normal = receiverSite(receivers, corner).normal;
        if (normal != lastNormal) {
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
                sources.values + (row * kChannelCount + channel) * rowCount_ * columnCount,
                columnCount, radiance_.data() + channel * stride);
    }
}

}  // namespace prt

// What a bake costs beside its rays: the gather, with everything it does, against a bare Embree
// loop that makes the same queries on the same rays, block by block in one thread; each bounce
// against the closest-hit queries; and a whole bake, from file to file, against the bare rays.
//
//   bake_benchmark [SCENE]        default: the procedural teapot

#include <embree3/rtcore.h>
#include <time.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/basis/sh.h"
#include "prt/compress/compress_transfer.h"
#include "prt/gltf/glb_writer.h"
#include "prt/io/scene_io.h"
#include "prt/scene/procedural.h"
#include "prt/scene/refine.h"
#include "prt/transport/bake.h"
#include "prt/transport/bounce.h"
#include "prt/transport/gather.h"

namespace {

using namespace prt;

constexpr int kBandCount = 5;
constexpr std::size_t kSampleCount = 1024;
constexpr std::size_t kBlockSize = 64;

/// Time spent on a core by this thread or process: what others do on the machine does not count.
double readClock(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double threadSeconds() {
    return readClock(CLOCK_THREAD_CPUTIME_ID);
}

double processSeconds() {
    return readClock(CLOCK_PROCESS_CPUTIME_ID);
}

/// The scene in Embree and nothing else, in the tracer's coordinates.
class BareTracer {
  public:
    BareTracer(const Scene& scene, const RayScene& rays)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (const Mesh& mesh : scene.meshes) {
            const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertexCount()));
            auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangleCount()));
            for (const Vec3f& position : mesh.positions) {
                const Vec3f point = rays.tracePoint(position);
                positions = std::copy_n(&point.x, 3, positions);
            }
            std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene_, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcCommitScene(scene_);
    }
    BareTracer(const BareTracer&) = delete;
    BareTracer& operator=(const BareTracer&) = delete;
    ~BareTracer() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    double timeOccluded(RayStream& rays) const {
        RTCRayNp stream{};
        stream.org_x = rays.originX.data();
        stream.org_y = rays.originY.data();
        stream.org_z = rays.originZ.data();
        stream.dir_x = rays.directionX.data();
        stream.dir_y = rays.directionY.data();
        stream.dir_z = rays.directionZ.data();
        stream.tfar = rays.tFar.data();
        RTCIntersectContext context = makeContext();
        const double begin = threadSeconds();
        rtcOccludedNp(scene_, &context, &stream, static_cast<unsigned>(rays.size()));
        return threadSeconds() - begin;
    }

    double timeClosest(const RayStream& rays) const {
        std::vector<RTCRayHit16> packets;
        std::size_t lane = 16;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (rays.tFar[i] > 0.0f) continue;
            if (lane == 16) {
                packets.emplace_back();
                lane = 0;
            }
            RTCRayHit16& packet = packets.back();
            packet.ray.org_x[lane] = rays.originX[i];
            packet.ray.org_y[lane] = rays.originY[i];
            packet.ray.org_z[lane] = rays.originZ[i];
            packet.ray.dir_x[lane] = rays.directionX[i];
            packet.ray.dir_y[lane] = rays.directionY[i];
            packet.ray.dir_z[lane] = rays.directionZ[i];
            packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
            packet.ray.mask[lane] = ~0u;
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            ++lane;
        }
        RTCIntersectContext context = makeContext();
        alignas(64) int valid[16];
        std::fill_n(valid, 16, -1);
        const double begin = threadSeconds();
        for (std::size_t i = 0; i < packets.size(); ++i) {
            if (i + 1 == packets.size()) std::fill(valid + lane, valid + 16, 0);
            rtcIntersect16(valid, scene_, &context, &packets[i]);
        }
        return threadSeconds() - begin;
    }

  private:
    static RTCIntersectContext makeContext() {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        return context;
    }

    RTCDevice device_;
    RTCScene scene_;
};

struct Timings {
    double occludedSeconds = 0.0;
    double closestSeconds = 0.0;
    double gatherSeconds = 0.0;
};

/// Prints the parts of a bake. @return  CPU seconds of the bare rays
double measureParts(const Scene& scene) {
    const RayScene rays(scene);
    const BareTracer bare(scene, rays);
    const Receivers receivers = placeReceivers(scene, rays);
    const GatherKernels kernels = selectGatherKernels(detectIsa());
    const SamplePattern pattern(kSampleCount);
    const GatherScene gatherScene{scene, rays, receivers};
    const std::size_t receiverCount = receivers.fronts.size();
    const auto n = static_cast<std::size_t>(shCoefficientCount(kBandCount));

    // Gather block by block, each time beside the bare rays, so that both see the same machine.
    Timings timings;
    std::vector<float> direct(receiverCount * n);
    HitMatrix matrix(std::size_t(8) << 30, {});
    RayStream stream(kSampleCount);
    GatherCounts counts;
    for (std::uint32_t begin = 0; begin < receiverCount; begin += kBlockSize) {
        const auto end =
            static_cast<std::uint32_t>(std::min<std::size_t>(receiverCount, begin + kBlockSize));
        for (std::uint32_t i = begin; i < end; ++i) {
            kernels.sampleDirections(pattern, {i, ~i, receivers.fronts[i].normal}, stream);
            stream.restart(receivers.fronts[i].origin);
            timings.occludedSeconds += bare.timeOccluded(stream);
            timings.closestSeconds += bare.timeClosest(stream);
        }
        const double gatherBegin = threadSeconds();
        Gatherer gatherer(gatherScene, kernels, pattern, {kBandCount, kSampleCount, 1, true});
        HitSlab slab;
        for (std::uint32_t i = begin; i < end; ++i)
            gatherer.gather(i, std::span(direct).subspan(i * n, n), slab);
        counts += gatherer.counts();
        matrix.addSlab(std::move(slab));
        timings.gatherSeconds += threadSeconds() - gatherBegin;
    }

    // Bounce on what the rays have hit.
    constexpr int kBounceCount = 8;
    CoefficientTable total(receiverCount, 3 * n, sizeof(float));
    const ProgressCallback none;
    const double bounceBegin = threadSeconds();
    addBounces(matrix, {makeTable(n, direct)}, kernels,
               {.bounceCount = kBounceCount, .threadCount = 1, .progress = none}, total);
    const double bounceSeconds = (threadSeconds() - bounceBegin) / kBounceCount;

    const double bareSeconds = timings.occludedSeconds + timings.closestSeconds;
    const auto rayCount = static_cast<double>(counts.rayCount);
    std::printf(
        "receivers %zu, rays %.1f M (%.1f %% blocked), %d bands, %zu MB of hits, one thread, CPU "
        "time\n",
        receiverCount, rayCount * 1e-6, 100.0 * static_cast<double>(counts.hitCount) / rayCount,
        kBandCount, matrix.entryBytes() >> 20);
    std::printf("bare Embree   occluded %7.3f s  %6.2f Mrays/s   closest %7.3f s  %6.2f Mrays/s\n",
                timings.occludedSeconds, rayCount / timings.occludedSeconds * 1e-6,
                timings.closestSeconds,
                static_cast<double>(counts.hitCount) / timings.closestSeconds * 1e-6);
    std::printf("gather        %7.3f s   trace %.3f s   accumulate %.3f s\n", timings.gatherSeconds,
                counts.traceSeconds, counts.accumulateSeconds);
    std::printf("gather / bare Embree            %.3f   (to hold: 1.15)\n",
                timings.gatherSeconds / bareSeconds);
    std::printf("a bounce      %7.3f s\n", bounceSeconds);
    std::printf("a bounce / closest-hit queries  %.3f   (to hold: 0.05)\n",
                bounceSeconds / timings.closestSeconds);
    return bareSeconds;
}

/// Reads, bakes with two bounces and writes. @return  CPU seconds, of all threads
double measureFileToFile(const std::filesystem::path& path) {
    const std::filesystem::path output =
        std::filesystem::temp_directory_path() / "openprt_bake_benchmark.prt.glb";
    const double begin = processSeconds();
    const Scene scene = loadScene(path);
    const BakeOptions options = {.bandCount = kBandCount, .sampleCount = int(kSampleCount)};
    const TransferField field = bakeTransfer(scene, options);
    writeFileAtomically(output, encodeAsset(scene, compressTransfer(field), Provenance{}));
    const double seconds = processSeconds() - begin;
    std::filesystem::remove(output);
    return seconds;
}

/// The procedural teapot as a file, for those who have no scene at hand.
std::filesystem::path writeTeapot() {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / "openprt_bake_benchmark.glb";
    writeFileAtomically(path, encodeGlb(refineEdges(makeProceduralScene("teapot"))));
    return path;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::filesystem::path path = argc > 1 ? argv[1] : writeTeapot();
        const double bareSeconds = measureParts(loadScene(path));
        const double fileToFileSeconds = measureFileToFile(path);
        if (argc == 1) std::filesystem::remove(path);
        std::printf("file to file  %7.3f s\n", fileToFileSeconds);
        std::printf("file to file / bare Embree      %.3f   (to hold: 1.3)\n",
                    fileToFileSeconds / bareSeconds);
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}

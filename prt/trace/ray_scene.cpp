#include "prt/trace/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

constexpr std::size_t kPacketSize = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Embree asserts that coordinates are below 2^60 or so; nothing honest comes near.
constexpr float kLargestCoordinate = 1e18f;

bool isTraceable(float value) {
    return std::abs(value) < kLargestCoordinate;
}  // false for NaN

bool isTraceable(const Vec3f& vector) {
    return isTraceable(vector.x) && isTraceable(vector.y) && isTraceable(vector.z);
}

/// Embree would end the program on a ray that is not; one that is NaN or negative long meets
/// nothing.
bool isTraceable(const Vec3f& origin, const Vec3f& direction, float tFar) {
    return isTraceable(origin) && isTraceable(direction) && tFar >= 0.0f;
}

std::string deviceConfig(const RaySceneOptions& options) {
    std::string config;
    // Embree keeps a global limit of its own, which must never be above
    // the cores nor below the caller's.
    if (options.threadCount > 0 && options.threadCount < resolveThreadCount(0))
        config += "threads=" + std::to_string(options.threadCount) + ",";
    if (options.isa) {
        constexpr std::array<const char*, 3> kEmbreeNames = {"sse4.2", "avx2", "avx512"};
        config += std::string("isa=") + kEmbreeNames[static_cast<std::size_t>(*options.isa)];
    }
    return config;
}

/// What the alpha test of one mesh needs.
struct MaskedMesh {
    const Scene* scene;
    std::size_t mesh;
};

/// Lets rays pass where the surface is cut out.
void rejectCutOutHits(const RTCFilterFunctionNArguments* arguments) {
    const auto& masked = *static_cast<const MaskedMesh*>(arguments->geometryUserPtr);
    const Material& material = masked.scene->materials[masked.scene->meshes[masked.mesh].material];
    for (unsigned int i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const SurfacePoint point{masked.mesh, RTCHitN_primID(arguments->hit, arguments->N, i),
                                 RTCHitN_u(arguments->hit, arguments->N, i),
                                 RTCHitN_v(arguments->hit, arguments->N, i)};
        if (evaluateBaseColor(*masked.scene, point).w < material.alphaCutoff)
            arguments->valid[i] = 0;
    }
}

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using TracedScene = std::unique_ptr<RTCSceneTy, SceneDeleter>;

[[noreturn]] void throwTracerError(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE)  // it could not even be made
        throw Error(ErrorCode::outOfMemory, "the ray tracer does not start");
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        throw Error(ErrorCode::outOfMemory, "the scene does not fit in memory for ray tracing");
    throw Error(ErrorCode::unsupported, "the ray tracer failed with code " + std::to_string(error));
}

RTCIntersectContext makeContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

}  // namespace

std::string rayTracerName() {
    const Device device(rtcNewDevice(nullptr));
    if (!device) throwTracerError(nullptr);
    const ssize_t version = rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_VERSION);
    return "Embree " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) +
           "." + std::to_string(version % 100);
}

struct RayScene::Content {
    const Scene& scene;
    Device device;
    TracedScene traced;
    Vec3d center{0.0, 0.0, 0.0};
    double traceScale = 1.0;  // a power of two, so that scaling loses nothing
    std::vector<MaskedMesh> maskedMeshes;

    Content(const Scene& source, const RaySceneOptions& options)
        : scene(source), device(rtcNewDevice(deviceConfig(options).c_str())) {
        if (!device) throwTracerError(nullptr);
        traced.reset(rtcNewScene(device.get()));
        rtcSetSceneFlags(traced.get(), RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(traced.get(), RTC_BUILD_QUALITY_MEDIUM);
        placeAtOrigin();
        maskedMeshes.reserve(scene.meshes.size());
        for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
            attachMesh(mesh);
        rtcCommitScene(traced.get());
        if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) throwTracerError(device.get());
    }

    void placeAtOrigin() {
        if (scene.vertexCount() == 0) return;
        const Bounds bounds = computeBounds(scene);
        center = (Vec3d(bounds.low) + Vec3d(bounds.high)) * 0.5;
        const double radius = (Vec3d(bounds.high) - Vec3d(bounds.low)).length() * 0.5;
        if (radius > 0.0) traceScale = std::exp2(-std::ceil(std::log2(radius)));
    }

    Vec3f toTraceSpace(const Vec3f& worldPoint) const {
        return Vec3f((Vec3d(worldPoint) - center) * traceScale);
    }

    void attachMesh(std::size_t meshIndex) {
        const Mesh& mesh = scene.meshes[meshIndex];
        const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* positions = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.vertexCount()));
        auto* indices = static_cast<unsigned int*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned int), mesh.triangleCount()));
        if (!positions || !indices) {
            rtcReleaseGeometry(geometry);
            throwTracerError(device.get());
        }
        for (const Vec3f& position : mesh.positions) {
            const Vec3f point = toTraceSpace(position);
            positions = std::copy_n(&point.x, 3, positions);
        }
        std::copy(mesh.indices.begin(), mesh.indices.end(), indices);

        if (isMasked(scene.materials[mesh.material])) {
            rtcSetGeometryUserData(geometry,
                                   &maskedMeshes.emplace_back(MaskedMesh{&scene, meshIndex}));
            rtcSetGeometryIntersectFilterFunction(geometry, rejectCutOutHits);
            rtcSetGeometryOccludedFilterFunction(geometry, rejectCutOutHits);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(traced.get(), geometry, static_cast<unsigned int>(meshIndex));
        rtcReleaseGeometry(geometry);
    }
};

RayScene::RayScene(const Scene& scene, const RaySceneOptions& options)
    : content_(std::make_unique<Content>(scene, options)) {}

RayScene::~RayScene() = default;

Vec3f RayScene::tracePoint(const Vec3f& worldPoint) const {
    return content_->toTraceSpace(worldPoint);
}

namespace {

/// Sixteen rays on their way through the tracer.
class Packet {
  public:
    void setRay(std::size_t lane, const Vec3f& origin, const Vec3f& direction, float tFar) {
        if (!isTraceable(origin, direction, tFar)) return;
        valid_[lane] = -1;
        RTCRay16& ray = rays_.ray;
        ray.org_x[lane] = origin.x;
        ray.org_y[lane] = origin.y;
        ray.org_z[lane] = origin.z;
        ray.dir_x[lane] = direction.x;
        ray.dir_y[lane] = direction.y;
        ray.dir_z[lane] = direction.z;
        ray.tnear[lane] = 0.0f;
        ray.tfar[lane] = tFar;
        ray.time[lane] = 0.0f;
        ray.mask[lane] = ~0u;
        ray.flags[lane] = 0;
        rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }

    void intersect(RTCScene scene) {
        RTCIntersectContext context = makeContext();
        rtcIntersect16(valid_.data(), scene, &context, &rays_);
    }

    Hit hit(std::size_t lane, float worldFromTrace) const {
        const RTCHit16& hit = rays_.hit;
        if (valid_[lane] == 0 || hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
        const RTCRay16& ray = rays_.ray;
        const float facing = ray.dir_x[lane] * hit.Ng_x[lane] + ray.dir_y[lane] * hit.Ng_y[lane] +
                             ray.dir_z[lane] * hit.Ng_z[lane];
        return {false,
                ray.tfar[lane] * worldFromTrace,
                {hit.geomID[lane], hit.primID[lane], hit.u[lane], hit.v[lane]},
                facing > 0.0f};
    }

  private:
    alignas(64) std::array<int, kPacketSize> valid_{};
    RTCRayHit16 rays_{};
};

}  // namespace

Hit RayScene::intersect(const Ray& ray) const {
    Hit hit;
    intersect({&ray, 1}, {&hit, 1});
    return hit;
}

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits) const {
    PRT_ASSERT(rays.size() == hits.size(), "one hit a ray");
    const auto scale = static_cast<float>(content_->traceScale);
    for (std::size_t begin = 0; begin < rays.size(); begin += kPacketSize) {
        const std::size_t count = std::min(kPacketSize, rays.size() - begin);
        Packet packet;
        for (std::size_t lane = 0; lane < count; ++lane) {
            const Ray& ray = rays[begin + lane];
            packet.setRay(lane, tracePoint(ray.origin), ray.direction, ray.tFar * scale);
        }
        packet.intersect(content_->traced.get());
        for (std::size_t lane = 0; lane < count; ++lane)
            hits[begin + lane] = packet.hit(lane, 1.0f / scale);
    }
}

bool RayScene::isOccluded(const Ray& ray) const {
    const Vec3f origin = tracePoint(ray.origin);
    if (!isTraceable(origin, ray.direction, ray.tFar)) return false;
    RTCRay traced{};
    traced.org_x = origin.x;
    traced.org_y = origin.y;
    traced.org_z = origin.z;
    traced.dir_x = ray.direction.x;
    traced.dir_y = ray.direction.y;
    traced.dir_z = ray.direction.z;
    traced.tfar = ray.tFar * static_cast<float>(content_->traceScale);
    traced.mask = ~0u;
    RTCIntersectContext context = makeContext();
    rtcOccluded1(content_->traced.get(), &context, &traced);
    return traced.tfar < 0.0f;
}

std::size_t RayScene::findOccluded(RayStream& rays) const {
    // Take out rays that are not finite: Embree would end the program on them.
    std::size_t invalidCount = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float largest = std::abs(rays.originX[i]) + std::abs(rays.originY[i]) +
                              std::abs(rays.originZ[i]) + std::abs(rays.directionX[i]) +
                              std::abs(rays.directionY[i]) + std::abs(rays.directionZ[i]);
        if (isTraceable(largest)) [[likely]]
            continue;
        rays.originX[i] = rays.originY[i] = rays.originZ[i] = 0.0f;
        rays.directionX[i] = rays.directionY[i] = 0.0f;
        rays.directionZ[i] = 1.0f;
        rays.tFar[i] = -kInfinity;
        ++invalidCount;
    }

    RTCRayNp stream{};
    stream.org_x = rays.originX.data();
    stream.org_y = rays.originY.data();
    stream.org_z = rays.originZ.data();
    stream.dir_x = rays.directionX.data();
    stream.dir_y = rays.directionY.data();
    stream.dir_z = rays.directionZ.data();
    stream.tfar = rays.tFar.data();
    RTCIntersectContext context = makeContext();
    rtcOccludedNp(content_->traced.get(), &context, &stream,
                  static_cast<unsigned int>(rays.size()));
    return invalidCount;
}

void RayScene::findClosest(const RayStream& rays, std::span<const std::uint32_t> rayIndices,
                           std::span<Hit> hits) const {
    PRT_ASSERT(rayIndices.size() == hits.size(), "one hit a ray");
    const auto worldFromTrace = static_cast<float>(1.0 / content_->traceScale);
    for (std::size_t begin = 0; begin < rayIndices.size(); begin += kPacketSize) {
        const std::size_t count = std::min(kPacketSize, rayIndices.size() - begin);
        Packet packet;
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::size_t ray = rayIndices[begin + lane];
            packet.setRay(lane, {rays.originX[ray], rays.originY[ray], rays.originZ[ray]},
                          {rays.directionX[ray], rays.directionY[ray], rays.directionZ[ray]},
                          kInfinity);
        }
        packet.intersect(content_->traced.get());
        for (std::size_t lane = 0; lane < count; ++lane)
            hits[begin + lane] = packet.hit(lane, worldFromTrace);
    }
}

}  // namespace prt

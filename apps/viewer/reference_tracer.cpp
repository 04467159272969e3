#include "apps/viewer/reference_tracer.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "prt/base/error.h"
#include "prt/parallel/parallel_for.h"
#include "prt/render/path_traced_view.h"

namespace prt::viewer {
namespace {

/// The fewest that pathTraceView takes: then there is soon something to see.
constexpr int kPathsPerPass = 2;

/// The sides of the first pictures are these parts of those asked for.
constexpr int kCoarseParts[] = {4, 2};

/// A light turned by a rotation, L(R⁻¹ω): what it takes to draw from it is made once.
class TurnedLight final : public DistantLight {
  public:
    TurnedLight(const DistantLight& light, const Mat3d& rotation)
        : light_(light), rotation_(rotation), inverse_(rotation.transposed()) {}

    LightSample sample(RandomStream& random) const override {
        LightSample sample = light_.sample(random);
        sample.direction = rotation_ * sample.direction;
        return sample;
    }
    LightValue evaluate(const Vec3f& direction) const override {
        return light_.evaluate(inverse_ * direction);
    }

  private:
    const DistantLight& light_;
    Mat3d rotation_;
    Mat3d inverse_;
};

/// A smaller picture in the size of a larger one.
Image enlarge(const Image& picture, int width, int height) {
    Image large(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            large.at(x, y) = picture.at(x * picture.width / width, y * picture.height / height);
    return large;
}

/// What one thread does for one request, pass after pass.
class Tracing {
  public:
    /// Makes ready for a request; what it shares with the last one is kept.
    void begin(const ReferenceRequest& request, int threadCount) {
        if (!rays_ || request.objects != objects_) {
            rays_.reset();
            objects_ = request.objects;
            scene_ = assembleWorld(objects_);
            rays_.emplace(scene_, RaySceneOptions{.threadCount = threadCount});
        }
        // Another turn of an environment needs no other light; lighting is of few bands.
        if (!light_ || request.lighting || request.environment != lightOf_) {
            light_.reset();
            light_ = makeLight(request);
            lightOf_ = request.lighting ? nullptr : request.environment;
        }
        request_ = request;
        threadCount_ = threadCount;
        coarseCount_ = 0;
        passCount_ = 0;
        sums_.clear();
    }

    /// The next picture: coarse ones, then means of more and more paths.
    ///
    /// @throws Error  as pathTraceView
    ReferencePicture advance(const ProgressCallback& progress) {
        const int width = request_.width;
        const int height = request_.height;
        if (coarseCount_ < std::size(kCoarseParts)) {
            const int part = kCoarseParts[coarseCount_];
            const Image coarse =
                tracePass(std::max(width / part, 1), std::max(height / part, 1), 1, progress);
            ++coarseCount_;
            return {std::make_shared<const Image>(enlarge(coarse, width, height)), 0, {}};
        }
        const Image pass =
            tracePass(width, height, static_cast<std::uint64_t>(passCount_) + 1, progress);
        ++passCount_;
        sums_.resize(pass.pixels.size(), Vec3d(0.0));
        auto mean = std::make_shared<Image>(width, height);
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            sums_[i] += Vec3d(pass.pixels[i]);
            mean->pixels[i] = Vec3f(sums_[i] / passCount_);
        }
        return {std::move(mean), passCount_ * kPathsPerPass, {}};
    }

  private:
    static std::unique_ptr<DistantLight> makeLight(const ReferenceRequest& request) {
        if (request.lighting) return makeBandLimitedLight(*request.lighting);
        return makeEnvironmentLight(request.environment
                                        ? *request.environment
                                        : Environment{SphereMap::latLong, Image(2, 1)});
    }

    Image tracePass(int width, int height, std::uint64_t seed, const ProgressCallback& progress) {
        const RenderOptions view{
            .width = width,
            .height = height,
            .samplesPerAxis = 1,
            .background = request_.showBackground ? request_.environment.get() : nullptr,
            .worldFromBackground = request_.worldFromEnvironment,
            .seed = seed};
        const PathTracerOptions paths{.walk = {.surfaceModel = request_.model.surfaceModel,
                                               .bounceCount = request_.model.bounceCount},
                                      .seed = seed,
                                      .threadCount = threadCount_,
                                      .progress = progress};
        const TurnedLight turned(*light_,
                                 request_.lighting ? Mat3d() : request_.worldFromEnvironment);
        return pathTraceView(scene_, *rays_, turned, request_.camera, view, kPathsPerPass, paths)
            .radiance;
    }

    std::vector<PlacedAsset> objects_;
    Scene scene_;                   // of them
    std::optional<RayScene> rays_;  // of it
    std::shared_ptr<const Environment> lightOf_;
    std::unique_ptr<DistantLight> light_;  // of it, not yet turned, or of lighting
    ReferenceRequest request_;
    int threadCount_ = 1;
    std::size_t coarseCount_ = 0;
    int passCount_ = 0;
    std::vector<Vec3d> sums_;  // over passes
};

bool isSameCamera(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.forward == b.forward && a.up == b.up &&
           a.verticalFovRadians == b.verticalFovRadians;
}

bool isSameLighting(const std::optional<Lighting>& a, const std::optional<Lighting>& b) {
    if (!a || !b) return !a && !b;
    return a->bandCount == b->bandCount && a->coefficients == b->coefficients;
}

}  // namespace

ReferenceModel chooseReferenceModel(const Asset& asset, cli::ShownTransport shown) {
    return {cli::isGlossy(shown) ? SurfaceModel::gltf : SurfaceModel::diffuse,
            cli::hasBounces(shown) ? asset.provenance.bounceCount : 0};
}

bool operator==(const ReferenceRequest& a, const ReferenceRequest& b) {
    return a.objects == b.objects && a.environment == b.environment &&
           a.worldFromEnvironment == b.worldFromEnvironment &&
           isSameLighting(a.lighting, b.lighting) && a.showBackground == b.showBackground &&
           isSameCamera(a.camera, b.camera) && a.width == b.width && a.height == b.height &&
           a.model == b.model;
}

struct ReferenceTracer::Content {
    explicit Content(const ReferenceTracerOptions& tracerOptions)
        : options(tracerOptions), thread([this] { run(); }) {}

    ~Content() {
        {
            const std::lock_guard lock(mutex);
            isStopping = true;
            ++revision;
            ++sizeRevision;
        }
        changed.notify_all();
        thread.join();
    }

    void ask(std::optional<ReferenceRequest> next) {
        {
            const std::lock_guard lock(mutex);
            const bool isAsLarge =
                next && request && next->width == request->width && next->height == request->height;
            picture = {isAsLarge ? picture.radiance : nullptr, 0, {}};
            request = std::move(next);
            ++revision;
            if (!isAsLarge) ++sizeRevision;
        }
        changed.notify_all();
    }

    bool isFinished() const {
        return !request || !picture.failure.empty() ||
               picture.pathsPerPixel >= options.mostPathsPerPixel;
    }

    void run();
    /// @param isBegun  whether the last picture was of the same request
    ReferencePicture tracePass(Tracing& tracing, const ReferenceRequest& traced, bool isBegun,
                               const ProgressCallback& progress) const;

    const ReferenceTracerOptions options;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<ReferenceRequest> request;
    ReferencePicture picture;  ///< of the request
    bool isStopping = false;
    std::atomic<std::size_t> revision = 0;      ///< of the request
    std::atomic<std::size_t> sizeRevision = 0;  ///< of its size
    std::thread thread;                         ///< last, when all else stands
};

void ReferenceTracer::Content::run() {
    std::optional<Tracing> tracing;
    std::size_t begunRevision = 0;
    std::unique_lock lock(mutex);
    while (true) {
        changed.wait(lock, [&] { return isStopping || !isFinished() || (!request && tracing); });
        if (isStopping) return;
        if (!request) {
            tracing.reset();  // gives its memory back
            continue;
        }
        const std::size_t ofRevision = revision;
        const bool isBegun = tracing && begunRevision == ofRevision;
        begunRevision = ofRevision;
        // A first picture is finished though another view is asked for meanwhile, so that who
        // turns it without a pause sees some.
        const std::atomic<std::size_t>& current = isBegun ? revision : sizeRevision;
        const std::size_t ofCurrent = current;
        const ReferenceRequest traced = *request;
        lock.unlock();
        if (!tracing) tracing.emplace();
        ReferencePicture next = tracePass(*tracing, traced, isBegun,
                                          [&](const Progress&) { return current == ofCurrent; });
        lock.lock();
        const bool isLate = revision != ofRevision;
        if (current == ofCurrent && !(isLate && !next.radiance)) picture = std::move(next);
        changed.notify_all();
    }
}

ReferencePicture ReferenceTracer::Content::tracePass(Tracing& tracing,
                                                     const ReferenceRequest& traced, bool isBegun,
                                                     const ProgressCallback& progress) const {
    try {
        if (!isBegun) {
            const int cores = resolveThreadCount(0);
            tracing.begin(traced,
                          options.threadCount > 0 ? options.threadCount : std::max(1, cores - 1));
        }
        return tracing.advance(progress);
    } catch (const Error& error) {
        return {nullptr, 0, error.message()};
    } catch (const std::exception&) {
        return {nullptr, 0, "the reference does not fit in memory"};
    }
}

ReferenceTracer::ReferenceTracer(const ReferenceTracerOptions& options)
    : content_(std::make_unique<Content>(options)) {}

ReferenceTracer::~ReferenceTracer() = default;

void ReferenceTracer::trace(const ReferenceRequest& request) {
    {
        const std::lock_guard lock(content_->mutex);
        if (content_->request && *content_->request == request) return;
    }
    content_->ask(request);
}

void ReferenceTracer::stop() {
    content_->ask(std::nullopt);
}

ReferencePicture ReferenceTracer::picture() const {
    const std::lock_guard lock(content_->mutex);
    return content_->picture;
}

ReferencePicture ReferenceTracer::finish(int pathsPerPixel) {
    std::unique_lock lock(content_->mutex);
    content_->changed.wait(lock, [&] {
        return content_->isFinished() || content_->picture.pathsPerPixel >= pathsPerPixel;
    });
    return content_->picture;
}

}  // namespace prt::viewer

// Frames of 1280 × 720 as the viewer draws them: a new light, the scene relit, the environment
// behind it, and the picture shown as code values. Radiance is summed on the card, or on the CPU
// by one thread and handed over. `parts` draws one part of such a frame alone.
//
// Times are those of the wall and of all threads, to the end of what the card does and without
// reading back: a rasteriser on the CPU has threads of its own. Bytes counted: what is read of the
// transfer, once, and the radiance that is handed over.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "prt/gpu/gl_context.h"
#include "prt/gpu/gpu_display.h"
#include "prt/gpu/gpu_glossy_relighter.h"
#include "prt/gpu/gpu_relighter.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/gpu/gpu_view.h"
#include "prt/math/transform.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/relight/relighter.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"

namespace prt {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kBandCount = 5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double readWallSeconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

/// Of all threads.
double readProcessSeconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Scene makeScene(Mesh mesh) {
    Scene scene;
    scene.materials.emplace_back().baseColorFactor = {0.7f, 0.6f, 0.5f, 1.0f};
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

/// 128 × 128 vertices.
Scene makeGrid() {
    return makeScene(makeFloor(1.0f, 0.0f, 127));
}

/// 32 patches of 56 × 56 vertices, 100,352.
Scene makeLargeTeapot() {
    return makeScene(makeTeapot(55));
}

/// 32 patches of 40 × 40 vertices, 51,200.
Scene makeMiddlingTeapot() {
    return makeScene(makeTeapot(39));
}

/// Bright above, with texels that differ.
Environment makeEnvironment() {
    Environment environment{SphereMap::latLong, Image(1024, 512)};
    for (int y = 0; y < environment.radiance.height; ++y)
        for (int x = 0; x < environment.radiance.width; ++x) {
            const float height = 1.0f - static_cast<float>(y) / 512.0f;
            const float wave = 0.5f + 0.5f * std::sin(0.05f * static_cast<float>(x + y));
            environment.radiance.at(x, y) = Vec3f(0.3f + 0.4f * wave, 0.4f, 0.5f) * height;
        }
    return environment;
}

/// How a layer is stored; clusterCount 0 is without clusters.
struct Form {
    Transport transport = Transport::shadowed;
    int channelCount = 1;
    TransferEncoding encoding = TransferEncoding::float32;
    std::uint32_t clusterCount = 0;
    std::uint32_t componentCount = 0;
};

constexpr Form kGreyBytes{Transport::shadowed, 1, TransferEncoding::unorm8};
constexpr Form kColoredFloats{Transport::interreflected, 3};
constexpr Form kColoredBytes{Transport::interreflected, 3, TransferEncoding::unorm8};
constexpr Form kColoredClusters{Transport::interreflected, 3, TransferEncoding::unorm8, 64, 8};
constexpr Form kGreyMatrices{Transport::glossy, 1, TransferEncoding::unorm8};
constexpr Form kVisibility{Transport::glossyShadowed, 1, TransferEncoding::unorm8};
constexpr Form kColoredMatrices{Transport::glossy, 3, TransferEncoding::unorm8};
constexpr Form kMatrixClusters{Transport::glossy, 3, TransferEncoding::unorm8, 64, 8};

StoredTable makeNumbers(TransferEncoding encoding, std::size_t rowCount, std::size_t columnCount) {
    StoredTable table{.encoding = encoding};
    table.numbers = CoefficientTable(rowCount, columnCount, bytesPerCoefficient(encoding));
    if (encoding != TransferEncoding::float32) {
        table.scale.assign(columnCount, 0.1f);
        table.bias.assign(columnCount, -0.01f);
    }
    // A number of moderate size in every encoding.
    constexpr std::byte kPattern{0x3c};
    const std::vector<std::byte> panel(table.numbers.panel(0).size(), kPattern);
    for (std::size_t i = 0; i < table.numbers.panelCount(); ++i)
        table.numbers.writePanel(i, 0, panel);
    return table;
}

/// Weights have 8 bits, and clusters lie together.
CompressedTransfer makeTransfer(std::size_t vertexCount, const Form& form) {
    CompressedTransfer transfer;
    transfer.bandCount = kBandCount;
    transfer.receiverCount = vertexCount;
    for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
        transfer.receiverOfVertex.push_back(static_cast<std::uint32_t>(vertex));
    CompressedLayer layer;
    layer.transport = form.transport;
    layer.channelCount = form.channelCount;
    if (isGlossy(form.transport)) layer.incidentBandCount = kBandCount;
    const std::size_t size = coefficientsPerReceiver(kBandCount, layer);
    if (form.clusterCount == 0) {
        layer.table = makeNumbers(form.encoding, vertexCount, size);
    } else {
        layer.bases.emplace().componentCounts.assign(form.clusterCount, form.componentCount);
        layer.bases->vectors =
            makeNumbers(TransferEncoding::unorm16, layer.bases->firstVectors().back(), size);
        const std::size_t rowLength = 1 + form.componentCount;
        std::vector<std::uint8_t> rows(vertexCount * rowLength, 60);
        for (std::size_t i = 0; i < vertexCount; ++i)
            rows[i * rowLength] = static_cast<std::uint8_t>(i * form.clusterCount / vertexCount);
        layer.table.encoding = TransferEncoding::unorm8;
        layer.table.numbers = makeTable(rowLength, rows);
    }
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

/// Made at first need, and for all.
void openContext() {
    static const GlContext context;
}

/// All that a frame takes but its radiance.
class Stage {
  public:
    explicit Stage(const Scene& scene)
        : scene_(scene),
          camera_(frameScene(scene, static_cast<float>(kWidth) / kHeight)),
          background_(makeEnvironment()),
          linear_(kWidth, kHeight),
          screen_(kWidth, kHeight, 1, TargetFormat::codeValues),
          lighting_(kBandCount) {
        std::fill(lighting_.coefficients.begin(), lighting_.coefficients.end(),
                  Vec3d(0.3, 0.2, 0.1));
        lighting_.coefficients[0] = Vec3d(3.0);
    }

    const Camera& camera() const { return camera_; }

    const Lighting& turnLight() {
        angle_ += 0.01;
        lighting_.coefficients[1].x = 0.3 * std::cos(angle_);
        return lighting_;
    }

    void draw(const GpuRadiance& radiance) const {
        drawGpuView({{{&scene_, &radiance}}}, camera_, linear_, {&background_, rotationY(angle_)});
    }
    void drawWithMirrors(const GpuRadiance& radiance, GpuMirrors& mirrors) const {
        mirrors.turn(rotationY(angle_));
        GpuViewOptions options{&background_, rotationY(angle_)};
        options.mirrors = &mirrors;
        drawGpuView({{{&scene_, &radiance}}}, camera_, linear_, options);
    }
    void drawWithoutBackground(const GpuRadiance& radiance) const {
        drawGpuView({{{&scene_, &radiance}}}, camera_, linear_);
    }
    void show() const {
        screen_.beginDrawing({}, true);
        display_.draw(linear_);
    }

  private:
    GpuScene scene_;
    Camera camera_;
    GpuBackground background_;
    GpuDisplay display_;
    GpuTarget linear_;
    GpuTarget screen_;
    Lighting lighting_;
    double angle_ = 0.0;
};

/// @param frame  everything of it
void timeFrames(benchmark::State& state, double byteCount, const std::function<void()>& frame) {
    frame();
    glFinish();
    std::vector<double> seconds, cpuSeconds;
    for (auto _ : state) {
        const double start = readWallSeconds();
        const double cpuStart = readProcessSeconds();
        frame();
        glFinish();
        seconds.push_back(readWallSeconds() - start);
        cpuSeconds.push_back(readProcessSeconds() - cpuStart);
    }
    state.SetLabel(describeDriver());
    state.counters["frames/s"] = 1.0 / median(seconds);
    state.counters["least_ms"] = 1e3 * *std::ranges::min_element(seconds);
    state.counters["least_cpu_ms"] = 1e3 * *std::ranges::min_element(cpuSeconds);
    state.counters["MB"] = benchmark::Counter(1e-6 * byteCount, benchmark::Counter::kDefaults);
}

void onCard(benchmark::State& state, Scene (*makeSceneOf)(), const Form& form) {
    openContext();
    const Scene scene = makeSceneOf();
    Stage stage(scene);
    const CompressedTransfer transfer = makeTransfer(scene.vertexCount(), form);
    GpuRelighter relighter(transfer, form.transport);
    timeFrames(state, static_cast<double>(transfer.layers[0].table.numbers.byteCount()), [&] {
        relighter.relight(stage.turnLight());
        stage.draw(relighter);
        stage.show();
    });
}

void onCpu(benchmark::State& state, Scene (*makeSceneOf)(), const Form& form) {
    openContext();
    const Scene scene = makeSceneOf();
    Stage stage(scene);
    const Relighter relighter(makeTransfer(scene.vertexCount(), form), form.transport);
    GpuVertexRadiance radiance(scene.vertexCount());
    std::vector<Vec3f> ofVertices(scene.vertexCount());
    const std::size_t byteCount = relighter.transferBytes() + ofVertices.size() * sizeof(Vec3f);
    timeFrames(state, static_cast<double>(byteCount), [&] {
        relighter.relight(stage.turnLight(), ofVertices);
        radiance.upload(ofVertices);
        stage.draw(radiance);
        stage.show();
    });
}

void glossyOnCpu(benchmark::State& state, const Form& form) {
    openContext();
    const Scene scene = makeMiddlingTeapot();
    Stage stage(scene);
    const CompressedTransfer transfer = makeTransfer(scene.vertexCount(), form);
    const GlossyRelighter relighter(transfer, form.transport, describeReceivers(scene, transfer),
                                    GltfViewTable({.bandCount = kBandCount}));
    GpuVertexRadiance radiance(scene.vertexCount());
    std::vector<ExitRadiance> ofVertices(scene.vertexCount());
    const std::size_t byteCount =
        relighter.transferBytes() + ofVertices.size() * sizeof(ExitRadiance);
    timeFrames(state, static_cast<double>(byteCount), [&] {
        relighter.relight(stage.turnLight(), stage.camera().eye, 0, ofVertices);
        radiance.upload(ofVertices);
        stage.draw(radiance);
        stage.show();
    });
}

/// Every vertex mirrors what visibility lets through of the environment.
void mirroredOnCpu(benchmark::State& state, const Form& form) {
    openContext();
    Scene scene = makeMiddlingTeapot();
    scene.materials[0].roughnessFactor = 0.1f;
    scene.materials[0].metallicFactor = 0.5f;
    Stage stage(scene);
    const CompressedTransfer transfer = makeTransfer(scene.vertexCount(), form);
    const GlossyRelighter relighter(transfer, form.transport, describeReceivers(scene, transfer),
                                    GltfViewTable({.bandCount = kBandCount}),
                                    {.leastRoughness = 0.3});
    GpuMirrors mirrors(makeMirrorEnvironment(makeEnvironment()));
    GpuVertexRadiance radiance(scene.vertexCount());
    std::vector<ExitRadiance> ofVertices(scene.vertexCount());
    const std::size_t byteCount =
        relighter.transferBytes() + ofVertices.size() * sizeof(ExitRadiance);
    timeFrames(state, static_cast<double>(byteCount), [&] {
        relighter.relight(stage.turnLight(), stage.camera().eye, 0, ofVertices);
        radiance.upload(ofVertices);
        stage.drawWithMirrors(radiance, mirrors);
        stage.show();
    });
}

void glossyOnCard(benchmark::State& state, const Form& form) {
    openContext();
    const Scene scene = makeMiddlingTeapot();
    Stage stage(scene);
    const CompressedTransfer transfer = makeTransfer(scene.vertexCount(), form);
    GpuGlossyRelighter relighter(transfer, form.transport, describeReceivers(scene, transfer),
                                 GltfViewTable({.bandCount = kBandCount}));
    timeFrames(state, static_cast<double>(transfer.layers[0].table.numbers.byteCount()), [&] {
        relighter.relight(stage.turnLight());
        relighter.lookFrom(stage.camera().eye);
        stage.draw(relighter);
        stage.show();
    });
}

enum class Part { upload, surface, background, display };

void parts(benchmark::State& state, Part part, Scene (*makeSceneOf)()) {
    openContext();
    const Scene scene = makeSceneOf();
    Stage stage(scene);
    GpuVertexRadiance radiance(scene.vertexCount());
    const GpuBackground background(makeEnvironment());
    const GpuTarget target(kWidth, kHeight);
    const std::vector<Vec3f> ofVertices(scene.vertexCount(), Vec3f(0.5f));
    timeFrames(state, 0.0, [&] {
        switch (part) {
            case Part::upload:
                radiance.upload(ofVertices);
                break;
            case Part::surface:
                stage.drawWithoutBackground(radiance);
                break;
            case Part::background:
                drawGpuView({}, stage.camera(), target, {&background, {}});
                break;
            case Part::display:
                stage.show();
        }
    });
}

void asWallClock(benchmark::internal::Benchmark* frames) {
    frames->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(onCard, grid16k_25x1_u8, makeGrid, kGreyBytes)->Apply(asWallClock);
BENCHMARK_CAPTURE(onCpu, grid16k_25x1_u8, makeGrid, kGreyBytes)->Apply(asWallClock);
BENCHMARK_CAPTURE(onCard, teapot100k_25x3_float32, makeLargeTeapot, kColoredFloats)
    ->Apply(asWallClock);
BENCHMARK_CAPTURE(onCpu, teapot100k_25x3_float32, makeLargeTeapot, kColoredFloats)
    ->Apply(asWallClock);
BENCHMARK_CAPTURE(onCard, teapot100k_25x3_u8, makeLargeTeapot, kColoredBytes)->Apply(asWallClock);
BENCHMARK_CAPTURE(onCpu, teapot100k_25x3_u8, makeLargeTeapot, kColoredBytes)->Apply(asWallClock);
BENCHMARK_CAPTURE(onCard, teapot100k_25x3_clusters, makeLargeTeapot, kColoredClusters)
    ->Apply(asWallClock);
BENCHMARK_CAPTURE(onCpu, teapot100k_25x3_clusters, makeLargeTeapot, kColoredClusters)
    ->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCard, teapot51k_u8, kGreyMatrices)->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCard, teapot51k_rgb_u8, kColoredMatrices)->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCard, teapot51k_rgb_clusters, kMatrixClusters)->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCpu, teapot51k_u8, kGreyMatrices)->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCpu, teapot51k_rgb_u8, kColoredMatrices)->Apply(asWallClock);
BENCHMARK_CAPTURE(glossyOnCpu, teapot51k_rgb_clusters, kMatrixClusters)->Apply(asWallClock);
BENCHMARK_CAPTURE(mirroredOnCpu, teapot51k_u8, kVisibility)->Apply(asWallClock);
BENCHMARK_CAPTURE(parts, upload, Part::upload, makeLargeTeapot)->Apply(asWallClock);
BENCHMARK_CAPTURE(parts, grid16k, Part::surface, makeGrid)->Apply(asWallClock);
BENCHMARK_CAPTURE(parts, teapot100k, Part::surface, makeLargeTeapot)->Apply(asWallClock);
BENCHMARK_CAPTURE(parts, background, Part::background, makeGrid)->Apply(asWallClock);
BENCHMARK_CAPTURE(parts, display, Part::display, makeGrid)->Apply(asWallClock);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();

// Bibliography
//   [Kautz04]  Real-time precomputed radiance transfer: pictures of 64 clusters with 2, 3, 4
//   vectors
#include "apps/prt/compress_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "apps/common/picture.h"
#include "prt/base/file.h"
#include "prt/image/error_metrics.h"
#include "prt/image/false_color.h"
#include "prt/io/image_io.h"
#include "prt/relight/relighter.h"
#include "prt/render/render_view.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<Vec3f> relight(const CompressedTransfer& transfer, const Lighting& light) {
    const Relighter relighter(transfer, transfer.layers.front().transport);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(light, radiance);
    return radiance;
}

/// A camera before a scene that shows radiance of its vertices.
class Stage {
  public:
    Stage(const Scene& scene, const ViewArguments& view, const std::string& name,
          const ProgressCallback& progress)
        : scene_(scene),
          rays_(scene),
          camera_(chooseCamera(view, scene, name)),
          options_{.width = view.size.width, .height = view.size.height, .progress = progress} {}

    Image take(std::span<const Vec3f> vertexRadiance) const {
        return renderView(scene_, rays_, vertexRadiance, camera_, options_);
    }

  private:
    const Scene& scene_;
    RayScene rays_;
    Camera camera_;
    RenderOptions options_;
};

/// The same surfaces in white, which show what arrives at them.
Scene paintWhite(Scene scene) {
    for (Material& material : scene.materials) {
        material.baseColorFactor = Vec4f(1.0f, 1.0f, 1.0f, material.baseColorFactor.w);
        material.emissiveFactor = Vec3f(0.0f, 0.0f, 0.0f);
        if (material.alphaMode != AlphaMode::mask) material.baseColorTexture.reset();
    }
    for (Mesh& mesh : scene.meshes)
        for (Vec4f& color : mesh.colors)
            color = Vec4f(1.0f, 1.0f, 1.0f, color.w);
    return scene;
}

/// The error of each vertex's radiance over the mean radiance, of all channels together.
std::vector<float> measureVertexErrors(std::span<const Vec3f> radiance,
                                       std::span<const Vec3f> truth) {
    Vec3d sum(0.0);
    for (const Vec3f& value : truth)
        sum += Vec3d(value);
    const double mean = (sum.x + sum.y + sum.z) /
                        (3.0 * static_cast<double>(std::max<std::size_t>(truth.size(), 1)));
    std::vector<float> errors;
    for (std::size_t i = 0; i < truth.size(); ++i)
        errors.push_back(mean > 0.0 ? static_cast<float>((radiance[i] - truth[i]).length() /
                                                         std::sqrt(3.0) / mean)
                                    : 0.0f);
    return errors;
}

double rootMeanSquare(std::span<const float> values) {
    double squares = 0.0;
    for (const float value : values)
        squares += static_cast<double>(value) * static_cast<double>(value);
    return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

std::vector<WorstVertex> findWorst(const Scene& scene, std::span<const float> errors) {
    constexpr std::size_t kListed = 10;
    std::vector<Vec3f> positions;
    for (const Mesh& mesh : scene.meshes)
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t count = std::min(kListed, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                      order.end(), [&](std::size_t a, std::size_t b) {
                          return std::pair(-errors[a], a) < std::pair(-errors[b], b);
                      });
    std::vector<WorstVertex> worst;
    for (std::size_t i = 0; i < count; ++i)
        worst.push_back({order[i], positions[order[i]], static_cast<double>(errors[order[i]])});
    return worst;
}

/// 64 clusters with so few vectors that one sees it, in floats.
std::vector<FewVectorsTrial> tryFewVectors(const CompressedTransfer& original,
                                           const CompressOptions& common, const Lighting& light,
                                           const Stage& stage, const Rgba8Image& truth,
                                           const DisplayOptions& display) {
    constexpr std::size_t kClusterCount = 64;
    const std::size_t dimension =
        coefficientsPerReceiver(original.bandCount, original.layers.front());
    std::vector<FewVectorsTrial> trials;
    for (const std::size_t vectorCount : {2u, 3u, 4u}) {
        CompressOptions options{
            .encoding = TransferEncoding::float32,
            .clusters = ClusterOptions{.clusterCount = kClusterCount,
                                       .componentCount = vectorCount - 1,
                                       .basesEncoding = TransferEncoding::float32},
            .threadCount = common.threadCount};
        const CompressedTransfer stored = compressTransfer(expandTransfer(original), options);
        FewVectorsTrial trial{.vectorCount = vectorCount};
        trial.error = measureCompressionError(stored.layers.front(), original.layers.front(),
                                              light.coefficients);
        trial.picture = stage.take(relight(stored, light));
        trial.psnr = measurePsnr(encodeForDisplay(trial.picture, display), truth);
        trial.bytes = original.receiverCount * ((vectorCount - 1) * sizeof(float) + 1) +
                      kClusterCount * vectorCount * dimension * sizeof(float);
        trials.push_back(std::move(trial));
    }
    return trials;
}

Json describe(const CompressionError& error) {
    return {
        {"relative_rmse", error.relativeRmse}, {"seen", error.seen}, {"largest", error.largest}};
}

Json describe(const CompressionTrial& trial) {
    return {{"family", trial.family},
            {"options", trial.options},
            {"bytes_per_vertex", trial.bytes},
            {"shared_bytes_per_vertex", trial.sharedBytes},
            {"error", describe(trial.error)},
            {"compress_seconds", trial.compressSeconds},
            {"relight_seconds", trial.relightSeconds}};
}

Json finiteOrNull(double number) {
    return std::isfinite(number) ? Json(number) : Json();
}

std::string formatNumbers(const CompressReport& report) {
    Json json = {{"asset", report.asset},
                 {"source", report.source},
                 {"light", report.lightName},
                 {"transport", transportName(report.transport)},
                 {"bands", report.bandCount},
                 {"vertices", report.vertexCount},
                 {"chosen", describe(report.chosen)},
                 {"relit_rmse", report.relitRmse},
                 {"psnr_db", finiteOrNull(report.psnr)}};
    for (const CompressionTrial& trial : report.trials)
        json["trials"].push_back(describe(trial));
    for (const FewVectorsTrial& trial : report.fewVectors)
        json["few_vectors"].push_back({{"vectors", trial.vectorCount},
                                       {"bytes", trial.bytes},
                                       {"psnr_db", finiteOrNull(trial.psnr)},
                                       {"error", describe(trial.error)}});
    return json.dump(2) + "\n";
}

}  // namespace

std::string fewVectorsPicture(std::size_t vectorCount) {
    return fmt::format("vectors-{}", vectorCount);
}

float vertexErrorScale(const CompressReport& report) {
    constexpr double kTimesTypical = 4.0;
    return report.relitRmse > 0.0 ? static_cast<float>(kTimesTypical * report.relitRmse) : 1e-6f;
}

CompressReport examineCompression(const Asset& original, const CompressedTransfer& compressed,
                                  const CompressOptions& options, const Lighting& light,
                                  const ViewArguments& view, StageLog& log) {
    const CompressedLayer& layer = original.transfer.layers.front();
    CompressReport report{.transport = layer.transport,
                          .vertexCount = original.scene.vertexCount(),
                          .dimension = coefficientsPerReceiver(original.transfer.bandCount, layer),
                          .bandCount = original.transfer.bandCount,
                          .exposureStops = chooseExposure(light)};
    report.chosen = judgeCompression(original.transfer, compressed, light);
    report.trials = tryCompressions(original.transfer, light, options, log);

    const Stopwatch watch;
    const DisplayOptions display{.exposureStops = report.exposureStops};
    const std::vector<Vec3f> truth = relight(original.transfer, light);
    const std::vector<Vec3f> radiance = relight(compressed, light);
    const std::vector<float> errors = measureVertexErrors(radiance, truth);
    report.relitRmse = rootMeanSquare(errors);
    report.worst = findWorst(original.scene, errors);

    const Stage stage(original.scene, view, report.asset, log.callback());
    report.original = stage.take(truth);
    report.compressed = stage.take(radiance);
    const Rgba8Image truthOnScreen = encodeForDisplay(report.original, display);
    report.psnr = measurePsnr(encodeForDisplay(report.compressed, display), truthOnScreen);
    const Scene white = paintWhite(original.scene);
    std::vector<Vec3f> greys;
    for (const float error : errors)
        greys.emplace_back(error, error, error);
    report.vertexErrors = Stage(white, view, report.asset, log.callback()).take(greys);
    report.fewVectors =
        tryFewVectors(original.transfer, options, light, stage, truthOnScreen, display);
    log.finishStage("examine", watch.seconds(),
                    fmt::format("{} pictures", 3 + report.fewVectors.size()));
    return report;
}

void writeCompressReport(const fs::path& folder, const CompressReport& report) {
    const DisplayOptions display{.exposureStops = report.exposureStops};
    const auto write = [&](const std::string& name, const Image& radiance) {
        writePng(folder / (name + ".png"), encodeForDisplay(radiance, display));
    };
    write(kOriginalTransfer, report.original);
    write(kCompressedTransfer, report.compressed);
    for (const FewVectorsTrial& trial : report.fewVectors)
        write(fewVectorsPicture(trial.vectorCount), trial.picture);
    ImageOf<float> errors(report.vertexErrors.width, report.vertexErrors.height);
    std::ranges::transform(report.vertexErrors.pixels, errors.pixels.begin(),
                           [](const Vec3f& pixel) { return pixel.x; });
    writePng(folder / (std::string(kVertexErrors) + ".png"),
             drawFalseColors(errors, 0.0f, vertexErrorScale(report), unitColors()));
    writeFileAtomically(folder / "compression.json", formatNumbers(report));
    writeFileAtomically(folder / "index.html", formatCompressPage(report));
}

}  // namespace prt::cli

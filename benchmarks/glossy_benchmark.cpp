// Exit radiance of 50,000 receivers of glTF materials with 25 × 25 matrices, with light and eye
// changing or the eye alone, by one thread and by two that take half each.
//
// Bytes counted: what is read of the transfer, once, and the 28 bytes written for each receiver.
// of_read_bandwidth is their rate over that of summing 256 MB in as many threads, measured just
// before and after. All times are CPU times of a thread, the median of frames; frames/s is that of
// all threads together.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include "benchmarks/yardsticks.h"
#include "prt/relight/glossy_relighter.h"

namespace prt {
namespace {

constexpr std::size_t kReceiverCount = 50'000;
constexpr std::size_t kReadBytes = std::size_t{256} << 20;
constexpr int kBandCount = 5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Over a sphere, row by row, ever rougher along it.
std::vector<ReceiverSurface> makeReceivers() {
    std::vector<ReceiverSurface> receivers(kReceiverCount);
    for (std::size_t i = 0; i < kReceiverCount; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / kReceiverCount;
        const double z = 1.0 - 2.0 * share;
        const double radius = std::sqrt(1.0 - z * z);
        const double angle = 2.0 * std::numbers::pi * 200.0 * share;
        const Vec3f place(Vec3d(radius * std::cos(angle), radius * std::sin(angle), z));
        receivers[i] = {place, place, 0,
                        MetallicRoughness{0.5f, static_cast<float>(0.2 + 0.8 * share)}};
    }
    return receivers;
}

StoredTable makeMatrices(TransferEncoding encoding, std::size_t rowCount, std::size_t size) {
    StoredTable table;
    table.encoding = encoding;
    table.numbers = CoefficientTable(rowCount, size, bytesPerCoefficient(encoding));
    if (encoding != TransferEncoding::float32) {
        table.scale.assign(size, 1.5f);
        table.bias.assign(size, -0.25f);
    }
    // A number of moderate size in every encoding.
    constexpr std::byte kPattern{0x3c};
    const std::vector<std::byte> panel(table.numbers.panel(0).size(), kPattern);
    for (std::size_t i = 0; i < table.numbers.panelCount(); ++i)
        table.numbers.writePanel(i, 0, panel);
    return table;
}

/// What is relit: clusterCount 0 is none, and weights have 8 bits.
struct Form {
    TransferEncoding encoding = TransferEncoding::float32;
    int channelCount = 1;
    std::uint32_t clusterCount = 0;
    std::uint32_t componentCount = 0;

    auto operator<=>(const Form&) const = default;
};

CompressedTransfer makeTransfer(const Form& form) {
    CompressedTransfer transfer;
    transfer.bandCount = kBandCount;
    transfer.receiverCount = kReceiverCount;
    CompressedLayer layer;
    layer.transport = Transport::glossy;
    layer.channelCount = form.channelCount;
    layer.incidentBandCount = kBandCount;
    const std::size_t size = coefficientsPerReceiver(kBandCount, layer);
    if (form.clusterCount == 0) {
        layer.table = makeMatrices(form.encoding, kReceiverCount, size);
    } else {
        layer.bases.emplace();
        layer.bases->componentCounts.assign(form.clusterCount, form.componentCount);
        layer.bases->vectors =
            makeMatrices(form.encoding, layer.bases->firstVectors().back(), size);
        // In stripes, as clusters are nearly on a surface.
        constexpr std::uint8_t kWeight = 60;
        const std::size_t rowLength = 1 + form.componentCount;
        std::vector<std::uint8_t> rows(kReceiverCount * rowLength, kWeight);
        for (std::size_t i = 0; i < kReceiverCount; ++i)
            rows[i * rowLength] = static_cast<std::uint8_t>(i / 50 % form.clusterCount);
        layer.table.encoding = TransferEncoding::unorm8;
        layer.table.numbers = makeTable(rowLength, rows);
    }
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

/// The one of the last form asked for, for all threads.
std::shared_ptr<const GlossyRelighter> relighterOf(const Form& form) {
    static std::mutex mutex;
    static Form kept;
    static std::shared_ptr<const GlossyRelighter> relighter;
    static const GltfViewTable views({.bandCount = kBandCount});
    const std::lock_guard lock(mutex);
    if (!relighter || kept != form) {
        relighter = nullptr;
        relighter = std::make_shared<GlossyRelighter>(makeTransfer(form), Transport::glossy,
                                                      makeReceivers(), views);
        kept = form;
    }
    return relighter;
}

enum class Changing { lightAndEye, eye };

/// A thread's share of the receivers, seen frame after frame.
class Frames {
  public:
    Frames(const GlossyRelighter& relighter, int thread, int threadCount)
        : relighter_(relighter), lighting_(kBandCount) {
        const auto place = [&](int t) {
            return kReceiverCount * static_cast<std::size_t>(t) /
                   static_cast<std::size_t>(threadCount) / kGlossyPartSize * kGlossyPartSize;
        };
        begin_ = place(thread);
        radiance_.resize((thread + 1 == threadCount ? kReceiverCount : place(thread + 1)) - begin_);
        std::fill(lighting_.coefficients.begin(), lighting_.coefficients.end(),
                  Vec3d(1.0, 0.5, 0.25));
    }

    std::size_t receiverCount() const { return radiance_.size(); }

    void keepIncident() {
        incident_.resize(radiance_.size() * relighter_.incidentSize());
        relighter_.receive(lighting_, begin_, incident_);
    }

    void show(Changing changing) {
        angle_ += 0.01f;
        const Vec3f eye(3.0f * std::cos(angle_), 3.0f * std::sin(angle_), 1.0f);
        if (changing == Changing::eye) {
            relighter_.reflect(eye, begin_, incident_, radiance_);
        } else {
            lighting_.coefficients[1].x = static_cast<double>(angle_);
            relighter_.relight(lighting_, eye, begin_, radiance_);
        }
        benchmark::ClobberMemory();
    }

  private:
    const GlossyRelighter& relighter_;
    Lighting lighting_;
    float angle_ = 0.0f;
    std::size_t begin_ = 0;
    std::vector<ExitRadiance> radiance_;
    std::vector<float> incident_;
};

void showFrames(benchmark::State& state, const Form& form, Changing changing) {
    const std::shared_ptr<const GlossyRelighter> relighter = relighterOf(form);
    Frames frames(*relighter, state.thread_index(), state.threads());
    if (changing == Changing::eye) frames.keepIncident();

    double readSeconds = measureReadSeconds(kReadBytes);
    std::vector<double> seconds;
    for (auto _ : state) {
        const double start = readCpuSeconds();
        frames.show(changing);
        seconds.push_back(readCpuSeconds() - start);
    }
    readSeconds = std::min(readSeconds, measureReadSeconds(kReadBytes));

    const double share = static_cast<double>(frames.receiverCount()) / kReceiverCount;
    const double readBytes =
        changing == Changing::eye
            ? static_cast<double>(kReceiverCount * relighter->incidentSize() * sizeof(float))
            : static_cast<double>(relighter->transferBytes());
    const double bytes = share * (readBytes + kReceiverCount * sizeof(ExitRadiance));
    const double readRate = kReadBytes / readSeconds;
    using benchmark::Counter;
    state.counters["frames/s"] = Counter(1.0 / median(seconds), Counter::kAvgThreads);
    state.counters["least_ms"] =
        Counter(1e3 * *std::ranges::min_element(seconds), Counter::kAvgThreads);
    state.counters["MB"] = Counter(1e-6 * bytes, Counter::kDefaults);
    state.counters["read_GB/s"] = Counter(1e-9 * readRate, Counter::kDefaults);
    state.counters["of_read_bandwidth"] =
        Counter(bytes / median(seconds) / readRate, Counter::kAvgThreads);
}

void lightAndEye(benchmark::State& state, const Form& form) {
    showFrames(state, form, Changing::lightAndEye);
}

void eyeAlone(benchmark::State& state, const Form& form) {
    showFrames(state, form, Changing::eye);
}

void chooseThreads(benchmark::internal::Benchmark* showing) {
    showing->Threads(1)->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);
}

constexpr Form kFloats{TransferEncoding::float32, 1};
constexpr Form kShorts{TransferEncoding::unorm16, 1};
constexpr Form kBytes{TransferEncoding::unorm8, 1};
constexpr Form kColoredFloats{TransferEncoding::float32, 3};
constexpr Form kColoredShorts{TransferEncoding::unorm16, 3};
constexpr Form kClusters{TransferEncoding::float32, 1, 64, 7};
constexpr Form kColoredClusters{TransferEncoding::float32, 3, 64, 7};

BENCHMARK_CAPTURE(lightAndEye, float32, kFloats)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, unorm16, kShorts)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, unorm8, kBytes)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, float32_rgb, kColoredFloats)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, unorm16_rgb, kColoredShorts)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, clusters, kClusters)->Apply(chooseThreads);
BENCHMARK_CAPTURE(eyeAlone, clusters, kClusters)->Apply(chooseThreads);
BENCHMARK_CAPTURE(lightAndEye, clusters_rgb, kColoredClusters)->Apply(chooseThreads);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();

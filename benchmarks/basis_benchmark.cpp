// The spherical basis and what is built on it, on one core. `seconds_per_direction` is what the
// tables of peers call ns per direction. Times are also given as multiples of what the same run
// took to write the results (`over_store`), to read the input (`over_read`), or for one
// multiply-add of the widest vectors (`multiply_adds`).
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "benchmarks/yardsticks.h"
#include "prt/base/random.h"
#include "prt/basis/haar_product.h"
#include "prt/basis/sh.h"
#include "prt/basis/sh_projection.h"
#include "prt/basis/sh_rotation.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/deringing.h"
#include "prt/light/environment.h"
#include "prt/light/wavelet_lighting.h"
#include "prt/math/quadrature.h"
#include "prt/math/sampling.h"

namespace prt {
namespace {

constexpr std::size_t kDirectionCount = 256;

/// Directions as three arrays, and room for the values of one batch.
struct Directions {
    std::vector<float> x, y, z;

    Directions() {
        const auto nodes = sphereQuadrature(21);
        for (std::size_t i = 0; i < kDirectionCount; ++i) {
            const Vec3f direction(nodes[i % nodes.size()].direction);
            x.push_back(direction.x);
            y.push_back(direction.y);
            z.push_back(direction.z);
        }
    }
};

/// What a benchmark's loop has taken since the start, as a multiple of a yardstick.
class Comparison {
  public:
    /// @param workCount  how often an iteration does its work
    Comparison(benchmark::State& state, double workCount = 1.0)
        : state_(state), workCount_(workCount), startSeconds_(readCpuSeconds()) {}

    void stop() { elapsedSeconds_ = readCpuSeconds() - startSeconds_; }

    void print(const char* name, double yardstickSeconds) {
        const double count = static_cast<double>(state_.iterations()) * workCount_;
        state_.counters[name] = elapsedSeconds_ / (count * yardstickSeconds);
    }

  private:
    benchmark::State& state_;
    double workCount_;
    double startSeconds_;
    double elapsedSeconds_ = 0.0;
};

void countDirections(benchmark::State& state) {
    state.counters["seconds_per_direction"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * kDirectionCount,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void evaluateBatches(benchmark::State& state) {
    constexpr std::size_t kMaxValueCount = shCoefficientCount(kMaxBandCount) * kShBatchSize;
    const int bandCount = static_cast<int>(state.range(0));
    const Directions directions;
    alignas(64) std::array<float, kMaxValueCount> room;
    const std::span<float> values = std::span(room).first(
        static_cast<std::size_t>(shCoefficientCount(bandCount)) * kShBatchSize);
    using Batch = std::span<const float, kShBatchSize>;
    Comparison comparison(state, kDirectionCount / kShBatchSize);
    for (auto _ : state) {
        for (std::size_t i = 0; i < kDirectionCount; i += kShBatchSize) {
            evaluateShBatch(Batch(&directions.x[i], kShBatchSize),
                            Batch(&directions.y[i], kShBatchSize),
                            Batch(&directions.z[i], kShBatchSize), bandCount, values);
            benchmark::ClobberMemory();
        }
    }
    comparison.stop();
    comparison.print("over_store", measureStoreSeconds(values.size_bytes()));
    comparison.print("multiply_adds", measureMultiplyAddSeconds());
    countDirections(state);
}
BENCHMARK(evaluateBatches)->Name("sh/batch_of_16")->Arg(3)->Arg(5)->Arg(10);

void evaluateSingly(benchmark::State& state) {
    const int bandCount = static_cast<int>(state.range(0));
    const Directions directions;
    std::vector<float> values(static_cast<std::size_t>(shCoefficientCount(bandCount)));
    Comparison comparison(state, kDirectionCount);
    for (auto _ : state) {
        for (std::size_t i = 0; i < kDirectionCount; ++i) {
            evaluateSh(Vec3f(directions.x[i], directions.y[i], directions.z[i]), bandCount, values);
            benchmark::ClobberMemory();
        }
    }
    comparison.stop();
    comparison.print("multiply_adds", measureMultiplyAddSeconds());
    countDirections(state);
}
BENCHMARK(evaluateSingly)->Name("sh/one_direction")->Arg(3)->Arg(5)->Arg(10)->Arg(32);

const Mat3d kRotation = rotationAbout(Vec3d(2.0, -1.0, 2.0) / 3.0, 0.7);

/// The general rotation: a matrix by recurrence.
void rotateByMatrix(benchmark::State& state) {
    const int bandCount = static_cast<int>(state.range(0));
    std::vector<double> source(static_cast<std::size_t>(shCoefficientCount(bandCount)), 1.0);
    std::vector<double> rotated(source.size());
    for (auto _ : state) {
        ShRotation(kRotation, bandCount).apply(source, rotated);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(rotateByMatrix)->Name("sh/rotation_by_matrix")->Arg(3)->Arg(5)->Arg(6)->Arg(10);

/// One rotation, set-up included.
void rotateChannels(benchmark::State& state, std::size_t channelCount) {
    const int bandCount = static_cast<int>(state.range(0));
    const auto channelSize = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<float> source(channelCount * channelSize, 1.0f), rotated(source.size());
    Mat3d rotation = kRotation;
    Comparison comparison(state);
    for (auto _ : state) {
        benchmark::DoNotOptimize(rotation);
        rotateSh(rotation, bandCount, source, rotated);
        benchmark::ClobberMemory();
    }
    comparison.stop();
    comparison.print("multiply_adds", measureMultiplyAddSeconds());
}
BENCHMARK_CAPTURE(rotateChannels, 1, 1)
    ->Name("sh/rotation/1_channel")
    ->Arg(3)
    ->Arg(5)
    ->Arg(6)
    ->Arg(10);
BENCHMARK_CAPTURE(rotateChannels, 3, 3)
    ->Name("sh/rotation/3_channels")
    ->Arg(3)
    ->Arg(5)
    ->Arg(6)
    ->Arg(10);

/// 16 rotations of 16 functions, or of one.
void rotateBatches(benchmark::State& state, std::size_t functionCount) {
    const int bandCount = static_cast<int>(state.range(0));
    const auto count = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::array<float, 9 * kShBatchSize> rotations{};
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const std::size_t entry = i / kShBatchSize;
        rotations[i] = static_cast<float>(kRotation.getValue()[entry]);
    }
    std::vector<float> source(functionCount * count, 1.0f), rotated(kShBatchSize * count);
    Comparison comparison(state);
    for (auto _ : state) {
        rotateShBatch(rotations, bandCount, source, rotated);
        benchmark::ClobberMemory();
    }
    comparison.stop();
    state.counters["seconds_per_rotation"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * kShBatchSize,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    comparison.print("over_store", measureStoreSeconds(rotated.size() * sizeof(float)));
    comparison.print("multiply_adds", measureMultiplyAddSeconds());
}
BENCHMARK_CAPTURE(rotateBatches, own, kShBatchSize)
    ->Name("sh/16_rotations/own_source")
    ->Arg(3)
    ->Arg(5)
    ->Arg(6)
    ->Arg(10);
BENCHMARK_CAPTURE(rotateBatches, shared, 1)
    ->Name("sh/16_rotations/shared_source")
    ->Arg(3)
    ->Arg(5)
    ->Arg(6)
    ->Arg(10);

Environment makeEnvironment(SphereMap map, int width, int height) {
    RandomStream random(1, 0);
    Environment environment{map, Image(width, height)};
    for (Vec3f& texel : environment.radiance.pixels)
        texel = Vec3f(random.nextUnitFloat());
    return environment;
}

void projectEnvironment(benchmark::State& state, SphereMap map, int width, int height) {
    const Environment environment = makeEnvironment(map, width, height);
    Comparison comparison(state);
    for (auto _ : state) {
        benchmark::DoNotOptimize(projectLighting(environment, static_cast<int>(state.range(0))));
    }
    comparison.stop();
    state.SetItemsProcessed(state.iterations() * width * height);
    const auto& pixels = environment.radiance.pixels;
    comparison.print("over_read", measureReadSeconds(pixels.size() * sizeof(Vec3f)));
}
BENCHMARK_CAPTURE(projectEnvironment, lat_long_1024x512, SphereMap::latLong, 1024, 512)
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectEnvironment, angular_map_1000x1000, SphereMap::angularMap, 1000, 1000)
    ->Arg(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectEnvironment, vertical_cross_768x1024, SphereMap::verticalCross, 768, 1024)
    ->Arg(5)
    ->Unit(benchmark::kMillisecond);

/// By the rule that is exact for all functions of so many bands.
void projectFunction(benchmark::State& state) {
    const int bandCount = static_cast<int>(state.range(0));
    const auto function = [](const Vec3d& direction) { return direction.x * direction.y; };
    for (auto _ : state)
        benchmark::DoNotOptimize(projectSh(function, bandCount, bandCount - 1));
}
BENCHMARK(projectFunction)
    ->Name("sh/projection_of_function")
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMicrosecond);

/// Five suns in different colours before a dim sky: what needs many rounds.
Lighting makeSuns(int bandCount) {
    RandomStream random(2, 0);
    Lighting suns = uniformLighting(Vec3d(0.02), bandCount);
    for (int i = 0; i < 5; ++i) {
        const Vec3d direction =
            Vec3d(sampleUniformSphere(random.nextUnitFloat(), random.nextUnitFloat())).normalized();
        Lighting sun = sunLighting(direction, 0.05, bandCount);
        for (Vec3d& coefficient : sun.coefficients)
            coefficient *= Vec3d(1.0, 0.5 * i, 0.2);
        suns = add(suns, sun);
    }
    return suns;
}

void deringSuns(benchmark::State& state, NonNegative nonNegative) {
    const Lighting suns = makeSuns(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(deringingFactors(suns, {nonNegative}));
}
BENCHMARK_CAPTURE(deringSuns, radiance, NonNegative::radiance)
    ->Name("lighting/dering_suns/radiance")
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deringSuns, irradiance, NonNegative::irradiance)
    ->Name("lighting/dering_suns/irradiance")
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);

// ── Haar wavelets of a cube ──────────────────────────────────────────────────────────────────────

/// What no transform can beat: copying as many bytes.
void copyCube(benchmark::State& state) {
    const std::vector<float> values(static_cast<std::size_t>(18 * state.range(0) * state.range(0)));
    std::vector<float> copy(values.size());
    for (auto _ : state) {
        std::memcpy(copy.data(), values.data(), values.size() * sizeof(float));
        benchmark::ClobberMemory();
    }
}
BENCHMARK(copyCube)->Name("haar/copying_cube")->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

void projectCube(benchmark::State& state) {
    const int size = static_cast<int>(state.range(0));
    const Environment cube = makeEnvironment(SphereMap::verticalStrip, size, 6 * size);
    for (auto _ : state)
        benchmark::DoNotOptimize(projectWavelets(cube));
}
BENCHMARK(projectCube)->Name("haar/project_cube")->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

WaveletLighting makeWavelets(int size) {
    return projectWavelets(makeEnvironment(SphereMap::verticalStrip, size, 6 * size));
}

void reconstructWavelets(benchmark::State& state) {
    const WaveletLighting lighting = makeWavelets(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(reconstructCube(lighting));
}
BENCHMARK(reconstructWavelets)
    ->Name("haar/reconstruct_cube")
    ->Arg(64)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond);

void selectWavelets(benchmark::State& state) {
    const WaveletLighting lighting = makeWavelets(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(selectLargest(lighting, 100));
}
BENCHMARK(selectWavelets)
    ->Name("haar/select_100")
    ->Arg(64)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond);

void multiplyWavelets(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0) * state.range(0));
    const std::vector<float> a(count, 0.5f), b(count, 0.25f);
    std::vector<float> product(count);
    for (auto _ : state) {
        multiplyHaar(a, b, product);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(multiplyWavelets)->Name("haar/product_of_squares")->Arg(64);

/// The same by way of the texels.
void multiplyTexels(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0) * state.range(0));
    const std::vector<float> a(count, 0.5f), b(count, 0.25f);
    std::vector<float> texelsA(count), texelsB(count), product(count);
    for (auto _ : state) {
        reconstructHaar(a, texelsA);
        reconstructHaar(b, texelsB);
        for (std::size_t t = 0; t < count; ++t)
            texelsA[t] *= texelsB[t];
        projectHaar(texelsA, product);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(multiplyTexels)->Name("haar/product_by_texels")->Arg(64);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();

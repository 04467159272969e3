// A light that moves, on one core: what a frame costs from the light to its coefficients.
// `in_kautz_3_ms` is how many such frames fit into the 3 ms that projecting an environment at run
// time took [Kautz04]; `over_read` is the time as a multiple of reading the frame's image, in the
// same run.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "benchmarks/yardsticks.h"
#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/environment_projector.h"

namespace prt {
namespace {

constexpr int kBandCount = 5;

/// Frames are met in turn, so that none is found in the cache.
constexpr int kFrameCount = 16;

std::vector<Environment> makeFrames(SphereMap map, int width, int height) {
    RandomStream random(1, 0);
    std::vector<Environment> frames(kFrameCount, {map, Image(width, height)});
    for (Environment& frame : frames)
        for (Vec3f& texel : frame.radiance.pixels)
            texel = Vec3f(random.nextUnitFloat());
    return frames;
}

/// Counts what `step(frame)` takes of a frame's 3 ms. @return CPU seconds a frame
template <class Step>
double playFrames(benchmark::State& state, Step step) {
    std::size_t frame = 0;
    const double start = readCpuSeconds();
    for (auto _ : state)
        benchmark::DoNotOptimize(step(frame++));
    const double seconds = (readCpuSeconds() - start) / static_cast<double>(state.iterations());
    constexpr double kKautzSeconds = 3e-3;
    state.counters["in_kautz_3_ms"] = kKautzSeconds / seconds;
    return seconds;
}

/// A video: every frame is another image.
void projectFrames(benchmark::State& state, SphereMap map, int width, int height) {
    const std::vector<Environment> frames = makeFrames(map, width, height);
    const EnvironmentProjector projector(map, width, height, kBandCount);
    const double seconds = playFrames(state, [&](std::size_t frame) {
        return projector.project(frames[frame % frames.size()].radiance);
    });
    const auto& pixels = frames[0].radiance.pixels;
    state.counters["over_read"] = seconds / measureReadSeconds(pixels.size() * sizeof(Vec3f));
}
BENCHMARK_CAPTURE(projectFrames, lat_long_512x256, SphereMap::latLong, 512, 256)
    ->Name("moving_light/video/lat_long_512x256")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectFrames, lat_long_1024x512, SphereMap::latLong, 1024, 512)
    ->Name("moving_light/video/lat_long_1024x512")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectFrames, cube_64, SphereMap::horizontalStrip, 6 * 64, 64)
    ->Name("moving_light/video/cube_of_6x64x64")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectFrames, cube_256, SphereMap::verticalCross, 3 * 256, 4 * 256)
    ->Name("moving_light/video/cross_of_6x256x256")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(projectFrames, angular_map, SphereMap::angularMap, 1000, 1000)
    ->Name("moving_light/video/angular_map_1000x1000")
    ->Unit(benchmark::kMillisecond);

/// An environment that turns: its coefficients do.
void turnLight(benchmark::State& state) {
    const Lighting lighting =
        projectLighting(makeFrames(SphereMap::latLong, 64, 32)[0], kBandCount);
    const Vec3d axis = Vec3d(2.0, -1.0, 2.0) / 3.0;
    playFrames(state, [&](std::size_t frame) {
        return rotate(lighting, rotationAbout(axis, 0.01 * static_cast<double>(frame)));
    });
}
BENCHMARK(turnLight)->Name("moving_light/turned")->Unit(benchmark::kMicrosecond);

/// A sun that goes round, added to a sky that stays.
void moveSun(benchmark::State& state) {
    const Lighting sky = projectLighting(makeFrames(SphereMap::latLong, 64, 32)[0], kBandCount);
    playFrames(state, [&](std::size_t frame) {
        const Vec3d direction = rotationY(0.01 * static_cast<double>(frame)) * Vec3d(0.6, 0.8, 0.0);
        return add(sky, sunLighting(direction, 0.02, kBandCount));
    });
}
BENCHMARK(moveSun)->Name("moving_light/sun")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();

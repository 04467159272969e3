// Bibliography
//   [Karis13]  Real shading in Unreal Engine 4
#include "prt/render/mirror_shading.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "prt/base/assert.h"
#include "prt/brdf/brdf.h"
#include "prt/light/resampling.h"
#include "prt/math/frame.h"
#include "prt/parallel/parallel_for.h"
#include "prt/render/reflection.h"

namespace prt {
namespace {

/// Closer where lobes are narrow: between two levels their mean is taken.
constexpr std::array kRoughnesses = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0};

/// The mean of the light over a lobe about a direction of the environment's own.
Vec3f lookUpMirror(const MirrorEnvironment& environment, const Vec3f& direction, double roughness) {
    const std::vector<double>& levels = environment.roughnesses;
    const auto rougher = std::clamp<std::ptrdiff_t>(
        std::upper_bound(levels.begin(), levels.end(), roughness) - levels.begin(), 1,
        static_cast<std::ptrdiff_t>(levels.size()) - 1);
    const auto index = static_cast<std::size_t>(rougher);
    const double low = levels[index - 1];
    const auto share = static_cast<float>(std::min((roughness - low) / (levels[index] - low), 1.0));
    const Vec3f smooth = lookUpRadiance(environment.mirrors[index - 1], direction);
    if (share <= 0.0f) return smooth;
    return smooth * (1.0f - share) + lookUpRadiance(environment.mirrors[index], direction) * share;
}

}  // namespace

MirrorEnvironment makeMirrorEnvironment(Environment environment, const Mat3d& worldFromEnvironment,
                                        const MirrorOptions& options) {
    PRT_ASSERT(options.mostRoughness > 0.0 && options.mostRoughness <= 1.0,
               "there is a roughness beside 0");
    const auto last =
        std::lower_bound(kRoughnesses.begin(), kRoughnesses.end(), options.mostRoughness);
    MirrorEnvironment result;
    result.worldFromEnvironment = worldFromEnvironment;
    result.roughnesses.assign(kRoughnesses.begin(), last + 1);
    result.mirrors.resize(result.roughnesses.size());
    // Drawn once for all, as prefiltering draws it.
    const int size = 4 * static_cast<int>(std::bit_ceil(static_cast<unsigned>(options.faceSize)));
    const Environment reduced = resample(environment, SphereMap::octahedral, size, size);
    parallelFor(result.mirrors.size() - 1, {options.threadCount, 1},
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t level = begin + 1; level <= end; ++level)
                        result.mirrors[level] =
                            prefilterEnvironment(reduced,
                                                 {.faceSize = options.faceSize,
                                                  .roughnesses = {result.roughnesses[level]},
                                                  .sampleCount = options.sampleCount})
                                .mirrors.front();
                });
    result.mirrors[0] = std::move(environment);
    return result;
}

Vec3f showMirrored(const MirrorEnvironment& environment, const Vec3f& normal, const Vec3f& view,
                   const Vec3f& baseColor, const MetallicRoughness& surface) {
    const Vec3d towardsEye = makeReflection({}, normal, view).view;
    const Vec3d mirrored = frameFromNormal(Vec3d(normal).normalized())
                               .worldFromLocal({-towardsEye.x, -towardsEye.y, towardsEye.z});
    const Vec3f f0(splitGltfMaterial(baseColor, surface).specular.f0);
    return lookUpMirror(environment,
                        Vec3f(environment.worldFromEnvironment.transposed() * mirrored),
                        static_cast<double>(surface.roughness)) *
           environment.albedos.evaluate(f0, surface.roughness, static_cast<float>(towardsEye.z));
}

}  // namespace prt

#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "prt/relight/exit_radiance.h"
#include "prt/render/exit_shading.h"
#include "prt/render/path_walk.h"
#include "prt/scene/surface_color.h"
#include "prt/trace/ray_scene.h"

namespace prt::test {

/// Radiance through one place of the picture, by rays; and which triangle is there.
class RayPicture {
  public:
    static constexpr int kWidth = 160;
    static constexpr int kHeight = 120;

    /// @param radiance  of every vertex
    RayPicture(const Scene& scene, std::vector<ExitRadiance> radiance, const Camera& camera,
               const MirrorEnvironment* mirrors = nullptr)
        : scene_(scene),
          rays_(scene),
          camera_(camera),
          offsets_(vertexOffsets(scene)),
          radiance_(std::move(radiance)),
          mirrors_(mirrors) {}

    /// @param x, y  in pixels from the top left corner
    Vec3f directionThrough(double x, double y) const {
        const double pixel = 2.0 * std::tan(0.5 * camera_.verticalFovRadians) / kHeight;
        const Vec3d right = Vec3d(camera_.forward).cross(Vec3d(camera_.up));
        const Vec3d direction = Vec3d(camera_.forward) + right * ((x - 0.5 * kWidth) * pixel) +
                                Vec3d(camera_.up) * ((0.5 * kHeight - y) * pixel);
        return Vec3f(direction.normalized());
    }

    struct Seen {
        Hit hit;
        Vec3f radiance{0.0f, 0.0f, 0.0f};
    };

    Seen look(double x, double y) const {
        Ray ray{camera_.eye, directionThrough(x, y)};
        Seen seen{rays_.intersect(ray)};
        while (!seen.hit.escaped && seen.hit.backFace && !materialOf(seen.hit).doubleSided) {
            ray.origin += ray.direction * (seen.hit.t * 1.0001f);
            seen.hit = rays_.intersect(ray);
        }
        if (!seen.hit.escaped) {
            const SurfacePoint& point = seen.hit.point;
            const ExitRadiance exit =
                interpolateExit(scene_.meshes[point.mesh], point,
                                std::span(radiance_).subspan(offsets_[point.mesh]));
            seen.radiance =
                shadePoint(scene_, point, exit, placePathOrigin(scene_, rays_, seen.hit).normal,
                           -ray.direction, mirrors_) +
                evaluateEmission(scene_, point);
        }
        return seen;
    }

    /// What the middle of a pixel shows, if nothing has an edge within a 16th of a pixel.
    std::optional<Vec3f> lookInside(int column, int row) const {
        constexpr double kReach = 1.0 / 16.0;
        constexpr float kJump = 0.05f;  // of a texel's edge or a cut-out's
        const Seen middle = look(column + 0.5, row + 0.5);
        for (const double dx : {-kReach, kReach}) {
            for (const double dy : {-kReach, kReach}) {
                const Seen beside = look(column + 0.5 + dx, row + 0.5 + dy);
                if (beside.hit.escaped != middle.hit.escaped) return std::nullopt;
                if (!middle.hit.escaped && (beside.hit.point.mesh != middle.hit.point.mesh ||
                                            beside.hit.point.triangle != middle.hit.point.triangle))
                    return std::nullopt;
                if ((beside.radiance - middle.radiance).length() > kJump) return std::nullopt;
            }
        }
        return middle.radiance;
    }

  private:
    const Material& materialOf(const Hit& hit) const {
        return scene_.materials[scene_.meshes[hit.point.mesh].material];
    }

    const Scene& scene_;
    RayScene rays_;
    Camera camera_;
    std::vector<std::size_t> offsets_;
    std::vector<ExitRadiance> radiance_;
    const MirrorEnvironment* mirrors_;
};

struct Agreement {
    double psnr = 0.0;
    double insideShare = 0.0;  ///< of all pixels
    double meanSquare = 0.0;   ///< of the picture by rays
};

/// Over the pixels that lie inside.
inline Agreement compareWithRays(const Image& picture, const RayPicture& rays) {
    double squares = 0.0, referenceSquares = 0.0;
    int insideCount = 0;
    for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
            const std::optional<Vec3f> expected = rays.lookInside(column, row);
            if (!expected) continue;
            squares += static_cast<double>((picture.at(column, row) - *expected).length2());
            referenceSquares += static_cast<double>(expected->length2());
            ++insideCount;
        }
    }
    return {10.0 * std::log10(3.0 * insideCount / squares),
            static_cast<double>(insideCount) / static_cast<double>(picture.pixels.size()),
            referenceSquares / (3.0 * insideCount)};
}

}  // namespace prt::test

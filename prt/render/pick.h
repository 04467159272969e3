#pragma once

#include <cstddef>
#include <optional>

#include "prt/math/transform.h"
#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"

namespace prt {

/// A place on a picture.
struct PicturePlace {
    int width = 0;  ///< of the picture, pixels
    int height = 0;
    double x = 0.0;  ///< pixels from its left edge: the middle of the first column is at ½
    double y = 0.0;  ///< and from the upper edge
};

/// What stands at a place of a picture.
struct PickedVertex {
    std::size_t vertex = 0;  ///< that corner of the triangle which is nearest to the point that is
                             ///< seen; numbered mesh after mesh
    SurfacePoint point;      ///< what is seen
    float distance = 0.0f;   ///< of it from the eye, metres: of several objects the nearest is seen
};

/// Finds what a view shows there, as renderView and drawGpuView make it: one-sided surfaces seen
/// from behind and cut-outs are looked through.
///
/// @param scene, rays      of an object, in its own frame
/// @param camera           world space
/// @param worldFromObject  a rotation and a translation
/// @return                 none where no surface is, and outside the picture
/// @throws Error           invalidOption for a size or field of view out of range
std::optional<PickedVertex> pickVertex(const Scene& scene, const RayScene& rays,
                                       const Camera& camera, const PicturePlace& place,
                                       const Affine3d& worldFromObject = {});

}  // namespace prt

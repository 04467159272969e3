#pragma once

#include "prt/gltf/model.h"
#include "prt/gltf/primitives.h"
#include "prt/gltf/warnings.h"
#include "prt/math/transform.h"
#include "prt/scene/scene.h"

namespace prt::gltf {

/// How a node puts its mesh into the world.
struct Instance {
    const Affine3d& worldFromNode;
    Mat3d worldFromNormal;    ///< up to a positive factor
    bool isMirrored = false;  ///< triangles must be turned to stay counter-clockwise
};

/// One primitive as one instance shows it: everything but its name and material.
///
/// @param primitive  has positions and makes triangles
Mesh buildMesh(const Model& model, const Primitive& primitive, const Instance& instance,
               Warnings& warnings);

}  // namespace prt::gltf

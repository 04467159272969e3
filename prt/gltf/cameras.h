#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prt/gltf/json_cursor.h"
#include "prt/math/transform.h"
#include "prt/scene/scene.h"

namespace prt::gltf {

struct CameraRecord {
    std::string name;
    std::optional<float> verticalFovRadians;  ///< in (0, π); nothing for no pinhole
};

std::vector<CameraRecord> parseCameras(const JsonCursor& root);

/// A camera in the world; it looks along its node's −z.
///
/// @return  nothing for a camera that is no pinhole, or whose node has no such direction
std::optional<Camera> placeCamera(const CameraRecord& record, const Affine3d& worldFromNode);

}  // namespace prt::gltf

#include "prt/gltf/cameras.h"

#include <cmath>
#include <limits>

namespace prt::gltf {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();

/// Whether a float can hold the vector; false for what is not finite.
bool fitsFloat(const Vec3d& vector) {
    return std::abs(vector.x) <= kLargestFloat && std::abs(vector.y) <= kLargestFloat &&
           std::abs(vector.z) <= kLargestFloat;
}

}  // namespace

std::vector<CameraRecord> parseCameras(const JsonCursor& root) {
    return parseEach(root, "cameras", [](const JsonCursor& value) {
        CameraRecord record{value.stringOr("name", ""), std::nullopt};
        if (value.at("type").toString() != "perspective") return record;
        const double fov = value.at("perspective").at("yfov").toNumber();
        constexpr double kSmallest = std::numeric_limits<float>::min();
        constexpr double kLargest = 3.1415925025939941;  // the last float below pi
        if (fov >= kSmallest && fov <= kLargest)
            record.verticalFovRadians = static_cast<float>(fov);
        return record;
    });
}

std::optional<Camera> placeCamera(const CameraRecord& record, const Affine3d& worldFromNode) {
    const Vec3d forward = (worldFromNode.linear * Vec3d(0.0, 0.0, -1.0)).normalized();
    const Vec3d yAxis = (worldFromNode.linear * Vec3d(0.0, 1.0, 0.0)).normalized();
    const Vec3d up = (yAxis - forward * forward.dot(yAxis)).normalized();
    constexpr double kTolerance = 1e-6;
    const bool isFrame = std::abs(forward.length() - 1.0) < kTolerance &&
                         std::abs(up.length() - 1.0) < kTolerance &&
                         std::abs(up.dot(forward)) < kTolerance;
    if (!record.verticalFovRadians || !isFrame || !fitsFloat(worldFromNode.translation))
        return std::nullopt;
    return Camera{record.name, Vec3f(worldFromNode.translation), Vec3f(forward), Vec3f(up),
                  *record.verticalFovRadians};
}

}  // namespace prt::gltf

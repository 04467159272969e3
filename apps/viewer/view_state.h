#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/shown_transport.h"
#include "apps/viewer/camera_pose.h"
#include "prt/basis/sh.h"
#include "prt/image/tone_curve.h"

namespace prt::viewer {

/// A baked asset, turned about the centre of its box.
struct ObjectChoice {
    std::string asset;  ///< the file
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    bool isShown = true;
};

/// One of the lights that are added up.
struct LightChoice {
    std::string source;         ///< a LIGHT argument, as prt light --help lists them
    double stops = 0.0;         ///< radiance is multiplied by 2^stops
    double azimuthDegrees = 0;  ///< turned about +y, before all lights are turned together
    bool isOn = true;
};

enum class PaneContent {
    relit,        ///< the asset in the light
    coefficient,  ///< one coefficient of the transfer, as false colour
    reference,    ///< path-traced, finer and finer while nothing changes; under the light itself,
                  ///< or, with fewer bands than the most, under these; one at a time, the left's
};

/// What one side of the picture shows.
struct Pane {
    PaneContent content = PaneContent::relit;
    std::optional<cli::ShownTransport> transport{};  ///< none: the fullest that each object has
    int bandCount = kMaxBandCount;  ///< of the light that are used; objects have fewer or as many
    int coefficient = 0;            ///< i as in C3

    bool operator==(const Pane&) const = default;
};

/// A vertex that was clicked on.
struct PickedVertex {
    std::size_t object = 0;  ///< index into ViewState::objects
    std::size_t vertex = 0;  ///< scene-wide number

    bool operator==(const PickedVertex&) const = default;
};

/// Everything that a person can choose: what is saved, and all that a picture is made of.
struct ViewState {
    std::vector<ObjectChoice> objects{};
    std::vector<LightChoice> lights{};
    Vec3d lightRotationDegrees{0.0, 0.0, 0.0};  ///< of all lights, as --rotate
    std::string window = "none";                ///< as --window; auto keeps the light above 0
    std::optional<CameraPose> camera{};         ///< none: all objects are framed
    Pane left{};                                ///< or all of the picture
    std::optional<Pane> right{};                ///< behind the line that splits it
    double splitPosition = 0.5;                 ///< of that line, 0 … 1 of the width
    bool autoExposure = true;  ///< a white sphere in this light comes out well; stops come on top
    DisplayOptions display{};
    bool showBackground = true;
    bool wireFrame = false;
    bool showLightLobe = false;    ///< the light as a lobe, in a corner
    bool showTransferLobe = true;  ///< the transfer of the picked vertex, as a lobe on it
    std::optional<PickedVertex> picked{};
};

}  // namespace prt::viewer

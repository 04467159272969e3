#pragma once

namespace prt {

/// Where the shaders have what they are given: the locations and bindings of shaders/relight.vert
/// surface.frag and mirrors.frag, of display.frag and background.frag, of receive.comp and
/// reflect.comp, and of lobe.vert, lobe.frag and overlay.frag.
namespace uniforms {
inline constexpr int kClipFromEyeSpace = 0;
inline constexpr int kEye = 1;
inline constexpr int kReceiverCount = 2;
inline constexpr int kPanelCount = 3;
inline constexpr int kBiasRadiance = 4;
inline constexpr int kBaseColorFactor = 16;
inline constexpr int kEmissiveFactor = 17;
inline constexpr int kTextureUvSets = 18;
inline constexpr int kAlphaCutoff = 19;
inline constexpr int kLineRadiance = 20;
inline constexpr int kMetallicRoughnessFactors = 21;
inline constexpr int kEnvironmentFromObject = 22;
inline constexpr int kLevelCount = 23;
inline constexpr int kRoughnesses = 32;
inline constexpr int kMostRoughnesses = 16;

inline constexpr int kExposure = 0;

inline constexpr int kForward = 0;
inline constexpr int kRightward = 1;
inline constexpr int kUpward = 2;

inline constexpr int kColumnCount = 4;
inline constexpr int kRowCount = 5;
inline constexpr int kPaddedCount = 4;

inline constexpr int kVertexCount = 3;
inline constexpr int kReflectedEye = 4;
inline constexpr int kOpen = 8;

inline constexpr int kCameraFromLobe = 2;
inline constexpr int kNegativeColor = 16;
inline constexpr int kSceneDepths = 17;
inline constexpr int kSceneCorner = 18;
inline constexpr int kLongestEdge = 19;

inline constexpr int kCorner = 0;
inline constexpr int kDiscColor = 1;
}  // namespace uniforms

namespace attributes {
inline constexpr unsigned kPosition = 0;
inline constexpr unsigned kUvSets = 1;
inline constexpr unsigned kColor = 2;
inline constexpr unsigned kNormal = 3;

inline constexpr unsigned kLobeNormal = 1;
}  // namespace attributes

namespace buffers {
inline constexpr unsigned kTransfer = 0;
inline constexpr unsigned kReceivers = 1;
inline constexpr unsigned kLight = 2;  ///< or products
inline constexpr unsigned kFirstProducts = 3;
inline constexpr int kCount = 4;

inline constexpr unsigned kRows = 1;  ///< or the first product of each cluster
inline constexpr unsigned kReceived = 3;

inline constexpr unsigned kSurfaces = 0;
inline constexpr unsigned kVertices = 1;
inline constexpr unsigned kElements = 2;
inline constexpr unsigned kIncident = 3;
inline constexpr unsigned kRelit = 4;
inline constexpr unsigned kArriving = 5;
inline constexpr unsigned kDirect = 6;
}  // namespace buffers

namespace textures {
inline constexpr unsigned kBaseColor = 0;
inline constexpr unsigned kEmission = 1;
inline constexpr unsigned kMetallicRoughness = 2;
inline constexpr unsigned kEnvironment = 3;
inline constexpr unsigned kMirrors = 4;
inline constexpr unsigned kSpecularAlbedos = 5;
}  // namespace textures

}  // namespace prt

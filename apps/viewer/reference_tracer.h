#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/shown_transport.h"
#include "apps/viewer/placed_scene.h"
#include "prt/light/environment.h"
#include "prt/light/lighting.h"
#include "prt/render/path_walk.h"

namespace prt::viewer {

/// What paths are traced for.
struct ReferenceModel {
    SurfaceModel surfaceModel = SurfaceModel::diffuse;
    int bounceCount = 0;  ///< indirect bounces (C8)

    bool operator==(const ReferenceModel&) const = default;
};

/// The model that an asset's picture approximates: surfaces as if they were diffuse, or as they
/// are, and as many bounces as were baked. Paths meet what stands in their way, so what is shown
/// without shadows has its truth with them.
ReferenceModel chooseReferenceModel(const Asset& asset, cli::ShownTransport shown);

/// What is to be seen.
struct ReferenceRequest {
    std::vector<PlacedAsset> objects{};
    /// The light itself. Null: none.
    std::shared_ptr<const Environment> environment{};
    Mat3d worldFromEnvironment{};  ///< a rotation: L(R⁻¹ω)
    /// Lights surfaces in place of the environment, which is then seen behind them alone; world
    /// axes. The same bands as a relit picture has, so that only transport can differ.
    std::optional<Lighting> lighting{};
    bool showBackground = true;
    Camera camera{};
    int width = 1280;
    int height = 720;
    ReferenceModel model{};
};

/// Equal as numbers are, and of assets and environments the same object.
bool operator==(const ReferenceRequest& a, const ReferenceRequest& b);

/// How far a reference has come.
struct ReferencePicture {
    std::shared_ptr<const Image> radiance{};  ///< linear, of the size asked for; null at first
    int pathsPerPixel = 0;  ///< of which it is the mean; 0: coarse, or of an earlier request
    std::string failure{};  ///< why there will be none; one sentence
};

struct ReferenceTracerOptions {
    int threadCount = 0;           ///< 0: one a core but one, which is left to the window
    int mostPathsPerPixel = 8192;  ///< then it rests
};

/// Path-traces a picture finer and finer on threads of its own, for as long as it is asked for the
/// same one. Every call comes from one thread and, but for finish, returns at once.
class ReferenceTracer {
  public:
    explicit ReferenceTracer(const ReferenceTracerOptions& options = {});
    ~ReferenceTracer();

    /// Goes on with an equal request, or begins anew.
    void trace(const ReferenceRequest& request);
    /// Rests until the next request, and forgets the last.
    void stop();

    /// Of the last request: coarse pictures, then the mean of all paths so far. A picture of so
    /// many paths has the same bits however it came to be (C10). Until there is the first, that of
    /// the request before stays, if it was as large.
    ReferencePicture picture() const;
    /// The same once it has so many paths a pixel, or failed.
    ReferencePicture finish(int pathsPerPixel);

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt::viewer

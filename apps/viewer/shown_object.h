#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "apps/common/relit_asset.h"
#include "apps/viewer/view_state.h"
#include "prt/asset/asset.h"
#include "prt/gpu/gpu_glossy_relighter.h"
#include "prt/gpu/gpu_relighter.h"
#include "prt/gpu/gpu_scene.h"
#include "prt/gpu/gpu_vertex_radiance.h"

namespace prt::viewer {

struct RelightingOptions {
    int threadCount = 0;  ///< 0: one a core
    bool onCard = true;   ///< what has been baked is relit by OpenGL
    /// What the objects of one context have in common.
    std::shared_ptr<GpuPrograms> programs = std::make_shared<GpuPrograms>();
    std::shared_ptr<cli::SurfaceTables> tables = std::make_shared<cli::SurfaceTables>();
};

/// The layer that a pane shows of an asset: the one that was asked for, or else all there is.
cli::ShownTransport chooseTransport(const Pane& pane, const CompressedTransfer& transfer);

/// An asset on the graphics card, and its radiance in each pane.
class ShownObject {
  public:
    static constexpr std::size_t kPaneCount = 2;

    /// @throws Error  as GpuScene
    ShownObject(std::shared_ptr<const Asset> asset, std::string path,
                const RelightingOptions& options);

    const Asset& asset() const { return *asset_; }
    const std::shared_ptr<const Asset>& sharedAsset() const { return asset_; }
    const GpuScene& scene() const { return scene_; }

    /// Nothing is done where nothing has changed since the last time for this pane.
    ///
    /// @param lighting  in the object's frame, with at most the asset's bands
    /// @param eye       the same
    const GpuRadiance& relight(std::size_t paneIndex, const Pane& pane, const Lighting& lighting,
                               const Vec3f& eye);

    /// The transfer of a vertex, in the object's frame; none where it follows from normals alone.
    ///
    /// @param shown  that the pane shows
    /// @param eye    in the object's frame, for surfaces that are not diffuse
    std::optional<Lighting> expandVertex(std::size_t paneIndex, cli::ShownTransport shown,
                                         std::size_t vertex, const Vec3f& eye);

  private:
    /// What one pane shows.
    struct Relit {
        const GpuRadiance* radiance = nullptr;  ///< the last
        Pane pane;
        cli::ShownTransport shown{};
        std::vector<Vec3d> coefficients;
        Vec3f eye{0.0f, 0.0f, 0.0f};
        std::optional<cli::AssetRelighter> relighter;
        std::optional<GpuRelighter> vectorsOnCard;
        std::optional<GpuGlossyRelighter> matricesOnCard;
        std::vector<Vec3d> receivedOnCard;  ///< the light that matricesOnCard was relit with
        std::optional<GpuVertexRadiance> uploaded;
        std::vector<Vec3f> vertexRadiance;  ///< before it goes to the card, kept for its memory
    };

    const GpuRadiance& relightOnCard(Relit& relit, cli::ShownTransport shown,
                                     const Lighting& lighting, const Vec3f& eye) const;
    const GpuRadiance& relightHere(Relit& relit, cli::ShownTransport shown,
                                   const Lighting& lighting, const Vec3f& eye) const;
    cli::AssetRelighter& relighterOf(Relit& relit) const;

    std::shared_ptr<const Asset> asset_;
    std::string path_;
    RelightingOptions options_;
    GpuScene scene_;
    std::array<Relit, kPaneCount> relit_;
};

}  // namespace prt::viewer

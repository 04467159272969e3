#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/given_brdfs.h"
#include "apps/common/shown_transport.h"
#include "apps/common/surface_tables.h"
#include "prt/asset/asset.h"
#include "prt/brdf/brdf.h"
#include "prt/io/image_io.h"
#include "prt/light/lighting.h"
#include "prt/relight/exit_radiance.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/relight/relighter.h"

namespace prt::cli {

/// Reads an asset that can be shown: with triangles, textures decoded.
///
/// @param limits  of its textures
/// @throws Error  as readAsset; malformed for one without triangles
Asset readShownAsset(const std::string& path, const ImageLimits& limits);

/// What is shown of an asset: what was asked for, or else all there is.
///
/// @param path    how to call the asset in an error
/// @throws Error  invalidOption for what the asset cannot show, and for BRDFs that are given where
///                surfaces are shown as if they were diffuse
ShownTransport chooseShown(const Asset& asset, const std::string& path,
                           std::optional<ShownTransport> asked, const GivenBrdfs& brdfs);

/// A sentence for each of the BRDFs whose lobe the bands of an asset's matrices cannot hold.
std::vector<std::string> describeLostLobes(const Asset& asset, ShownTransport shown,
                                           const GivenBrdfs& brdfs);

/// Relights an asset. What its normals tell needs no layer, so every asset can show it; the others
/// must have been baked.
class AssetRelighter {
  public:
    /// @param asset   must outlive this
    /// @param path    how to call the asset in an error
    /// @param brdfs   of surfaces as they are
    /// @param tables  may be shared, by one thread; null: its own
    AssetRelighter(const Asset& asset, std::string path, GivenBrdfs brdfs = {}, int threadCount = 0,
                   std::shared_ptr<SurfaceTables> tables = {});
    ~AssetRelighter();

    /// What every vertex sends to an eye. Where surfaces are taken for diffuse, perBaseColor is B
    /// (C7) and the rest 0.
    ///
    /// @throws Error  invalidOption for a layer that the asset lacks
    std::vector<ExitRadiance> relight(ShownTransport shown, const Lighting& lighting,
                                      const Vec3f& eye);

    /// B of every vertex (C7), for surfaces that are taken for diffuse, as relight() has it.
    ///
    /// @param radiance  one a vertex, written
    void relightVectors(ShownTransport shown, const Lighting& lighting, std::span<Vec3f> radiance);

    /// What relights one layer of matrices; kept until another is asked for.
    const GlossyRelighter& glossyRelighter(ShownTransport shown);

    /// What relights one layer of matrices: GlossyRelighter, or what is made as it is.
    ///
    /// @param more  that its constructor takes at the end
    template <class MatrixRelighter, class... More>
    MatrixRelighter makeGlossyRelighter(ShownTransport shown, const More&... more) {
        const GlossyInputs inputs = prepareGlossy(shown);
        return MatrixRelighter(inputs.ofNormals ? *inputs.ofNormals : asset_.transfer, inputs.layer,
                               inputs.receivers, inputs.views, inputs.options, more...);
    }

  private:
    struct GlossyInputs {
        std::optional<CompressedTransfer> ofNormals{};  ///< where the asset has no such layer
        Transport layer{};
        std::vector<ReceiverSurface> receivers{};
        const GltfViewTable& views;
        GlossyRelightOptions options{};
    };
    GlossyInputs prepareGlossy(ShownTransport shown);

    const Asset& asset_;
    std::string path_;
    GivenBrdfs brdfs_;
    int threadCount_;
    std::shared_ptr<SurfaceTables> tables_;
    std::optional<std::pair<ShownTransport, Relighter>> lastOfVectors_;
    std::optional<std::pair<ShownTransport, GlossyRelighter>> lastGlossy_;
};

/// Whether a picture of it is to show something of the environment (MirrorEnvironment).
bool hasMirrors(const std::vector<ExitRadiance>& vertexRadiance);

/// The least smoothing of a light under which no vertex reflects negative light, one factor a band.
///
/// @param lighting  turned as it will be
/// @throws Error    invalidOption for a layer that the asset lacks, or is of matrices
std::vector<double> deringForAsset(const Asset& asset, const std::string& path,
                                   ShownTransport shown, const Lighting& lighting);

/// The same for the fullest of the layers that show surfaces as if they were diffuse.
std::vector<double> deringForAsset(const Asset& asset, const std::string& path,
                                   const Lighting& lighting);

}  // namespace prt::cli

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/given_brdfs.h"
#include "apps/common/shown_transport.h"
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
    /// @param asset  must outlive this
    /// @param path   how to call the asset in an error
    /// @param brdfs  of surfaces as they are
    AssetRelighter(const Asset& asset, std::string path, GivenBrdfs brdfs = {},
                   int threadCount = 0);
    ~AssetRelighter();

    /// What every vertex sends to an eye. Where surfaces are taken for diffuse, perBaseColor is B
    /// (C7) and the rest 0.
    ///
    /// @throws Error  invalidOption for a layer that the asset lacks
    std::vector<ExitRadiance> relight(ShownTransport shown, const Lighting& lighting,
                                      const Vec3f& eye);

    /// What relights one layer, of vectors or of matrices; kept until another is asked for.
    const Relighter& vectorRelighter(ShownTransport shown);
    const GlossyRelighter& glossyRelighter(ShownTransport shown);

    /// What relights one layer of matrices: GlossyRelighter, or what is made as it is.
    template <class MatrixRelighter>
    MatrixRelighter makeGlossyRelighter(ShownTransport shown) {
        const GlossyInputs inputs = prepareGlossy(shown);
        return MatrixRelighter(inputs.ofNormals ? *inputs.ofNormals : asset_.transfer, inputs.layer,
                               inputs.receivers, *views_, inputs.options);
    }

  private:
    struct GlossyInputs {
        std::optional<CompressedTransfer> ofNormals{};  ///< where the asset has no such layer
        Transport layer{};
        std::vector<ReceiverSurface> receivers{};
        GlossyRelightOptions options{};
    };
    GlossyInputs prepareGlossy(ShownTransport shown);

    const Asset& asset_;
    std::string path_;
    GivenBrdfs brdfs_;
    int threadCount_;
    std::optional<GltfViewTable> views_;
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

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "prt/brdf/brdf_view_table.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/light/lighting.h"
#include "prt/relight/exit_radiance.h"
#include "prt/relight/receiver_surface.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

struct GlossyRelightOptions {
    /// Receivers of glTF materials smoother than this are split (below), where there is a layer
    /// of visibility alone to tell what comes straight from the light.
    double leastRoughness = 0.0;
    /// What each material of the scene reflects instead of what glTF says, null for those that
    /// keep to it; none for all that do. For the bands of incident radiance.
    std::vector<std::shared_ptr<const BrdfViewTable>> materialTables{};
};

/// Where parts of the receivers may begin: at multiples of it.
inline constexpr std::size_t kGlossyPartSize = 64;

/// Shows one layer of matrices to an eye, as often as light and eye change. In a receiver's frame
///
///   l_i = Σ_j M_ij L_j     B(ω_o) = Σ_i f_i(ω_o) l_i                    [Sloan02, 5; Kautz02]
///
/// The view is not limited by bands. Of a glTF surface of metallic m, with f of GGX of F0 = 0 and
/// F0 = 1 and of a layered Lambert lobe, K, B and D being their B(ω_o):
///
///   perBaseColor = (1 − m) 0.96 D + m (B − K)      constant = K + 0.04 (1 − m)(B − K)
///
/// Of another BRDF all is in `constant`.
///
/// Split receivers, whose lobes the bands cannot hold, take K and B from what has bounced, l − l⁰,
/// l⁰ = M⁰ L of the layer of visibility alone. In place of the rest they tell how much of it
/// arrives, with w what arrives of white light and h what would without shadows:
///
///   mirrorVisibility = Σ_i f_i w_i / Σ_i f_i h_i, f of F0 = 1     w_i = √(4π) M⁰_i0
///
/// The same light and eye give the same bits, whole or in parts, on one instruction set (C10).
class GlossyRelighter {
  public:
    /// @param transfer   whose layers are as large as its counts say
    /// @param transport  a layer of matrices that `transfer` has
    /// @param receivers  one a receiver (describeReceivers)
    /// @param views      for the bands of incident radiance of that layer
    /// @throws Error     invalidOption if there is no such layer, outOfMemory
    GlossyRelighter(const CompressedTransfer& transfer, Transport transport,
                    std::span<const ReceiverSurface> receivers, const GltfViewTable& views,
                    const GlossyRelightOptions& options = {});
    ~GlossyRelighter();
    GlossyRelighter(GlossyRelighter&&) noexcept;
    GlossyRelighter& operator=(GlossyRelighter&&) noexcept;

    std::size_t receiverCount() const;
    int bandCount() const;          ///< of light
    int incidentBandCount() const;  ///< of incident radiance
    /// Bytes of transfer that one receive() of all receivers reads.
    std::size_t transferBytes() const;

    /// Floats that receive() writes for one receiver.
    std::size_t incidentSize() const;

    /// The light as it arrives, to be kept while only the eye moves.
    ///
    /// @param lighting  in the object's frame, with at most bandCount() bands
    /// @param begin     a multiple of kGlossyPartSize
    /// @param incident  of the receivers from begin on, incidentSize() each, written
    void receive(const Lighting& lighting, std::size_t begin, std::span<float> incident) const;

    /// What the eye sees of it.
    ///
    /// @param eye       in the object's frame
    /// @param incident  what receive() wrote for these receivers
    /// @param radiance  of the receivers from begin on, written
    void reflect(const Vec3f& eye, std::size_t begin, std::span<const float> incident,
                 std::span<ExitRadiance> radiance) const;

    /// Both at once, while incident radiance is in the core's cache. Each call makes ready for
    /// the light anew: parts are better large.
    void relight(const Lighting& lighting, const Vec3f& eye, std::size_t begin,
                 std::span<ExitRadiance> radiance) const;

  private:
    struct State;
    std::size_t checkPart(std::size_t begin, std::size_t count) const;

    std::unique_ptr<State> state_;
};

}  // namespace prt

#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "prt/light/lighting.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// Where parts of the receivers may begin: at multiples of it.
inline constexpr std::size_t kRelightPartSize = 4096;

/// Relights one layer of an asset, as often as the light changes.
///
///   B(x) = Σ_i T_i(x) L_i        outgoing radiance is albedo(x) · B(x) (C7)  [Sloan02; Kautz04]
///
/// Keeps its own copy of the transfer in blocks of 16 receivers, in the asset's precision, so that
/// one pass over memory serves red, green and blue. With clusters the sum over i is made once for
/// each of their vectors, and a receiver adds up those of its cluster [Sloan03]. The same light
/// gives the same bits, whole or in parts, on one instruction set (C10).
class Relighter {
  public:
    /// @param transfer   whose layers are as large as its counts say
    /// @param transport  a layer that `transfer` has
    /// @throws Error     invalidOption if there is no such layer, outOfMemory
    Relighter(const CompressedTransfer& transfer, Transport transport);
    ~Relighter();
    Relighter(Relighter&&) noexcept;
    Relighter& operator=(Relighter&&) noexcept;

    std::size_t receiverCount() const;
    int bandCount() const;
    /// Bytes of transfer that one relight() of all receivers reads; an unfilled block counts whole.
    std::size_t transferBytes() const;

    /// @param lighting  in the object's frame, with at most bandCount() bands; higher bands of the
    ///                  transfer go unused
    /// @param radiance  B, before the receiver's albedo, W·sr⁻¹·m⁻²; one a receiver, written
    void relight(const Lighting& lighting, std::span<Vec3f> radiance) const;

    /// The same for receivers [begin, begin + radiance.size()): for callers with their own threads.
    /// @param begin  a multiple of kRelightPartSize
    void relight(const Lighting& lighting, std::size_t begin, std::span<Vec3f> radiance) const;

  private:
    struct Blocks;
    std::unique_ptr<Blocks> blocks_;
};

}  // namespace prt

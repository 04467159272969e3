#pragma once

#include <cstddef>

#include "prt/light/lighting.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// The transfer of one receiver, however it is stored, as a function of the direction that light
/// comes from, in the object's frame: for each channel its coefficients, whose sum with those of a
/// light is B. Of matrices, what the receiver would send if it were a diffuse one,
///
///   T_j = (1/π) Σ_i c_i M_ij        c the clamped cosine about the normal       [Ramamoorthi01]
///
/// @param transfer  whose layers are as large as its counts say
/// @throws Error    invalidOption if there is no such layer
Lighting expandReceiver(const CompressedTransfer& transfer, Transport transport,
                        std::size_t receiver);

/// The same of a receiver as its material is, seen by an eye: what it sends of the light from each
/// direction, Σ_i f_i(ω_o) M_ij, without what mirrorVisibility tells of.
///
/// Relights the receiver by each basis function, so that all that a GlossyRelighter does is in it.
///
/// @param eye        in the object's frame
/// @param baseColor  of the receiver
Lighting expandReceiver(const GlossyRelighter& relighter, const Vec3f& eye, std::size_t receiver,
                        const Vec3f& baseColor = Vec3f(1.0f));

}  // namespace prt

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "prt/transfer/stored_table.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// A coefficient that has no place in the textures, and stands as a constant instead.
struct LeftOutCoefficient {
    int index = 0;              ///< i of T_i, for all channels (C3)
    std::vector<float> mean{};  ///< over all texels: [channel]; what T_i is taken to be
    double rmse = 0.0;          ///< of that, over all texels and channels
    double largestError = 0.0;
};

/// The transfer vectors of a grid of texels in RGBA textures of 8 bits, four coefficients each: six
/// textures hold 24 of the 25 coefficients of 5 bands [Kautz04].
///
///   T_i(x) = bias + scale · q/255      q the stored integer, not sRGB
///
/// Where n is odd, one coefficient is left out.
///
/// Differs from the notes, which do not say which one: it is that of the least variance, and its
/// mean is kept.
struct TransferTextures {
    Transport transport = Transport::shadowed;
    int bandCount = 0;
    int channelCount = 1;
    int width = 0;
    int height = 0;
    std::vector<int> coefficients{};              ///< i of those that are stored, ascending (C3)
    std::optional<LeftOutCoefficient> leftOut{};  ///< nothing where n is even
    StoredTable table{};  ///< unorm8; a row a texel, row by row from the top: [channel][stored one]

    /// ⌊n²/4⌋ for each channel: channel c has those from c ⌊n²/4⌋ on.
    std::size_t textureCount() const { return table.numbers.panelCount(); }

    /// Texels of four bytes. Stored coefficient s of a channel is byte s mod 4 of its texture
    /// ⌊s/4⌋.
    std::span<const std::byte> texture(std::size_t index) const {
        return table.numbers.panel(index);
    }
};

/// Packs a layer whose receivers are texels, row by row from the top.
///
/// The error of a stored coefficient is at most its range over all texels / 510.
///
/// @param layer          of vectors, of width · height receivers, at least one
/// @param bandCount      n ≥ 2
TransferTextures packTransferTextures(const TransferLayer& layer, int bandCount, int width,
                                      int height);

/// The layer that the textures hold, with the mean where a coefficient was left out.
TransferLayer unpackTransferTextures(const TransferTextures& textures);

}  // namespace prt

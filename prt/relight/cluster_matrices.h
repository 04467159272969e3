#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/aligned_bytes.h"
#include "prt/relight/cluster_matrix_kernel.h"
#include "prt/relight/matrix_blocks.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// A layer of matrices with clusters, to be multiplied by one light after the other. What the light
/// makes of the clusters' matrices is summed once, and each receiver weighs that of its own:
///
///   l(x) = R_k0 + Σ_p w_p(x) R_kp        R_kp = M_kp L                              [Sloan03]
class ClusterMatrices {
  public:
    /// @param layer   complete, with clusters
    /// @throws Error  outOfMemory
    ClusterMatrices(const CompressedLayer& layer, int bandCount);

    /// Of what is read for all receivers.
    std::size_t byteCount() const;

    /// Nothing: weights are few, and read in sequence.
    std::span<const std::byte> block(std::size_t) const { return {}; }

    /// A light as multiply() takes it: R of all clusters.
    ///
    /// @param lighting  with at most as many bands
    /// @throws Error    outOfMemory
    AlignedBytes fold(const Lighting& lighting) const;

    /// As MatrixBlocks has it. What is behind the last receiver is left alone.
    void multiply(const AlignedBytes& light, std::size_t begin, std::size_t blockCount,
                  std::size_t stride, float* incident) const;

  private:
    template <class Stored>
    void copyWeights(const CoefficientTable& rows);

    std::size_t vectorSize_ = 0;
    MatrixBlocks bases_;
    std::vector<std::uint32_t> firstVectors_;
    std::vector<std::uint32_t> clusters_;
    std::size_t weightBytes_ = 0;
    AlignedBytes weights_;
    ClusteredMatrices view_;
};

}  // namespace prt

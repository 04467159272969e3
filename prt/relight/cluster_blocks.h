#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/aligned_bytes.h"
#include "prt/relight/cluster_kernel.h"
#include "prt/relight/vector_blocks.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// A layer with clusters, to be relit by one light after the other. What the light makes of the
/// clusters' vectors is summed once, and each receiver weighs that of its own:
///
///   B(x) = R_k0 + Σ_p w_p(x) R_kp        R_kp = Σ_i b_kp,i L_i                        [Sloan03]
///
/// Within parts of 4096, receivers stand in the sequence of their clusters, in blocks of 16 of one
/// cluster each, so that R_kp is the same for a whole vector of them.
class ClusterBlocks {
  public:
    /// @param layer   complete, with clusters
    /// @throws Error  outOfMemory
    ClusterBlocks(const CompressedLayer& layer, int bandCount);

    /// Of what is read for all receivers.
    std::size_t byteCount() const;

    /// @param lighting  with at most as many bands
    /// @param begin     a multiple of kClusterPartSize
    /// @param radiance  of the receivers from begin on, written
    /// @throws Error    outOfMemory
    void relight(const Lighting& lighting, std::size_t begin, ResultStore store,
                 std::span<Vec3f> radiance) const;

  private:
    /// What ClusteredReceivers of all parts are views of.
    struct Group {
        std::vector<std::uint32_t> clusters;
        std::vector<std::uint16_t> stagedAt;
        std::size_t weightBytes = 0;
        AlignedBytes weights;

        std::size_t byteCount() const;
    };
    template <class Stored>
    void pack(const CompressedLayer& layer);
    std::vector<Vec3f> multiplyVectors(const Lighting& lighting) const;

    TransferEncoding encoding_ = TransferEncoding::float32;
    VectorBlocks vectors_;
    std::vector<std::uint32_t> firstVectors_;
    Group blocks_;
    Group singles_;
    std::vector<ClusterPart> parts_;
};

}  // namespace prt

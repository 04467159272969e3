#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "prt/brdf/brdf_view_table.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/relight/aligned_bytes.h"
#include "prt/relight/receiver_surface.h"
#include "prt/relight/reflect_kernel.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// Which receivers of glTF materials are split.
struct LobeSplit {
    const CompressedLayer* visibility = nullptr;  ///< matrices of it alone; null: none is split
    double leastRoughness = 0.0;                  ///< those smoother are
    bool hasBounced = false;  ///< whether their incident radiance is followed by what has bounced
};

/// Those of a layer, if the asset can tell what comes straight from the light.
LobeSplit chooseSplit(const CompressedTransfer& transfer, const CompressedLayer& layer,
                      double leastRoughness);

/// Whether a receiver of a glTF material is one of them.
bool isSplit(const LobeSplit& split, const ReceiverSurface& receiver);

/// What every receiver of an asset reflects to any view, ready for one eye after the other.
class ReceiverLobes {
  public:
    /// @param materialTables  one a material, null for those that glTF describes; or none
    /// @throws Error          outOfMemory
    ReceiverLobes(std::span<const ReceiverSurface> receivers, const GltfViewTable& views,
                  std::span<const std::shared_ptr<const BrdfViewTable>> materialTables,
                  const LobeSplit& split);

    std::size_t receiverCount() const { return lobes_.size(); }
    bool isSplit(std::size_t receiver) const { return lobes_[receiver].kind == LobeKind::split; }
    /// Floats of a padded row, and of all incident radiance of a receiver.
    std::size_t rowSize() const { return view_.rowSize; }
    std::size_t incidentSize() const { return view_.incidentSize; }

    /// @param begin     a multiple of kReflectBlockSize
    /// @param incident  of the receivers from begin on, [receiver][channel][incidentIndex], and
    ///                  again of what has bounced where the split says so
    /// @param ahead     memory that will be read next
    /// @param radiance  of the receivers from begin on, written
    void reflect(const Vec3f& eye, std::size_t begin, const float* incident,
                 std::span<const std::byte> ahead, std::span<ExitRadiance> radiance) const;

  private:
    void placeReceivers(std::span<const ReceiverSurface> receivers);
    void copyGltfRows(const GltfViewTable& views);
    void copyOtherRows(std::span<const std::shared_ptr<const BrdfViewTable>> materialTables);
    void splitLobes(std::span<const ReceiverSurface> receivers, const LobeSplit& split);

    std::vector<ReceiverLobe> lobes_;
    AlignedBytes places_;
    AlignedBytes specular_;
    AlignedBytes diffuse_;
    std::vector<AlignedBytes> others_;  ///< of each material
    AlignedBytes open_;
    AlignedBytes arriving_;
    AlignedBytes orders_;
    ReflectView view_;
};

}  // namespace prt

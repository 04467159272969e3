#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "prt/gltf/gltf_document.h"
#include "prt/gltf/json_cursor.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// What a layer with clusters says in place of the name of an encoding.
inline constexpr const char* kClusters = "clusters";

/// The accessor that holds the vectors of a layer's clusters.
struct VectorsPlace {
    std::size_t accessor = 0;
    std::string checksum{};  ///< of its numbers, tightly packed
};

/// @throws Error  limitExceeded for more clusters or components than the format can count
void checkClusterCounts(const CompressedLayer& layer);

/// The form of that accessor. @param bases  with all but the numbers
AccessorInfo vectorsInfo(const ClusterBases& bases, std::size_t dimension);

/// The numbers as they stand there: row after row.
std::vector<std::byte> packVectors(const ClusterBases& bases);

/// The member "clusters" of a layer.
nlohmann::ordered_json describeClusters(const CompressedLayer& layer, const VectorsPlace& place);

/// What the layer's checksum covers of it.
std::string clusterChecksumText(const CompressedLayer& layer, const VectorsPlace& place);

/// Reads "clusters" into the layer, whose encodings are known.
///
/// @param dimension  coefficients of a vector
VectorsPlace parseClusters(const gltf::JsonCursor& object, std::size_t dimension,
                           CompressedLayer& layer);

/// Reads the vectors of a layer's clusters.
void readVectors(const GltfDocument& document, const VectorsPlace& place, int bandCount,
                 CompressedLayer& layer);

/// Demands that each vertex has a cluster of the layer, weights from 0 to 1 for its components, and
/// zeros behind them.
void checkWeights(const CompressedLayer& layer);

}  // namespace prt

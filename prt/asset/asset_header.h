#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/asset/clusters.h"
#include "prt/gltf/gltf_document.h"

namespace prt {

inline constexpr const char* kAssetExtension = "OPENPRT_radiance_transfer";

/// The attributes _PRT_<first>, … that hold a layer, four numbers each.
struct AttributeRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// The extension object of the glTF's root: all of an asset but its coefficients.
struct AssetHeader {
    int bandCount = 0;
    std::size_t vertexCount = 0;
    Provenance provenance;
    std::vector<CompressedLayer> layers;  ///< without data
    std::vector<AttributeRange> ranges;   ///< one a layer
    std::vector<VectorsPlace> vectors;    ///< one a layer, of use where it has clusters
    std::vector<std::string> checksums;   ///< one a buffer view
};

inline constexpr std::size_t kCoefficientsPerAttribute = CoefficientTable::kPanelWidth;

/// "_PRT_<index>".
std::string attributeSemantic(std::size_t index);

/// The form of each attribute of a layer.
AccessorInfo attributeInfo(const CompressedLayer& layer, std::size_t vertexCount);

/// How many numbers a layer stores for a vertex: coefficients, or a cluster and its weights.
std::size_t countNumbers(int bandCount, const CompressedLayer& layer);

/// How many attributes a layer takes: its numbers are padded to a multiple of four.
std::size_t countAttributes(int bandCount, const CompressedLayer& layer);

/// Where each layer's attributes stand when they follow one another.
std::vector<AttributeRange> arrangeAttributes(const CompressedTransfer& transfer);

/// Where each layer's vectors stand: in the accessors 0, 1, … of the file.
std::vector<VectorsPlace> arrangeVectors(const CompressedTransfer& transfer);

/// The JSON text, without the checksums of buffer views, which the glTF writer adds.
///
/// @param vertexCount  how many vertices the file will have
std::string formatHeader(const CompressedTransfer& transfer, std::size_t vertexCount,
                         const Provenance& provenance);

/// @throws Error  malformed or unsupported, without a place
AssetHeader parseHeader(const std::string& json);

}  // namespace prt

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt::test {

/// A layer without numbers, its channels and bands of incident radiance as a bake may choose them.
inline CompressedLayer makeLayerKind(Transport transport, int bandCount) {
    CompressedLayer layer;
    layer.transport = transport;
    const bool isColored = transport == Transport::interreflected || transport == Transport::glossy;
    layer.channelCount = isColored ? 3 : 1;
    if (isGlossy(transport))
        layer.incidentBandCount =
            std::min(transport == Transport::glossy ? 2 : 3, kMaxBandCount + 1 - bandCount);
    return layer;
}

/// How the clusters of a layer are stored, and how many components each has.
struct ClusterForm {
    TransferEncoding weights = TransferEncoding::unorm8;
    TransferEncoding vectors = TransferEncoding::unorm16;
    std::vector<std::uint32_t> componentCounts = {2, 0, 3};
};

/// Writes a number as it is stored: the float, or the fraction of the largest integer.
inline void storeFraction(TransferEncoding encoding, float fraction, std::byte* bytes) {
    const auto integer =
        static_cast<std::uint32_t>(static_cast<double>(fraction) * largestStored(encoding));
    if (encoding == TransferEncoding::float32)
        std::memcpy(bytes, &fraction, sizeof(fraction));
    else
        std::memcpy(bytes, &integer, bytesPerCoefficient(encoding));
}

/// Random vectors within ±0.25, and those of integers with ranges.
inline StoredTable makeRandomTable(TransferEncoding encoding, std::size_t rowCount,
                                   std::size_t columnCount, RandomStream& random) {
    StoredTable table{.encoding = encoding};
    const bool isFloat = encoding == TransferEncoding::float32;
    const std::size_t width = bytesPerCoefficient(encoding);
    std::vector<std::byte> rows(rowCount * columnCount * width);
    for (std::size_t begin = 0; begin < rows.size(); begin += width)
        storeFraction(encoding,
                      isFloat ? 0.5f * random.nextUnitFloat() - 0.25f : random.nextUnitFloat(),
                      &rows[begin]);
    for (std::size_t column = 0; column < columnCount && !isFloat; ++column) {
        table.scale.push_back(0.3f * random.nextUnitFloat());
        table.bias.push_back(-0.1f * random.nextUnitFloat());
    }
    table.numbers = CoefficientTable(rowCount, columnCount, width);
    table.numbers.writeRows(0, std::span<const std::byte>(rows));
    return table;
}

/// A layer of receivers with random clusters, weights and vectors.
inline CompressedLayer makeClusteredLayer(Transport transport, int bandCount,
                                          std::size_t receiverCount, const ClusterForm& form,
                                          std::uint64_t seed = 1) {
    CompressedLayer layer = makeLayerKind(transport, bandCount);
    layer.largestError = 0.0123f;
    RandomStream random(seed, 41);
    ClusterBases& bases = layer.bases.emplace();
    bases.componentCounts = form.componentCounts;
    bases.vectors = makeRandomTable(form.vectors, bases.firstVectors().back(),
                                    coefficientsPerReceiver(bandCount, layer), random);

    const std::size_t width = bytesPerCoefficient(form.weights);
    layer.table.encoding = form.weights;
    layer.table.numbers = CoefficientTable(receiverCount, 1 + bases.componentCount(), width);
    for (std::size_t receiver = 0; receiver < receiverCount; ++receiver) {
        std::vector<std::byte> row((1 + bases.componentCount()) * width);
        const auto cluster = static_cast<std::uint32_t>(random.nextBits() % bases.clusterCount());
        const auto number = static_cast<float>(cluster);
        std::memcpy(row.data(),
                    form.weights == TransferEncoding::float32 ? static_cast<const void*>(&number)
                                                              : &cluster,
                    width);
        for (std::uint32_t p = 1; p <= bases.componentCounts[cluster]; ++p)
            storeFraction(form.weights, random.nextUnitFloat(), &row[p * width]);
        layer.table.numbers.writeRows(receiver, std::span<const std::byte>(row));
    }
    return layer;
}

}  // namespace prt::test

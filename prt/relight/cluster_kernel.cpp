#include "prt/relight/cluster_kernel.h"

#include <algorithm>
#include <array>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/relight/cluster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "prt/relight/relight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

using RowTag = hn::CappedTag<float, kStagedRowSize>;

/// Writes results of staged rows, without the rows' ends, a few at a time: so they go to memory
/// while others are computed.
class RowStream {
  public:
    RowStream() = default;
    RowStream(const float* rows, std::size_t rowCount, ResultStore store, float* to)
        : rows_(rows), to_(to), count_(3 * rowCount), store_(store) {
        copyUntil(countUnaligned(to_, count_));
    }

    /// Writes up to as many vectors.
    HWY_INLINE void write(std::size_t vectorCount) {
        const std::size_t vectorSize = hn::Lanes(FloatTag());
        for (; vectorCount > 0 && next_ + vectorSize <= count_; --vectorCount) {
            if constexpr (hn::MaxLanes(FloatTag()) == 1)
                copyUntil(next_ + 1);
            else
                writeVector();
        }
    }

    void finish() {
        write(count_);
        copyUntil(count_);
    }

  private:
    /// Which floats of the rows come next, when the first is red, green or blue.
    struct Selections {
        alignas(64) std::array<std::array<std::int32_t, kRelightBlockSize>, 3> floats{};

        constexpr Selections() {
            for (std::size_t color = 0; color < 3; ++color) {
                for (std::size_t lane = 0; lane < kRelightBlockSize; ++lane)
                    floats[color][lane] = static_cast<std::int32_t>(
                        (color + lane) / 3 * kStagedRowSize + (color + lane) % 3);
            }
        }
    };

    /// A vector of results lies within two vectors of rows.
    HWY_INLINE void writeVector() {
        static constexpr Selections kSelections;
        const FloatTag d;
        const hn::RebindToSigned<FloatTag> di;
        const float* const row = rows_ + next_ / 3 * kStagedRowSize;
        const auto selection = hn::Load(di, kSelections.floats[next_ % 3].data());
        const auto laneCount = hn::Set(di, static_cast<std::int32_t>(hn::Lanes(d)));
        const auto isInFirst = hn::RebindMask(d, hn::Lt(selection, laneCount));
        const auto lanes =
            hn::IndicesFromVec(d, hn::And(selection, hn::Sub(laneCount, hn::Set(di, 1))));
        const Vector result =
            hn::IfThenElse(isInFirst, hn::TableLookupLanes(hn::LoadU(d, row), lanes),
                           hn::TableLookupLanes(hn::LoadU(d, row + hn::Lanes(d)), lanes));
        if (store_ == ResultStore::streaming)
            hn::Stream(result, d, to_ + next_);
        else
            hn::StoreU(result, d, to_ + next_);
        next_ += hn::Lanes(d);
    }

    void copyUntil(std::size_t end) {
        for (; next_ < end; ++next_)
            to_[next_] = rows_[next_ / 3 * kStagedRowSize + next_ % 3];
    }

    const float* rows_ = nullptr;
    float* to_ = nullptr;
    std::size_t next_ = 0;
    std::size_t count_ = 0;  ///< of floats
    ResultStore store_ = ResultStore::cached;
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void stageLanes(const RgbVector& rgb, const std::uint16_t* stagedAt, float* staged) {
    staged[*stagedAt] = hn::GetLane(rgb.red);
    staged[*stagedAt + 1] = hn::GetLane(rgb.green);
    staged[*stagedAt + 2] = hn::GetLane(rgb.blue);
}
#else
/// Stores a row of each 128 bits, those of receivers 0, 4, 8, … from stagedAt on.
template <class D>
HWY_INLINE void scatterRows(D d, hn::Vec<D> rows, const std::uint16_t* stagedAt, float* staged) {
    if constexpr (hn::MaxLanes(D()) == kStagedRowSize) {
        hn::Store(rows, d, staged + *stagedAt);
    } else {
        const hn::Half<D> half;
        scatterRows(half, hn::LowerHalf(half, rows), stagedAt, staged);
        scatterRows(half, hn::UpperHalf(half, rows), stagedAt + hn::Lanes(half), staged);
    }
}

HWY_INLINE void stageLanes(const RgbVector& rgb, const std::uint16_t* stagedAt, float* staged) {
    const FloatTag d;
    const Vector redBlue01 = hn::InterleaveLower(d, rgb.red, rgb.blue);
    const Vector redBlue23 = hn::InterleaveUpper(d, rgb.red, rgb.blue);
    const Vector green01 = hn::InterleaveLower(d, rgb.green, rgb.green);
    const Vector green23 = hn::InterleaveUpper(d, rgb.green, rgb.green);
    scatterRows(d, hn::InterleaveLower(d, redBlue01, green01), stagedAt, staged);
    scatterRows(d, hn::InterleaveUpper(d, redBlue01, green01), stagedAt + 1, staged);
    scatterRows(d, hn::InterleaveLower(d, redBlue23, green23), stagedAt + 2, staged);
    scatterRows(d, hn::InterleaveUpper(d, redBlue23, green23), stagedAt + 3, staged);
}
#endif

template <class Stored>
HWY_INLINE void relightBlock(const Stored* weights, const Vec3f* products,
                             std::size_t componentCount, const std::uint16_t* stagedAt,
                             float* staged) {
    for (std::size_t lane = 0; lane < kRelightBlockSize; lane += hn::Lanes(FloatTag()))
        stageLanes(relightLanes<1>(weights + lane, products[0], products + 1, componentCount),
                   stagedAt + lane, staged);
}

/// Sums as relightLanes() does, but the three colours of one receiver at once.
template <class Stored>
HWY_INLINE void relightSingle(const Stored* weights, const Vec3f* products,
                              std::size_t componentCount, float* staged) {
    const RowTag d;
    for (std::size_t color = 0; color < kStagedRowSize; color += hn::Lanes(d)) {
        const auto addTo = [&](hn::Vec<RowTag> sum, std::size_t p) HWY_ATTR {
            return hn::MulAdd(hn::Set(d, static_cast<float>(weights[p])),
                              hn::LoadU(d, &products[1 + p].x + color), sum);
        };
        auto even = hn::LoadU(d, &products[0].x + color);
        auto odd = hn::Zero(d);
        std::size_t p = 0;
        for (; p + 2 <= componentCount; p += 2) {
            even = addTo(even, p);
            odd = addTo(odd, p + 1);
        }
        if (p < componentCount) even = addTo(even, p);
        hn::Store(hn::Add(even, odd), d, staged + color);
    }
}

/// Relights a part, and meanwhile writes the part before.
template <class Stored>
void relightPart(const ClusterPart& part, const ClusterRadiance& radiance, float* staged,
                 RowStream& partBefore) {
    const std::uint32_t* const first = radiance.firstVectors.data();
    constexpr std::size_t kBlockFloats = 3 * kRelightBlockSize;
    const auto* weights = reinterpret_cast<const Stored*>(part.blocks.weights);
    const std::uint16_t* stagedAt = part.blocks.stagedAt;
    for (const std::uint32_t k : part.blocks.clusters) {
        const std::size_t componentCount = first[k + 1] - first[k] - 1;
        relightBlock(weights, radiance.products + first[k], componentCount, stagedAt, staged);
        weights += componentCount * kRelightBlockSize;
        stagedAt += kRelightBlockSize;
        partBefore.write(kBlockFloats / hn::Lanes(FloatTag()));
    }

    weights = reinterpret_cast<const Stored*>(part.singles.weights);
    stagedAt = part.singles.stagedAt;
    for (const std::uint32_t k : part.singles.clusters) {
        const std::size_t componentCount = first[k + 1] - first[k] - 1;
        relightSingle(weights, radiance.products + first[k], componentCount, staged + *stagedAt);
        weights += componentCount;
        ++stagedAt;
    }
}

template <class Stored>
void relightStored(std::span<const ClusterPart> parts, const ClusterRadiance& clusters,
                   std::size_t receiverCount, ResultStore store, float* staged, float* radiance) {
    RowStream partBefore;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t begin = i * kClusterPartSize;
        float* const rows = staged + i % 2 * kClusterPartSize * kStagedRowSize;
        relightPart<Stored>(parts[i], clusters, rows, partBefore);
        partBefore.finish();
        partBefore = RowStream(rows, std::min(kClusterPartSize, receiverCount - begin), store,
                               radiance + 3 * begin);
    }
    partBefore.finish();
    hwy::FlushStream();
}

void relight(TransferEncoding encoding, std::span<const ClusterPart> parts,
             const ClusterRadiance& clusters, std::size_t receiverCount, ResultStore store,
             float* staged, float* radiance) {
    switch (encoding) {
        case TransferEncoding::float32:
            return relightStored<float>(parts, clusters, receiverCount, store, staged, radiance);
        case TransferEncoding::unorm16:
            return relightStored<std::uint16_t>(parts, clusters, receiverCount, store, staged,
                                                radiance);
        case TransferEncoding::unorm8:
            return relightStored<std::uint8_t>(parts, clusters, receiverCount, store, staged,
                                               radiance);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(relight);

void relightClusters(TransferEncoding encoding, std::span<const ClusterPart> parts,
                     const ClusterRadiance& clusters, std::size_t receiverCount, ResultStore store,
                     float* staged, Vec3f* radiance) {
    HWY_DYNAMIC_DISPATCH(relight)
    (encoding, parts, clusters, receiverCount, store, staged, reinterpret_cast<float*>(radiance));
}

}  // namespace prt
#endif  // HWY_ONCE

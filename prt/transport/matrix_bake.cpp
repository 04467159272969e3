// Bibliography
//   [Sloan02]  Precomputed radiance transfer: the transfer matrix and its bounces
#include "prt/transport/matrix_bake.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "prt/base/byte_stream.h"
#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake.h"
#include "prt/transport/bake_plan.h"

namespace prt {
namespace {

constexpr int kBounceLimit = 1000;
constexpr float kConvergedFraction = 1e-6f;
// A sky of radiance 1 brings no more than 2π y_00² = ½ of it into a first element, if no surface
// makes light of its own.
constexpr float kEndlessLight = 50.0f;
// Rows that are copied between a table and memory at a time.
constexpr std::size_t kRowsAtOnce = 64;

std::vector<ColumnRange> divideColumns(std::size_t columnCount, std::size_t columnsAtOnce) {
    std::vector<ColumnRange> ranges;
    const std::size_t most = std::min(columnsAtOnce, columnCount);
    const std::size_t rangeCount = (columnCount + most - 1) / most;
    for (std::size_t i = 0; i < rangeCount; ++i)
        ranges.push_back({i * columnCount / rangeCount, (i + 1) * columnCount / rangeCount});
    return ranges;
}

/// The columns of one row of a table, which has one channel or three, as three.
///
/// @param rows    of each channel's matrix
/// @param stride  columns of the matrix
void copyColumns(std::span<const float> row, std::size_t rowCount, std::size_t stride,
                 ColumnRange columns, float* copy) {
    const std::size_t elementCount = rowCount * stride;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float* source = row.data() + (row.size() > elementCount ? channel : 0) * elementCount;
        for (std::size_t i = 0; i < rowCount; ++i, copy += columns.count())
            std::copy_n(source + i * stride + columns.begin, columns.count(), copy);
    }
}

}  // namespace

/// Some columns of the matrices of all receivers, side by side in memory: what a bounce is of.
class MatrixBake::Sources {
  public:
    /// @param tables  of fronts, and of backs behind them
    Sources(const MatrixBake& bake, const CoefficientTable& fronts, const CoefficientTable& backs,
            ColumnRange columns)
        : columns_(columns),
          rowOfBack_(bake.rowOfBack_),
          lengthPerRow_(3 * bake.rowsOfMatrix() * columns.count()),
          values_((fronts.rowCount() + bake.backs_.size()) * lengthPerRow_ + kLaneMultiple) {
        copyTable(bake, fronts, fronts.rowCount(), values_.data());
        copyTable(bake, backs, bake.backs_.size(),
                  values_.data() + fronts.rowCount() * lengthPerRow_);
    }

    ColumnRange columns() const { return columns_; }
    MatrixSources view() const { return {values_.data(), columns_, rowOfBack_}; }
    float firstElement(std::size_t row, std::size_t channel) const {
        return values_[row * lengthPerRow_ + channel * lengthPerRow_ / 3];
    }

  private:
    void copyTable(const MatrixBake& bake, const CoefficientTable& table, std::size_t rowCount,
                   float* copies) const {
        const std::size_t matrixRowCount = bake.rowsOfMatrix();
        parallelFor(rowCount, {bake.options_.threadCount, kRowsAtOnce},
                    [&](std::size_t begin, std::size_t end) {
                        std::vector<float> row(table.columnCount());
                        for (std::size_t i = begin; i < end; ++i) {
                            table.readRow(i, std::span(row));
                            copyColumns(row, matrixRowCount, bake.elementCount_ / matrixRowCount,
                                        columns_, copies + i * lengthPerRow_);
                        }
                        table.releaseMemory();
                    });
    }

    ColumnRange columns_;
    std::span<const std::uint32_t> rowOfBack_;
    std::size_t lengthPerRow_;
    std::vector<float> values_;
};

MatrixBake::MatrixBake(const MatrixGatherScene& shared, const MatrixBakeOptions& options)
    : shared_(shared),
      options_(options),
      elementCount_(shared.visibilityMatrix.elementCount()),
      rowOfBack_(shared.scene.receivers.backs.size(), kNoRow) {}

std::size_t MatrixBake::rowsOfMatrix() const {
    return static_cast<std::size_t>(
        shCoefficientCount(shared_.visibilityMatrix.incidentBandCount()));
}

bool MatrixBake::wantsBacks() const {
    return options_.bounceCount != 0 && !rowOfBack_.empty();
}

CoefficientTable MatrixBake::makeTable(std::size_t rowCount, std::size_t channelCount) const {
    return {rowCount, channelCount * elementCount_, sizeof(float), options_.tables};
}

/// Gives the backs that were met since the last call their rows.
std::vector<std::uint32_t> MatrixBake::takeNewBacks() {
    std::sort(backsMet_.begin(), backsMet_.end());
    std::vector<std::uint32_t> receivers;
    for (const std::uint32_t back : std::exchange(backsMet_, {})) {
        if (rowOfBack_[back] != kNoRow) continue;
        rowOfBack_[back] =
            static_cast<std::uint32_t>(shared_.scene.receivers.fronts.size() + backs_.size());
        backs_.push_back(back);
        receivers.push_back(backReceiver(shared_.scene.receivers, back));
    }
    return receivers;
}

CoefficientTable MatrixBake::gatherVisible() {
    const std::size_t frontCount = shared_.scene.receivers.fronts.size();
    CoefficientTable fronts = makeTable(frontCount, 1);
    Stage stage{"matrices", std::vector<std::uint32_t>(frontCount), elementCount_};
    std::iota(stage.receivers.begin(), stage.receivers.end(), 0u);
    gatherStage(stage, 0, fronts);
    if (wantsBacks()) visibleBacks_ = makeTable(countDoubleSided(shared_.scene), 1);
    for (int wave = 1;; ++wave) {
        const std::size_t firstRow = backs_.size();
        stage = {"matrices-b" + std::to_string(wave), takeNewBacks(), elementCount_};
        if (stage.receivers.empty()) return fronts;
        gatherStage(stage, firstRow, visibleBacks_);
    }
}

void MatrixBake::gatherStage(const Stage& stage, std::size_t firstRow, CoefficientTable& table) {
    ProgressReporter reporter(options_.progress, "trace", "rays",
                              stage.receivers.size() * raysPerReceiver());
    forUnits(
        stage, visibleCounts_, reporter,
        [&](MatrixGatherer& gatherer, std::uint32_t receiver, std::span<float> matrix, Unit& unit) {
            gatherer.gatherVisible(receiver, matrix);
            if (wantsBacks()) gatherer.appendBacksMet(unit.backsMet);
        },
        [&](std::size_t begin, const Unit& unit) {
            table.writeRows(firstRow + begin, std::span<const float>(unit.values));
        });
}

CoefficientTable MatrixBake::addBounces(const CoefficientTable& visible) {
    const bool untilConverged = options_.bounceCount == kInfiniteBounces;
    const int limit = untilConverged ? kBounceLimit : options_.bounceCount;
    CoefficientTable fronts = makeTable(visible.rowCount(), 3);
    if (limit == 0) {
        replicateChannels(visible, fronts);
        return fronts;
    }
    CoefficientTable backs = makeTable(limit > 1 ? backs_.size() : 0, 3);
    for (bool converged = false; bounceCount_ < limit && !converged;) {
        ++bounceCount_;
        const bool isLast = bounceCount_ == limit;
        const Change change = bounceCount_ == 1
                                  ? bounce(visible, visibleBacks_, isLast, fronts, backs)
                                  : bounce(fronts, backs, isLast, fronts, backs);
        if (!untilConverged) continue;
        converged = change.largestChange <= kConvergedFraction * change.largest;
        if (!(change.largest < kEndlessLight))
            throw Error(ErrorCode::invalidOption,
                        "the surfaces send on more light than they receive, so that it bounces "
                        "without end",
                        {}, "ask for a number of bounces");
    }
    return fronts;
}

void MatrixBake::replicateChannels(const CoefficientTable& visible, CoefficientTable& total) const {
    parallelFor(visible.rowCount(), {options_.threadCount, kRowsAtOnce},
                [&](std::size_t begin, std::size_t end) {
                    std::vector<float> row(elementCount_);
                    std::vector<float> rows((end - begin) * 3 * elementCount_);
                    for (std::size_t i = begin; i < end; ++i) {
                        visible.readRow(i, std::span(row));
                        for (std::size_t channel = 0; channel < 3; ++channel)
                            std::ranges::copy(
                                row, rows.data() + (3 * (i - begin) + channel) * elementCount_);
                    }
                    total.writeRows(begin, std::span<const float>(rows));
                    visible.releaseMemory();
                });
}

MatrixBake::Change MatrixBake::bounce(const CoefficientTable& fronts, const CoefficientTable& backs,
                                      bool isLast, CoefficientTable& nextFronts,
                                      CoefficientTable& nextBacks) {
    const std::size_t frontCount = fronts.rowCount();
    std::vector<std::uint32_t> receivers(frontCount + (isLast ? 0 : backs_.size()));
    std::iota(receivers.begin(), receivers.begin() + static_cast<std::ptrdiff_t>(frontCount), 0u);
    for (std::size_t i = frontCount; i < receivers.size(); ++i)
        receivers[i] = backReceiver(shared_.scene.receivers, backs_[i - frontCount]);

    const std::size_t columnCount = elementCount_ / rowsOfMatrix();
    const std::vector<ColumnRange> ranges = divideColumns(columnCount, options_.columnsAtOnce);
    const std::string stage = "bounce " + std::to_string(bounceCount_);
    ProgressReporter reporter(options_.progress, stage, "rays",
                              ranges.size() * receivers.size() * raysPerReceiver());
    Change change;
    for (const ColumnRange& columns : ranges) {
        const Sources sources(*this, fronts, backs, columns);
        const std::string name = "m" + std::to_string(bounceCount_) + "-" +
                                 std::to_string(columns.begin) + "-" + std::to_string(columns.end);
        const std::size_t length = 3 * rowsOfMatrix() * columns.count();
        const auto begin = receivers.begin();
        const auto middle = begin + static_cast<std::ptrdiff_t>(frontCount);
        bounceStage({name, {begin, middle}, length}, 0, sources, reporter, nextFronts, change);
        if (!isLast)
            bounceStage({name + "b", {middle, receivers.end()}, length}, frontCount, sources,
                        reporter, nextBacks, change);
    }
    return change;
}

void MatrixBake::bounceStage(const Stage& stage, std::size_t firstSource, const Sources& sources,
                             ProgressReporter& reporter, CoefficientTable& table, Change& change) {
    const ColumnRange columns = sources.columns();
    const std::size_t stride = elementCount_ / rowsOfMatrix();
    forUnits(
        stage, bounceCounts_, reporter,
        [&](MatrixGatherer& gatherer, std::uint32_t receiver, std::span<float> matrix, Unit&) {
            std::vector<float> visible(elementCount_);
            gatherer.gatherVisible(receiver, visible);
            copyColumns(visible, rowsOfMatrix(), stride, columns, matrix.data());
            gatherer.addReflected(receiver, sources.view(), matrix);
        },
        [&](std::size_t begin, const Unit& unit) {
            writeColumns(unit.values, begin, columns, table);
            if (columns.begin > 0) return;
            const std::size_t length = stage.numbersPerReceiver;
            const std::lock_guard lock(finishing_);
            for (std::size_t i = 0; i < unit.values.size(); i += length / 3) {
                const float before =
                    sources.firstElement(firstSource + begin + i / length, i % length * 3 / length);
                change.largest = std::max(change.largest, std::abs(unit.values[i]));
                change.largestChange =
                    std::max(change.largestChange, std::abs(unit.values[i] - before));
            }
        });
}

/// Writes some columns of the matrices of consecutive receivers.
void MatrixBake::writeColumns(std::span<const float> values, std::size_t firstRow,
                              ColumnRange columns, CoefficientTable& table) const {
    const std::size_t stride = elementCount_ / rowsOfMatrix();
    if (columns.count() == stride) return table.writeRows(firstRow, values);
    const std::size_t length = table.columnCount();
    std::vector<float> rows(values.size() / columns.count() * stride);
    for (std::size_t begin = 0; begin < rows.size(); begin += length)
        table.readRow(firstRow + begin / length, std::span(rows).subspan(begin, length));
    const float* source = values.data();
    for (std::size_t begin = columns.begin; begin < rows.size(); begin += stride) {
        std::copy_n(source, columns.count(), rows.data() + begin);
        source += columns.count();
    }
    table.writeRows(firstRow, std::span<const float>(rows));
    table.releaseMemory();
}

template <class Make, class Keep>
void MatrixBake::forUnits(const Stage& stage, GatherCounts& counts, ProgressReporter& reporter,
                          Make make, Keep keep) {
    const std::span<const std::uint32_t> all = stage.receivers;
    const std::size_t unitSize =
        receiversPerUnit(all.size(), raysPerReceiver(), options_.checkpoint != nullptr);
    parallelFor(
        all.size(), {options_.threadCount, unitSize}, [&](std::size_t begin, std::size_t end) {
            const UnitKey key{stage.name, static_cast<std::uint32_t>(begin / unitSize), begin, end};
            const std::span<const std::uint32_t> receivers = all.subspan(begin, end - begin);
            Unit unit;
            const bool wasKept = loadUnit(key, stage, unit);
            if (wasKept) {
                reporter.advance(receivers.size() * raysPerReceiver());
            } else {
                unit = makeUnit(stage, receivers, reporter, make);
                storeUnit(key, unit);
            }
            keep(begin, unit);
            const std::lock_guard lock(finishing_);
            counts += unit.counts;
            resumedUnitCount_ += wasKept;
            backsMet_.insert(backsMet_.end(), unit.backsMet.begin(), unit.backsMet.end());
        });
}

template <class Make>
MatrixBake::Unit MatrixBake::makeUnit(const Stage& stage, std::span<const std::uint32_t> receivers,
                                      ProgressReporter& reporter, Make make) const {
    MatrixGatherer gatherer(shared_);
    const std::size_t length = stage.numbersPerReceiver;
    Unit unit;
    unit.values.resize(receivers.size() * length);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        make(gatherer, receivers[i], std::span(unit.values).subspan(i * length, length), unit);
        reporter.advance(raysPerReceiver());
    }
    std::sort(unit.backsMet.begin(), unit.backsMet.end());
    const auto repeated = std::ranges::unique(unit.backsMet);
    unit.backsMet.erase(repeated.begin(), repeated.end());
    unit.counts = gatherer.counts();
    return unit;
}

bool MatrixBake::loadUnit(const UnitKey& key, const Stage& stage, Unit& unit) const {
    if (!options_.checkpoint) return false;
    return options_.checkpoint->load(key, [&](std::span<const std::byte> payload) {
        ByteReader reader(payload);
        unit.counts.rayCount = reader.readNumber<std::uint64_t>();
        unit.counts.hitCount = reader.readNumber<std::uint64_t>();
        unit.counts.invalidRayCount = reader.readNumber<std::uint64_t>();
        unit.backsMet = reader.readVector<std::uint32_t>(reader.readNumber<std::uint32_t>());
        unit.values = reader.readVector<float>((key.end - key.begin) * stage.numbersPerReceiver);
        reader.requireEnd();
        for (const std::uint32_t back : unit.backsMet)
            if (back >= rowOfBack_.size())
                throw Error(ErrorCode::malformed, "has a hit near a receiver that does not exist");
    });
}

void MatrixBake::storeUnit(const UnitKey& key, const Unit& unit) const {
    if (!options_.checkpoint) return;
    ByteWriter writer(sizeof(GatherCounts) + unit.backsMet.size() * sizeof(std::uint32_t) +
                      unit.values.size() * sizeof(float));
    writer.writeNumber(unit.counts.rayCount);
    writer.writeNumber(unit.counts.hitCount);
    writer.writeNumber(unit.counts.invalidRayCount);
    writer.writeNumber(static_cast<std::uint32_t>(unit.backsMet.size()));
    writer.write(unit.backsMet);
    writer.write(unit.values);
    options_.checkpoint->store(key, writer.bytes());
}

}  // namespace prt

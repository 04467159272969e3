#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "prt/parallel/progress.h"
#include "prt/transfer/coefficient_table.h"
#include "prt/transport/checkpoint.h"
#include "prt/transport/matrix_gatherer.h"

namespace prt {

struct MatrixBakeOptions {
    int bounceCount = 0;  ///< or kInfiniteBounces
    int threadCount = 0;
    /// A bounce needs the matrices of all receivers in memory, but no more than so many columns of
    /// them at a time.
    std::size_t columnsAtOnce = SIZE_MAX;
    TableStorage tables{};
    const ProgressCallback& progress;
    Checkpoint* checkpoint = nullptr;  ///< if given, finished units are kept there
};

/// Gathers transfer matrices at all receivers, and again for each bounce: M ← M⁽⁰⁾ + F(M), in
/// place, for some columns of light after the others. What is made at a time changes no bit.
///
/// The backs of double-sided surfaces are receivers too, those that rays have met.
class MatrixBake {
  public:
    MatrixBake(const MatrixGatherScene& shared, const MatrixBakeOptions& options);

    /// Matrices of fronts without bounces. @return  rows [i][j]
    CoefficientTable gatherVisible();

    /// The same with bounces. With kInfiniteBounces they end when one changes no receiver's first
    /// element by more than 1e-6 of the largest, or after 1000.
    ///
    /// @param visible  from gatherVisible
    /// @return         rows [channel][i][j]
    /// @throws Error   invalidOption if surfaces reflect more than comes in, so that there is no
    /// end
    CoefficientTable addBounces(const CoefficientTable& visible);

    int bounceCount() const { return bounceCount_; }  ///< bounces made
    const GatherCounts& visibleCounts() const { return visibleCounts_; }
    const GatherCounts& bounceCounts() const { return bounceCounts_; }
    std::size_t resumedUnitCount() const { return resumedUnitCount_; }

  private:
    /// Receivers that are worked at in units, and the name of these.
    struct Stage {
        std::string name;
        std::vector<std::uint32_t> receivers;
        std::size_t numbersPerReceiver = 0;
    };
    struct Unit {
        std::vector<float> values;            // [receiver][number]
        std::vector<std::uint32_t> backsMet;  // ascending
        GatherCounts counts;
    };
    /// Of first elements, all receivers'.
    struct Change {
        float largest = 0.0f;
        float largestChange = 0.0f;
    };
    class Sources;

    std::size_t raysPerReceiver() const { return shared_.pattern.reversedX.size(); }
    std::size_t rowsOfMatrix() const;
    bool wantsBacks() const;
    CoefficientTable makeTable(std::size_t rowCount, std::size_t channelCount) const;
    std::vector<std::uint32_t> takeNewBacks();
    void gatherStage(const Stage& stage, std::size_t firstRow, CoefficientTable& table);
    void replicateChannels(const CoefficientTable& visible, CoefficientTable& total) const;
    Change bounce(const CoefficientTable& fronts, const CoefficientTable& backs, bool isLast,
                  CoefficientTable& nextFronts, CoefficientTable& nextBacks);
    void bounceStage(const Stage& stage, std::size_t firstSource, const Sources& sources,
                     ProgressReporter& reporter, CoefficientTable& table, Change& change);
    void writeColumns(std::span<const float> values, std::size_t firstRow, ColumnRange columns,
                      CoefficientTable& table) const;

    template <class Make, class Keep>
    void forUnits(const Stage& stage, GatherCounts& counts, ProgressReporter& reporter, Make make,
                  Keep keep);
    template <class Make>
    Unit makeUnit(const Stage& stage, std::span<const std::uint32_t> receivers,
                  ProgressReporter& reporter, Make make) const;
    bool loadUnit(const UnitKey& key, const Stage& stage, Unit& unit) const;
    void storeUnit(const UnitKey& key, const Unit& unit) const;

    const MatrixGatherScene& shared_;
    const MatrixBakeOptions& options_;
    std::size_t elementCount_;              // n_in² n²
    std::vector<std::uint32_t> backs_;      // that have a row, by row
    std::vector<std::uint32_t> rowOfBack_;  // after the fronts
    std::vector<std::uint32_t> backsMet_;   // and have none yet
    CoefficientTable visibleBacks_;
    int bounceCount_ = 0;
    std::mutex finishing_;
    GatherCounts visibleCounts_;
    GatherCounts bounceCounts_;
    std::size_t resumedUnitCount_ = 0;
};

}  // namespace prt

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "prt/base/scratch_file.h"

namespace prt {

/// Where the numbers of a table are kept.
struct TableStorage {
    bool onDisk = false;                    ///< in a file without a name
    std::filesystem::path scratchFolder{};  ///< of that file; empty: the system's
};

/// Coefficients of many receivers, one row each, in memory or on disk.
///
/// The table is cut into panels of four columns, and a panel holds them for all receivers: what
/// glTF stores as one vertex attribute. So a step that works column by column, which bounces,
/// quantisation and the writing of an asset all do, needs no more than a panel in memory. The last
/// panel is padded with zeros.
///
/// Rows of a table may be written from many threads, each its own.
class CoefficientTable {
  public:
    static constexpr std::size_t kPanelWidth = 4;
    static constexpr std::size_t countPanels(std::size_t columnCount) {
        return (columnCount + kPanelWidth - 1) / kPanelWidth;
    }

    CoefficientTable() = default;
    /// Zeros; they take no memory until they are written.
    ///
    /// @param elementBytes  of one number: 1, 2 or 4
    /// @throws Error        writeFailed for the scratch folder
    CoefficientTable(std::size_t rowCount, std::size_t columnCount, std::size_t elementBytes,
                     TableStorage storage = {});
    CoefficientTable(const CoefficientTable& other);
    CoefficientTable(CoefficientTable&&) noexcept = default;
    CoefficientTable& operator=(const CoefficientTable& other);
    CoefficientTable& operator=(CoefficientTable&&) noexcept = default;

    std::size_t rowCount() const { return rowCount_; }
    std::size_t columnCount() const { return columnCount_; }
    std::size_t elementBytes() const { return elementBytes_; }
    std::size_t panelCount() const { return countPanels(columnCount_); }
    /// Of all numbers, without padding.
    std::size_t byteCount() const { return rowCount_ * columnCount_ * elementBytes_; }
    const TableStorage& storage() const { return storage_; }

    /// [receiver][4], good until the table is written or goes.
    std::span<const std::byte> panel(std::size_t index) const;

    /// @param rows  [receiver][4] of the receivers from firstRow on
    /// @throws Error  writeFailed
    void writePanel(std::size_t index, std::size_t firstRow, std::span<const std::byte> rows);

    /// The same for whole rows. @param rows  [receiver][column]
    template <class Element>
    void writeRows(std::size_t firstRow, std::span<const Element> rows) {
        writeRowBytes(firstRow, std::as_bytes(rows));
    }

    /// @param row  columnCount() numbers, written
    template <class Element>
    void readRow(std::size_t index, std::span<Element> row) const {
        readRowBytes(index, std::as_writable_bytes(row));
    }

    /// Gives the memory that reading took back to the system, where the table is on disk.
    void releaseMemory() const;

  private:
    struct FreeBytes {
        void operator()(std::byte* bytes) const;
    };

    std::size_t panelBytes() const { return rowCount_ * kPanelWidth * elementBytes_; }
    const std::byte* data() const { return view_ ? view_->data() : memory_.get(); }
    void writeRowBytes(std::size_t firstRow, std::span<const std::byte> rows);
    void readRowBytes(std::size_t index, std::span<std::byte> row) const;

    std::size_t rowCount_ = 0;
    std::size_t columnCount_ = 0;
    std::size_t elementBytes_ = 0;
    TableStorage storage_;
    std::unique_ptr<std::byte[], FreeBytes> memory_;
    std::unique_ptr<ScratchFile> file_;
    std::unique_ptr<ScratchView> view_;
};

/// Whether all numbers are the same, bit by bit.
bool operator==(const CoefficientTable& a, const CoefficientTable& b);

/// A panel of a table of floats: [receiver][4].
std::span<const float> floatPanel(const CoefficientTable& table, std::size_t index);

/// A table in memory. @param rows  [receiver][column]
template <class Element>
CoefficientTable makeTable(std::size_t columnCount, const std::vector<Element>& rows) {
    CoefficientTable table(rows.size() / columnCount, columnCount, sizeof(Element));
    table.writeRows(0, std::span(rows));
    return table;
}

/// All numbers of a table, [receiver][column].
template <class Element>
std::vector<Element> copyRows(const CoefficientTable& table) {
    const std::size_t length = table.columnCount();
    std::vector<Element> rows(table.rowCount() * length);
    for (std::size_t row = 0; row < table.rowCount(); ++row)
        table.readRow(row, std::span(rows).subspan(row * length, length));
    return rows;
}

}  // namespace prt

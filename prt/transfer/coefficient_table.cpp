#include "prt/transfer/coefficient_table.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "prt/base/assert.h"

namespace prt {

void CoefficientTable::FreeBytes::operator()(std::byte* bytes) const {
    std::free(bytes);
}

CoefficientTable::CoefficientTable(std::size_t rowCount, std::size_t columnCount,
                                   std::size_t elementBytes, TableStorage storage)
    : rowCount_(rowCount),
      columnCount_(columnCount),
      elementBytes_(elementBytes),
      storage_(std::move(storage)) {
    const std::size_t byteCount = panelCount() * panelBytes();
    if (byteCount == 0) return;
    if (storage_.onDisk) {
        file_ = std::make_unique<ScratchFile>(storage_.scratchFolder);
        file_->resize(byteCount);
        view_ = std::make_unique<ScratchView>(*file_, byteCount);
    } else {
        memory_.reset(static_cast<std::byte*>(std::calloc(byteCount, 1)));
        if (!memory_) throw std::bad_alloc();
    }
}

CoefficientTable::CoefficientTable(const CoefficientTable& other)
    : CoefficientTable(other.rowCount_, other.columnCount_, other.elementBytes_, other.storage_) {
    for (std::size_t index = 0; index < panelCount(); ++index) {
        writePanel(index, 0, other.panel(index));
        other.releaseMemory();
    }
}

CoefficientTable& CoefficientTable::operator=(const CoefficientTable& other) {
    return *this = CoefficientTable(other);
}

std::span<const std::byte> CoefficientTable::panel(std::size_t index) const {
    PRT_ASSERT(index < panelCount(), "the panel is one of the table");
    if (rowCount_ == 0) return {};
    return {data() + index * panelBytes(), panelBytes()};
}

void CoefficientTable::writePanel(std::size_t index, std::size_t firstRow,
                                  std::span<const std::byte> rows) {
    const std::size_t begin = firstRow * kPanelWidth * elementBytes_;
    PRT_ASSERT(index < panelCount() && begin + rows.size() <= panelBytes(),
               "the rows are in a panel of the table");
    if (rows.empty()) return;
    const std::size_t offset = index * panelBytes() + begin;
    if (file_)
        file_->write(offset, rows);
    else
        std::memcpy(memory_.get() + offset, rows.data(), rows.size());
}

void CoefficientTable::writeRowBytes(std::size_t firstRow, std::span<const std::byte> rows) {
    const std::size_t rowBytes = columnCount_ * elementBytes_;
    const std::size_t width = kPanelWidth * elementBytes_;
    PRT_ASSERT(rows.empty() || rows.size() % rowBytes == 0, "whole rows");
    const std::size_t count = rows.empty() ? 0 : rows.size() / rowBytes;
    std::vector<std::byte> part(count * width);
    for (std::size_t index = 0; index < panelCount(); ++index) {
        const std::size_t begin = index * width;
        const std::size_t usedBytes = std::min(width, rowBytes - begin);
        if (usedBytes < width) std::fill(part.begin(), part.end(), std::byte{0});
        for (std::size_t row = 0; row < count; ++row)
            std::memcpy(part.data() + row * width, rows.data() + row * rowBytes + begin, usedBytes);
        writePanel(index, firstRow, part);
    }
}

void CoefficientTable::readRowBytes(std::size_t index, std::span<std::byte> row) const {
    PRT_ASSERT(index < rowCount_ && row.size() == columnCount_ * elementBytes_,
               "a row of the table, and room for it");
    const std::size_t width = kPanelWidth * elementBytes_;
    const std::byte* source = data() + index * width;
    for (std::size_t begin = 0; begin < row.size(); begin += width, source += panelBytes())
        std::memcpy(row.data() + begin, source, std::min(width, row.size() - begin));
}

void CoefficientTable::releaseMemory() const {
    if (view_) view_->release();
}

bool operator==(const CoefficientTable& a, const CoefficientTable& b) {
    if (a.rowCount() != b.rowCount() || a.columnCount() != b.columnCount() ||
        a.elementBytes() != b.elementBytes())
        return false;
    for (std::size_t index = 0; index < a.panelCount(); ++index)
        if (!std::ranges::equal(a.panel(index), b.panel(index))) return false;
    return true;
}

std::span<const float> floatPanel(const CoefficientTable& table, std::size_t index) {
    PRT_ASSERT(table.elementBytes() == sizeof(float), "the table is of floats");
    const std::span<const std::byte> bytes = table.panel(index);
    return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

}  // namespace prt

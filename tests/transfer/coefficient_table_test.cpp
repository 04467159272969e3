#include "prt/transfer/coefficient_table.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>
#include <utility>

#include "prt/base/error.h"

namespace prt {
namespace {

/// In memory and on disk.
class CoefficientTableTest : public testing::TestWithParam<bool> {
  protected:
    template <class Element>
    CoefficientTable makeCounting(std::size_t rowCount, std::size_t columnCount) const {
        std::vector<Element> numbers(rowCount * columnCount);
        std::iota(numbers.begin(), numbers.end(), Element(1));
        CoefficientTable table(rowCount, columnCount, sizeof(Element), {GetParam(), {}});
        table.writeRows(0, std::span<const Element>(numbers));
        return table;
    }
};

TEST_P(CoefficientTableTest, RowsComeBackAndPanelsHoldFourColumns) {
    const CoefficientTable table = makeCounting<float>(3, 6);
    EXPECT_EQ(table.panelCount(), 2u);
    EXPECT_EQ(table.byteCount(), 3u * 6 * sizeof(float));
    std::vector<float> row(6);
    table.readRow(1, std::span(row));
    EXPECT_EQ(row, (std::vector<float>{7, 8, 9, 10, 11, 12}));
    const auto panelOf = [&](std::size_t index) {
        const std::span<const float> panel = floatPanel(table, index);
        return std::vector<float>(panel.begin(), panel.end());
    };
    EXPECT_EQ(panelOf(0), (std::vector<float>{1, 2, 3, 4, 7, 8, 9, 10, 13, 14, 15, 16}));
    EXPECT_EQ(panelOf(1), (std::vector<float>{5, 6, 0, 0, 11, 12, 0, 0, 17, 18, 0, 0}));
}

TEST_P(CoefficientTableTest, BeginsWithZerosAndTakesRowsAnywhere) {
    CoefficientTable table(5, 3, sizeof(std::uint16_t), {GetParam(), {}});
    table.writeRows(3, std::span<const std::uint16_t>(std::vector<std::uint16_t>{7, 8, 65535}));
    EXPECT_EQ(copyRows<std::uint16_t>(table),
              (std::vector<std::uint16_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 7, 8, 65535, 0, 0, 0}));
}

TEST_P(CoefficientTableTest, ReleasedMemoryIsReadAgain) {
    const CoefficientTable table = makeCounting<std::uint8_t>(50, 5);
    const std::vector<std::uint8_t> before = copyRows<std::uint8_t>(table);
    table.releaseMemory();
    EXPECT_EQ(copyRows<std::uint8_t>(table), before);
}

TEST_P(CoefficientTableTest, CopiesAreTheirOwn) {
    const CoefficientTable table = makeCounting<float>(4, 5);
    CoefficientTable copy = table;
    EXPECT_TRUE(copy == table);
    EXPECT_EQ(copy.storage().onDisk, GetParam());
    copy.writeRows(2, std::span<const float>(std::vector<float>(5, -1.0f)));
    EXPECT_FALSE(copy == table);
    EXPECT_TRUE(table == makeCounting<float>(4, 5));
    const CoefficientTable moved = std::move(copy);
    EXPECT_EQ(copyRows<float>(moved)[10], -1.0f);
}

TEST_P(CoefficientTableTest, RowsAreWrittenFromManyThreads) {
    constexpr std::size_t kRowsPerThread = 500;
    CoefficientTable table(4 * kRowsPerThread, 7, sizeof(float), {GetParam(), {}});
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
        threads.emplace_back([&table, t] {
            for (std::size_t row = t; row < table.rowCount(); row += 4)
                table.writeRows(
                    row, std::span<const float>(std::vector<float>(7, static_cast<float>(row))));
        });
    for (std::thread& thread : threads)
        thread.join();
    const std::vector<float> rows = copyRows<float>(table);
    for (std::size_t i = 0; i < rows.size(); ++i)
        ASSERT_EQ(rows[i], static_cast<float>(i / 7));
}

TEST_P(CoefficientTableTest, MayHaveNoRows) {
    const CoefficientTable table(0, 9, sizeof(float), {GetParam(), {}});
    EXPECT_TRUE(table.panel(2).empty());
    EXPECT_TRUE(CoefficientTable(table) == table);
}

INSTANTIATE_TEST_SUITE_P(Storage, CoefficientTableTest, testing::Bool(), [](const auto& parameter) {
    return std::string(parameter.param ? "OnDisk" : "InMemory");
});

TEST(CoefficientTable, SaysWhereItCannotBeKept) {
    try {
        const CoefficientTable table(1, 1, sizeof(float), {true, "/nowhere/at all"});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::writeFailed);
        EXPECT_EQ(error.where(), "/nowhere/at all");
    }
}

}  // namespace
}  // namespace prt

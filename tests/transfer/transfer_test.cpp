#include <gtest/gtest.h>

#include <numeric>

#include "prt/transfer/compressed_transfer.h"
#include "prt/transfer/transfer_field.h"

namespace prt {
namespace {

TEST(Transfer, NamesOfTransportsAndEncodingsAreReadBack) {
    for (const Transport transport :
         {Transport::unshadowed, Transport::shadowed, Transport::interreflected,
          Transport::glossyShadowed, Transport::glossy})
        EXPECT_EQ(parseTransport(transportName(transport)), transport);
    for (const TransferEncoding encoding :
         {TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8})
        EXPECT_EQ(parseEncoding(encodingName(encoding)), encoding);
    EXPECT_EQ(transportName(Transport::interreflected), "interreflected");
    EXPECT_EQ(transportName(Transport::glossyShadowed), "glossy-shadowed");
    EXPECT_EQ(encodingName(TransferEncoding::unorm16), "unorm16");
    EXPECT_FALSE(parseTransport("Shadowed"));
    EXPECT_FALSE(parseEncoding(""));
}

TEST(Transfer, CoefficientsAreStoredByReceiverThenChannelThenIndex) {
    TransferField field;
    field.bandCount = 2;
    field.receiverCount = 2;
    std::vector<float> numbers(24);
    std::iota(numbers.begin(), numbers.end(), 0.0f);
    field.layers = {{Transport::shadowed, 1, makeTable<float>(4, {0, 1, 2, 3, 4, 5, 6, 7})},
                    {Transport::interreflected, 3, makeTable(12, numbers)}};

    EXPECT_EQ(field.findLayer(Transport::unshadowed), nullptr);
    const TransferLayer* shadowed = field.findLayer(Transport::shadowed);
    const TransferLayer* interreflected = field.findLayer(Transport::interreflected);
    ASSERT_EQ(shadowed, &field.layers[0]);
    ASSERT_EQ(interreflected, &field.layers[1]);
    EXPECT_EQ(coefficientsPerReceiver(2, 3), 12u);

    EXPECT_EQ(transferVector(field, *shadowed, 1, 0), (std::vector<float>{4, 5, 6, 7}));
    EXPECT_EQ(transferVector(field, *interreflected, 1, 2), (std::vector<float>{20, 21, 22, 23}));
}

TEST(Transfer, MatricesHaveARowForEachCoefficientOfIncidentRadiance) {
    EXPECT_FALSE(isGlossy(Transport::interreflected));
    EXPECT_TRUE(isGlossy(Transport::glossyShadowed));
    EXPECT_TRUE(isGlossy(Transport::glossy));
    const TransferLayer matrices{Transport::glossy, 3, {}, 2};
    EXPECT_EQ(coefficientsPerReceiver(5, matrices), 3u * 4u * 25u);
    const TransferLayer vectors{Transport::shadowed, 1, {}};
    EXPECT_EQ(coefficientsPerReceiver(5, vectors), 25u);
}

template <class Number>
CompressedTransfer storedTransfer(TransferEncoding encoding, const std::vector<Number>& numbers) {
    CompressedTransfer transfer;
    transfer.bandCount = 1;
    transfer.receiverCount = numbers.size();
    CompressedLayer layer;
    layer.table.encoding = encoding;
    layer.table.numbers = makeTable(1, numbers);
    if (encoding != TransferEncoding::float32) {
        layer.table.scale = {0.5f};
        layer.table.bias = {-0.25f};
    }
    transfer.layers = {layer};
    return transfer;
}

TEST(CompressedTransfer, IntegersAreFractionsOfTheRange) {
    const CompressedTransfer floats =
        storedTransfer<float>(TransferEncoding::float32, {0.125f, -1e-30f});
    EXPECT_EQ(expandLayer(floats.layers[0]), (std::vector<float>{0.125f, -1e-30f}));

    // q/65535 and q/255 of a range of 0.5 from −0.25 on.
    const CompressedTransfer words =
        storedTransfer<std::uint16_t>(TransferEncoding::unorm16, {0, 13107, 65535});
    EXPECT_EQ(expandLayer(words.layers[0]), (std::vector<float>{-0.25f, -0.15f, 0.25f}));
    const CompressedTransfer bytes =
        storedTransfer<std::uint8_t>(TransferEncoding::unorm8, {0, 51, 255});
    EXPECT_EQ(expandLayer(bytes.layers[0]), (std::vector<float>{-0.25f, -0.15f, 0.25f}));

    EXPECT_EQ(bytes.findLayer(Transport::shadowed), &bytes.layers[0]);
    EXPECT_EQ(bytes.findLayer(Transport::interreflected), nullptr);
    EXPECT_EQ(bytesPerCoefficient(TransferEncoding::float32), 4u);
    EXPECT_EQ(bytesPerCoefficient(TransferEncoding::unorm16), 2u);
    EXPECT_EQ(bytesPerCoefficient(TransferEncoding::unorm8), 1u);
}

}  // namespace
}  // namespace prt

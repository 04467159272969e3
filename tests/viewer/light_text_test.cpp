#include "apps/viewer/light_text.h"

#include <gtest/gtest.h>

#include "apps/common/light_argument.h"

namespace prt::viewer {
namespace {

constexpr std::array kKinds = {LightKind::uniform, LightKind::sun, LightKind::sky,
                               LightKind::daylight};

TEST(LightText, IsFoundAgainFromItsText) {
    for (const LightKind kind : kKinds) {
        LightText light = usualLight(kind);
        light.numbers[0] = 12.25;
        const auto found = parseLightText(formatLightText(light));
        ASSERT_TRUE(found) << lightKindName(kind);
        EXPECT_EQ(found->kind, kind);
        EXPECT_EQ(found->numbers, light.numbers);
    }
}

TEST(LightText, OfEverySliderEndIsALight) {
    // Daylight has the numbers of a sky.
    for (const LightKind kind : {LightKind::uniform, LightKind::sun, LightKind::sky})
        for (const auto end : {&LightNumber::least, &LightNumber::most, &LightNumber::usual}) {
            LightText light{.kind = kind};
            for (std::size_t i = 0; i < 3; ++i)
                light.numbers[i] = lightNumbers(kind)[i].*end;
            EXPECT_NO_THROW(cli::loadLight(formatLightText(light), 2, {}, {}))
                << formatLightText(light);
        }
}

TEST(LightText, NumbersThatMayBeLeftOutAreFilledIn) {
    EXPECT_EQ(parseLightText("uniform:0.5")->numbers, (std::array{0.5, 0.5, 0.5}));
    EXPECT_EQ(parseLightText("sky:10,20")->numbers, (std::array{10.0, 20.0, 3.0}));
    EXPECT_EQ(parseLightText("daylight:10,20,5")->numbers, (std::array{10.0, 20.0, 5.0}));
}

TEST(LightText, FilesAndBrokenNumbersHaveNoSliders) {
    for (const char* source : {"grace.hdr", "sun:1,2", "sky:", "uniform:1,2", "sun:a,b,c", ""})
        EXPECT_FALSE(parseLightText(source)) << source;
}

TEST(LightText, IsShort) {
    EXPECT_EQ(formatLightText({LightKind::sun, {-0.001, 45.0, 0.533}}), "sun:0,45,0.53");
}

}  // namespace
}  // namespace prt::viewer

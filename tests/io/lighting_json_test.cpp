#include <random>

#include "prt/io/environment_io.h"
#include "test_files.h"

namespace prt {
namespace {

using test::catchError;

TEST(LightingJson, NumbersComeBackBitForBit) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(-60, 60);
    for (int bandCount = 1; bandCount <= 10; ++bandCount) {
        Lighting lighting(bandCount);
        for (Vec3d& c : lighting.coefficients)
            for (int channel = 0; channel < 3; ++channel)
                c[channel] = std::ldexp(mantissa(random), exponent(random));
        const Lighting back = lightingFromJson(lightingToJson(lighting), "test");
        ASSERT_EQ(back.bandCount, bandCount);
        EXPECT_EQ(back.coefficients, lighting.coefficients);
    }
}

TEST(LightingJson, TextIsTheOneOfTheContract) {
    Lighting lighting(1);
    lighting.coefficients[0] = {1.0, 0.5, -2.0};
    std::string text = lightingToJson(lighting);
    std::erase_if(text, [](char c) { return c == '\n' || c == ' '; });
    EXPECT_EQ(text, R"({"bands":1,"convention":"cs","coefficients":[[1.0,0.5,-2.0]]})");
}

TEST(LightingJson, OtherConventionsAreTurnedIntoOurs) {  // C2
    const auto read = [](const std::string& convention) {
        return lightingFromJson(R"({"bands": 2, "convention": ")" + convention +
                                    R"(", "coefficients": [[1,1,1],[2,2,2],[3,3,3],[4,4,4]]})",
                                "test");
    };
    // Without the Condon-Shortley phase, the functions of odd m have the other sign.
    const std::vector<Vec3d> expected = {Vec3d(1.0), Vec3d(-2.0), Vec3d(3.0), Vec3d(-4.0)};
    EXPECT_EQ(read("three").coefficients, expected);
    EXPECT_EQ(read("cs").coefficients[1], Vec3d(2.0));
}

TEST(LightingJson, WhatIsWrittenInAnotherConventionIsReadAsOurs) {
    Lighting lighting(3);
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
        lighting.coefficients[i] = Vec3d(static_cast<double>(i) + 1.0);
    const std::string text = lightingToJson(lighting, ShConvention::rh);
    EXPECT_NE(text.find("\"convention\": \"rh\""), std::string::npos);
    EXPECT_NE(text.find("-2.0"), std::string::npos) << "the signs are those of the convention";
    EXPECT_EQ(lightingFromJson(text, "test").coefficients, lighting.coefficients);
}

TEST(LightingJson, WrongTextsAreMalformed) {
    const std::vector<std::string> texts = {
        "",
        "[]",
        "{",
        "null",
        R"({"bands": 1, "convention": "cs"})",
        R"({"bands": 1, "coefficients": [[1,1,1]]})",
        R"({"convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 0, "convention": "cs", "coefficients": []})",
        R"({"bands": -1, "convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 1.5, "convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 65, "convention": "cs", "coefficients": []})",
        R"({"bands": 4294967297, "convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 18446744073709551615, "convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 1, "convention": "no", "coefficients": [[1,1,1]]})",
        R"({"bands": 4, "convention": "unity", "coefficients": [[1,1,1],[1,1,1],[1,1,1],[1,1,1],
            [1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],
            [1,1,1],[1,1,1]]})",
        R"({"bands": 1, "convention": 3, "coefficients": [[1,1,1]]})",
        R"({"bands": 2, "convention": "cs", "coefficients": [[1,1,1]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1,1,1]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1,"1"]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1,null]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1,1e999]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": [[1,1,NaN]]})",
        R"({"bands": 1, "convention": "cs", "coefficients": {"0": [1,1,1]}})"};
    for (const std::string& text : texts) {
        const Error error = catchError([&] { lightingFromJson(text, "light.json"); });
        EXPECT_EQ(error.code(), ErrorCode::malformed) << text;
        EXPECT_EQ(error.where(), "light.json");
    }
}

TEST(LightingJson, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    // The newline at the end may be missing.
    EXPECT_EQ(test::readDamaged(lightingToJson(Lighting(2)),
                                [](const std::string& text) { lightingFromJson(text, "test"); }),
              1u);
}

TEST(LightingJson, DepthIsNoDanger) {
    EXPECT_EQ(catchError([] { lightingFromJson(std::string(1000000, '['), "deep"); }).code(),
              ErrorCode::malformed);
}

}  // namespace
}  // namespace prt

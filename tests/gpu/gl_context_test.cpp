#include "prt/gpu/gl_context.h"

#include <string>

#include <gtest/gtest.h>

#include "prt/base/error.h"
#include "prt/gpu/shader_program.h"
#include "prt/gpu/surface_programs.h"
#include "tests/gpu/gl_test.h"

namespace prt {
namespace {

class ShaderProgram : public test::GlTest {};

TEST_F(ShaderProgram, ContextIsOfTheVersionThatShadersAreWrittenFor) {
    const std::string& description = describeDriver();
    const std::string marker = "OpenGL 4.";
    const std::size_t found = description.find(marker);
    ASSERT_NE(found, std::string::npos) << description;
    EXPECT_GE(description.at(found + marker.size()), '3') << description;
}

TEST_F(ShaderProgram, RasteriserOfMesaRunsOnTheCpu) {
    const std::string& description = describeDriver();
    const bool isMesas = description.starts_with("llvmpipe");
    const bool isCard = description.find("NVIDIA") != std::string::npos;
    if (isMesas || isCard) {
        EXPECT_EQ(isSoftwareRasteriser(), isMesas) << description;
    }
}

TEST_F(ShaderProgram, ShadersOfTheLibraryCompileInEveryForm) {
    int programCount = 0;
    for (const char* bytes : {"4", "2", "1"}) {
        for (const char* clustered : {"0", "1"}) {
            const SurfacePrograms programs(std::string("#define RELIT 0\n#define STORED_BYTES ") +
                                           bytes + "\n#define CLUSTERED " + clustered + "\n");
            for (const bool hasTextures : {false, true})
                for (const bool hasLines : {false, true})
                    programCount += programs.find({hasTextures, false, hasLines}) != 0;
        }
    }
    EXPECT_EQ(programCount, 24);
    const SurfacePrograms relit("#define RELIT 1\n#define STORED_BYTES 4\n#define CLUSTERED 0\n");
    for (const bool hasTextures : {false, true})
        for (const bool hasLines : {false, true})
            EXPECT_NE(relit.find({hasTextures, true, hasLines}), 0u);
}

TEST_F(ShaderProgram, ComputeShaderThatDoesNotCompileIsNamedWithItsFirstFault) {
    const ShaderText broken{"shaders/broken.comp",
                            "#version 430 core\nlayout(local_size_x = 1) in;\n"
                            "void main() { undeclared = VALUE; }\n"};
    try {
        linkComputeProgram(broken, "#define VALUE 1.0\n");
        FAIL() << "it compiled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unsupported);
        EXPECT_EQ(error.where(), "shaders/broken.comp");
        EXPECT_NE(std::string(error.what()).find("undeclared"), std::string::npos) << error.what();
    }
}

constexpr ShaderText kPlainVertex{"shaders/plain.vert",
                                  "#version 430 core\nvoid main() { gl_Position = vec4(0.0); }\n"};

TEST_F(ShaderProgram, ShaderThatDoesNotCompileIsNamedWithItsFirstFault) {
    const ShaderText broken{"shaders/broken.frag",
                            "#version 430 core\n\nvoid main() { undeclared = 1.0; }\n"};
    try {
        linkProgram(kPlainVertex, broken);
        FAIL() << "it compiled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unsupported);
        EXPECT_EQ(error.where(), "shaders/broken.frag");
        EXPECT_NE(std::string(error.what()).find("undeclared"), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST_F(ShaderProgram, ShadersThatDoNotFitTogetherAreBothNamed) {
    const ShaderText wantsMore{"shaders/more.frag",
                               "#version 430 core\nin vec3 given;\nout vec4 shown;\n"
                               "void main() { shown = vec4(given, 1.0); }\n"};
    try {
        linkProgram(kPlainVertex, wantsMore);
        FAIL() << "it linked";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unsupported);
        EXPECT_EQ(error.where(), "shaders/plain.vert");
        EXPECT_NE(std::string(error.what()).find("shaders/more.frag"), std::string::npos);
    }
}

TEST_F(ShaderProgram, DefinitionsReachBothShadersAndMoveNoLine) {
    const ShaderText vertex{"shaders/defined.vert",
                            "#version 430 core\nvoid main() { gl_Position = vec4(VALUE); }\n"};
    const ShaderText fragment{"shaders/defined.frag",
                              "#version 430 core\nout vec4 shown;\n"
                              "void main() { shown = vec4(VALUE * __LINE__); }\n"
                              "#if __LINE__ != 4\n#error moved\n#endif\n"};
    EXPECT_NE(linkProgram(vertex, fragment, "#define VALUE 1.0\n").get(), 0u);
}

constexpr ShaderText kPlainFragment{
    "shaders/plain.frag",
    "#version 430 core\nout vec4 shown;\nvoid main() { shown = vec4(1.0); }\n"};

TEST_F(ShaderProgram, ContextIsUsedAgainAfterAnotherHasComeAndGone) {
    {
        const GlContext other;
        EXPECT_NE(linkProgram(kPlainVertex, kPlainFragment).get(), 0u);
    }
    context().makeCurrent();
    EXPECT_NE(linkProgram(kPlainVertex, kPlainFragment).get(), 0u);
}

}  // namespace
}  // namespace prt

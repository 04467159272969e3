# Puts the texts of shaders/ into prt_gpu, so that programs need no files: prt/gpu/shader_texts.h in the build folder.
function(prt_embed_shaders)
    file(GLOB shaders CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}"
        "${PROJECT_SOURCE_DIR}/shaders/*.vert" "${PROJECT_SOURCE_DIR}/shaders/*.frag"
        "${PROJECT_SOURCE_DIR}/shaders/*.comp")
    set(texts "")
    foreach(shader IN LISTS shaders)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${shader}")
        file(READ "${PROJECT_SOURCE_DIR}/${shader}" text)
        string(APPEND texts "    {\"${shader}\", R\"glsl(${text})glsl\"},\n")
    endforeach()
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/embedded/prt/gpu/shader_texts.h" @ONLY CONTENT
"#pragma once

#include \"prt/gpu/shader_program.h\"

namespace prt {

inline constexpr ShaderText kShaderTexts[] = {
@texts@};

}  // namespace prt
")
    target_include_directories(prt_gpu PRIVATE "${PROJECT_BINARY_DIR}/embedded")
endfunction()

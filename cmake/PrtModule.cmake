# One module of the library is one folder of prt/, one static library prt_<name>, and one line of the
# module list in the top CMakeLists.txt. This file gives that line its meaning.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Warnings are errors for our own code; no flag may change what a floating-point expression means,
# because the same seed must give the same bits (C10).
add_library(prt_build_flags INTERFACE)
target_compile_features(prt_build_flags INTERFACE cxx_std_20)
target_compile_options(prt_build_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -ffp-contract=off)
# GCC 12 sees overlapping copies inside std::string that are not there.
target_compile_options(prt_build_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
target_compile_definitions(prt_build_flags INTERFACE _GLIBCXX_ASSERTIONS)
# The kernels are built for SSE4, AVX2 and AVX-512, the instruction sets of prt/math/isa.h; with sanitizers, which
# take minutes on straight-line code, for AVX2 alone. The compiler's baseline always comes along.
if(PRT_SANITIZE)
    set(unused_targets "HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL")
else()
    set(unused_targets "HWY_SSSE3|HWY_AVX3_DL")
endif()
target_compile_definitions(prt_build_flags INTERFACE "HWY_DISABLED_TARGETS=(${unused_targets})")
if(PRT_SANITIZE)
    # Null and objects that are too small are AddressSanitizer's to find, and vptr's are casts down a class hierarchy, of which there
    # are none: without them a quarter less is compiled.
    target_compile_options(prt_build_flags INTERFACE
        -fsanitize=${PRT_SANITIZE} -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(prt_build_flags INTERFACE -fsanitize=${PRT_SANITIZE})
endif()
if(PRT_LIBFUZZER)
    target_compile_options(prt_build_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Nor are the rotations instrumented, whose straight-line code over arrays of fixed size would take three minutes more.
if(PRT_SANITIZE)
    set_source_files_properties(
        "${PROJECT_SOURCE_DIR}/prt/basis/sh_rotation_single.cpp" "${PROJECT_SOURCE_DIR}/prt/basis/sh_rotation_batch.cpp"
        PROPERTIES COMPILE_OPTIONS -fno-sanitize=all)
endif()

# The other straight-line kernels are, but AddressSanitizer's checks in them are not optimized: that would take a minute more.
if(PRT_SANITIZE MATCHES address)
    set_source_files_properties(
        "${PROJECT_SOURCE_DIR}/prt/basis/sh.cpp" "${PROJECT_SOURCE_DIR}/prt/light/texel_kernel.cpp"
        "${PROJECT_SOURCE_DIR}/prt/transport/gather_kernels.cpp" PROPERTIES COMPILE_OPTIONS -O0)
endif()

# prt_compile_together(<target> <source>...): eight sources at a time, which with sanitizers takes a third of the time. What Highway
# compiles again for each instruction set stays apart.
function(prt_compile_together target)
    foreach(source IN LISTS ARGN)
        file(STRINGS "${source}" is_highway REGEX "HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(is_highway)
            set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
    # To GCC an anonymous namespace of one of them is then that of a header.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

set_property(GLOBAL PROPERTY PRT_MODULES "")

# prt_module(<name> [PLAYER] [USES <module>...] [LIBRARIES <target>...])
function(prt_module name)
    cmake_parse_arguments(PARSE_ARGV 1 module "PLAYER" "" "USES;LIBRARIES")
    get_property(known GLOBAL PROPERTY PRT_MODULES)
    foreach(used IN LISTS module_USES)
        if(NOT used IN_LIST known)
            message(FATAL_ERROR "module ${name} uses ${used}, which does not stand above it")
        endif()
        get_target_property(used_by_player prt_${used} PRT_PLAYER)
        if(module_PLAYER AND NOT used_by_player)
            message(FATAL_ERROR "module ${name} is in the player but uses ${used}, which is not")
        endif()
    endforeach()

    file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/prt/${name}/*.cpp")
    file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/prt/${name}/*.h")
    add_library(prt_${name} STATIC ${sources} ${headers})
    set_target_properties(prt_${name} PROPERTIES
        LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON PRT_PLAYER "${module_PLAYER}"
        PRT_USES "${module_USES}" EXPORT_NAME ${name})
    if(PRT_SANITIZE)
        prt_compile_together(prt_${name} ${sources})
    endif()
    target_compile_features(prt_${name} PUBLIC cxx_std_20)
    target_include_directories(prt_${name} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    list(TRANSFORM module_USES PREPEND prt_ OUTPUT_VARIABLE used_targets)
    target_link_libraries(prt_${name} PUBLIC ${used_targets})
    # Imath's vectors are the one third-party type of the public headers.
    list(FIND module_LIBRARIES Imath::Imath imath_index)
    if(NOT imath_index EQUAL -1)
        list(REMOVE_ITEM module_LIBRARIES Imath::Imath)
        target_link_libraries(prt_${name} PUBLIC Imath::Imath)
    endif()
    target_link_libraries(prt_${name} PRIVATE ${module_LIBRARIES} $<BUILD_INTERFACE:prt_build_flags>)

    set_property(GLOBAL APPEND PROPERTY PRT_MODULES ${name})
endfunction()

# OpenPRT::play is the player, OpenPRT::prt is everything; both are installed for find_package(OpenPRT).
function(prt_collect_modules)
    get_property(modules GLOBAL PROPERTY PRT_MODULES)
    add_library(prt_play INTERFACE)
    add_library(prt_all INTERFACE)
    set_target_properties(prt_play PROPERTIES EXPORT_NAME play)
    set_target_properties(prt_all PROPERTIES EXPORT_NAME prt)
    set(layering "")
    foreach(name IN LISTS modules)
        target_link_libraries(prt_all INTERFACE prt_${name})
        get_target_property(in_player prt_${name} PRT_PLAYER)
        if(in_player)
            target_link_libraries(prt_play INTERFACE prt_${name})
        endif()
        get_target_property(uses prt_${name} PRT_USES)
        list(JOIN uses " " uses)
        string(APPEND layering "${name}: ${uses}\n")
    endforeach()
    add_library(OpenPRT::play ALIAS prt_play)
    add_library(OpenPRT::prt ALIAS prt_all)
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/module_layers.txt" CONTENT "${layering}" @ONLY)

    prt_install_modules()
endfunction()

# Two export sets, so that who embeds the player need not have what only the baker is built on.
function(prt_install_modules)
    get_property(modules GLOBAL PROPERTY PRT_MODULES)
    set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/OpenPRT")
    foreach(name IN LISTS modules)
        get_target_property(in_player prt_${name} PRT_PLAYER)
        if(in_player)
            install(TARGETS prt_${name} EXPORT OpenPRTPlayTargets)
        else()
            install(TARGETS prt_${name} EXPORT OpenPRTBakeTargets)
        endif()
    endforeach()
    install(TARGETS prt_play EXPORT OpenPRTPlayTargets)
    install(TARGETS prt_all EXPORT OpenPRTBakeTargets)
    install(EXPORT OpenPRTPlayTargets NAMESPACE OpenPRT:: DESTINATION "${package_folder}")
    install(EXPORT OpenPRTBakeTargets NAMESPACE OpenPRT:: DESTINATION "${package_folder}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/prt" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE)

    configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/OpenPRTConfig.cmake.in"
        "${PROJECT_BINARY_DIR}/OpenPRTConfig.cmake" INSTALL_DESTINATION "${package_folder}")
    write_basic_package_version_file("${PROJECT_BINARY_DIR}/OpenPRTConfigVersion.cmake" COMPATIBILITY SameMajorVersion)
    install(FILES "${PROJECT_BINARY_DIR}/OpenPRTConfig.cmake" "${PROJECT_BINARY_DIR}/OpenPRTConfigVersion.cmake"
        DESTINATION "${package_folder}")
endfunction()

# Holds every C++ file to .clang-format:   cmake -DROOT=<repository> -P tools/check_formatting.cmake
# Other major versions of clang-format lay code out differently, so only version 14 may judge.
cmake_minimum_required(VERSION 3.25)

find_program(clang_format NAMES clang-format-14 clang-format)
if(NOT clang_format)
    message("skipped: clang-format 14 is not installed")
    return()
endif()
execute_process(COMMAND "${clang_format}" --version OUTPUT_VARIABLE version)
if(NOT version MATCHES "version 14\\.")
    message("skipped: needs clang-format 14, found ${version}")
    return()
endif()

foreach(folder prt apps examples tests benchmarks fuzz)
    list(APPEND patterns "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
endforeach()
file(GLOB_RECURSE sources ${patterns})
execute_process(COMMAND "${clang_format}" --dry-run -Werror ${sources} RESULT_VARIABLE result)
if(result)
    message(FATAL_ERROR "formatting: run clang-format -i on the files above")
endif()

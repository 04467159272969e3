# Holds the numbered conventions, C1, C2, ..., to docs/conventions.md and to their tests:
#   cmake -DROOT=<repository> -P tools/check_conventions.cmake
# Each one cited exists, each one has a test whose name contains its number, TEST(Conventions, C3_...), and the
# test files that the page names exist.
cmake_minimum_required(VERSION 3.25)

set(faults "")

# Read the numbers of the page.
file(STRINGS "${ROOT}/docs/conventions.md" headings REGEX "^#+ C[0-9]+")
foreach(heading IN LISTS headings)
    string(REGEX REPLACE "^#+ (C[0-9]+).*" "\\1" number "${heading}")
    list(APPEND conventions "${number}")
endforeach()

file(READ "${ROOT}/docs/conventions.md" page)
string(REGEX MATCHALL "tests/[a-z_/]+\\.cpp" files "${page}")
foreach(file IN LISTS files)
    if(NOT EXISTS "${ROOT}/${file}")
        list(APPEND faults "docs/conventions.md names ${file}, which does not exist")
    endif()
endforeach()

# Find the numbers that code cites, and those in the names of tests.
foreach(folder prt apps examples tests benchmarks)
    list(APPEND patterns "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
endforeach()
file(GLOB_RECURSE sources RELATIVE "${ROOT}" ${patterns})
foreach(source IN LISTS sources)
    file(READ "${ROOT}/${source}" text)
    string(REGEX MATCHALL "[(, ]C[0-9][0-9]?[),;: ]" found "${text}")
    foreach(number IN LISTS found)
        string(REGEX REPLACE "[^C0-9]" "" number "${number}")
        if(number AND NOT number IN_LIST conventions)
            list(APPEND faults "${source} cites ${number}, which docs/conventions.md lacks")
        endif()
    endforeach()
    string(REGEX MATCHALL "TEST(_F|_P)?\\([^)]*\\)" tests "${text}")
    foreach(test IN LISTS tests)
        string(REGEX MATCHALL "C[0-9]+" named "${test}")
        list(APPEND tested ${named})
    endforeach()
endforeach()

foreach(number IN LISTS conventions)
    if(NOT number IN_LIST tested)
        list(APPEND faults "no test is named after ${number}")
    endif()
endforeach()

list(REMOVE_DUPLICATES faults)
list(JOIN faults "\n  " report)
if(faults)
    message(FATAL_ERROR "conventions:\n  ${report}")
endif()

# Holds prt/ to the module list of the top CMakeLists.txt:
#   cmake -DROOT=<folder that holds prt/> -DLAYERS=<build>/module_layers.txt -P tools/check_layering.cmake
# A module includes itself and what it USES, by path from the root; headers that others may include leave
# out *-inl.h, which is not installed; a source includes its own header first, which shows that the header says all it
# needs; every folder of prt/ is a module. A folder of apps/ includes itself and those that apps/CMakeLists.txt adds
# before it.
cmake_minimum_required(VERSION 3.25)

set(faults "")

# Read what each module may include.
file(STRINGS "${LAYERS}" lines)
foreach(line IN LISTS lines)
    if(NOT line MATCHES "^([a-z_0-9]+):(.*)$")
        message(FATAL_ERROR "${LAYERS}: not a line of the module list: ${line}")
    endif()
    list(APPEND modules "${CMAKE_MATCH_1}")
    separate_arguments(uses_${CMAKE_MATCH_1} UNIX_COMMAND "${CMAKE_MATCH_2}")
endforeach()

# Find folders that the list forgot.
file(GLOB folders RELATIVE "${ROOT}/prt" "${ROOT}/prt/*")
foreach(folder IN LISTS folders)
    if(NOT folder IN_LIST modules)
        list(APPEND faults "prt/${folder} is not in the module list of CMakeLists.txt")
    endif()
endforeach()

# Hold every include against the list.
foreach(module IN LISTS modules)
    file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/prt/${module}/*.h" "${ROOT}/prt/${module}/*.cpp")
    foreach(source IN LISTS sources)
        cmake_path(GET source PARENT_PATH folder)
        file(STRINGS "${ROOT}/${source}" includes REGEX "^[ \t]*#[ \t]*include")
        string(REGEX REPLACE "\\.cpp$" ".h" own_header "${source}")
        if(source MATCHES "\\.cpp$" AND EXISTS "${ROOT}/${own_header}"
           AND NOT includes MATCHES "^#include \"${own_header}\"(;|$)")
            list(APPEND faults "${source} does not include ${own_header} first")
        endif()
        foreach(include IN LISTS includes)
            if(NOT include MATCHES "include[ \t]*[\"<]([^\">]+)[\">]")
                continue()
            endif()
            set(path "${CMAKE_MATCH_1}")
            if(path MATCHES "^prt/([^/]+)/")
                set(used "${CMAKE_MATCH_1}")
                if(NOT used STREQUAL module AND NOT used IN_LIST uses_${module})
                    list(APPEND faults "${source} includes ${path}, but ${module} does not use ${used}")
                endif()
                if(path MATCHES "-inl\\.h$" AND source MATCHES "\\.h$" AND NOT source MATCHES "-inl\\.h$")
                    list(APPEND faults "${source} includes ${path}, which is not installed")
                endif()
            elseif(include MATCHES "\"" AND EXISTS "${ROOT}/${folder}/${path}")
                list(APPEND faults "${source} includes ${path}, not by its path from the root, prt/...")
            endif()
        endforeach()
    endforeach()
endforeach()

# And those of apps/ against the sequence in which they are added.
set(additions "")
if(EXISTS "${ROOT}/apps/CMakeLists.txt")
    file(STRINGS "${ROOT}/apps/CMakeLists.txt" additions REGEX "^add_subdirectory")
endif()
set(above "")
foreach(addition IN LISTS additions)
    string(REGEX REPLACE "^add_subdirectory\\((.*)\\)$" "\\1" folder "${addition}")
    list(APPEND above "${folder}")
    file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/apps/${folder}/*.h" "${ROOT}/apps/${folder}/*.cpp")
    foreach(source IN LISTS sources)
        file(STRINGS "${ROOT}/${source}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*\"apps/")
        foreach(include IN LISTS includes)
            string(REGEX REPLACE ".*\"apps/([^/]+)/.*" "\\1" used "${include}")
            if(NOT used IN_LIST above)
                list(APPEND faults "${source} includes apps/${used}, which stands below it")
            endif()
        endforeach()
    endforeach()
endforeach()

list(JOIN faults "\n  " report)
if(faults)
    message(FATAL_ERROR "layering:\n  ${report}")
endif()

# Puts the page of `prt web` into a target, so that the program needs no files: apps/prt/page_template.h declares it.
# Node makes the page of web/page and web/loader; where it is missing the template is empty.
function(prt_embed_page target)
    set(web "${PROJECT_SOURCE_DIR}/web")
    set(page "${PROJECT_BINARY_DIR}/web/index.html")
    set(source "${PROJECT_BINARY_DIR}/embedded/page_template.cpp")
    find_program(PRT_NPM npm)
    if(PRT_NPM AND EXISTS "${web}/node_modules")
        file(GLOB_RECURSE parts CONFIGURE_DEPENDS "${web}/page/src/*" "${web}/loader/src/*.ts")
        add_custom_command(OUTPUT "${page}"
            COMMAND "${PRT_NPM}" run --silent build -- --logLevel warn --emptyOutDir --outDir "${PROJECT_BINARY_DIR}/web"
            WORKING_DIRECTORY "${web}/page"
            DEPENDS ${parts} "${web}/page/index.html" "${web}/page/vite.config.ts" "${web}/package-lock.json"
            COMMENT "Bundling the page of prt web" VERBATIM)
    else()
        message(NOTICE "prt web will have no page: install Node.js (nodejs, npm) and run npm ci --prefix web")
        set(page "")
    endif()
    add_custom_command(OUTPUT "${source}"
        COMMAND ${CMAKE_COMMAND} "-DPAGE=${page}" "-DSOURCE=${source}" -P "${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake"
        DEPENDS ${page} "${PROJECT_SOURCE_DIR}/cmake/embed_page.cmake" VERBATIM)
    target_sources(${target} PRIVATE "${source}")
endfunction()

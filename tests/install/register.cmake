# Installs this build into a scratch prefix, and builds and runs the outside project of this folder against it.
set(scratch "${CMAKE_CURRENT_BINARY_DIR}/install")
set(baker_packages embree TBB OpenEXR tinyobjloader PkgConfig)
list(TRANSFORM baker_packages REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON" OUTPUT_VARIABLE without_baker_packages)

# add_outside_test(<name> <component> [<configure option>...]): build with one component, run on the scratch asset.
function(add_outside_test name component)
    add_test(NAME ${name} COMMAND ${CMAKE_CTEST_COMMAND}
        --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/install" "${scratch}/${name}"
        --build-generator ${CMAKE_GENERATOR} --build-target outside
        --build-options "-DCMAKE_PREFIX_PATH=${scratch}/prefix" -DCOMPONENT=${component} ${ARGN}
        --test-command outside "${scratch}/outside.prt.glb")
endfunction()

add_test(NAME install COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${scratch}/prefix")
add_outside_test(outside_bake prt)
add_outside_test(outside_play play ${without_baker_packages})
add_test(NAME player_links_no_baker COMMAND ldd "${scratch}/outside_play/outside")

set_tests_properties(install PROPERTIES FIXTURES_SETUP prefix COST 30)
set_tests_properties(outside_bake PROPERTIES FIXTURES_REQUIRED prefix FIXTURES_SETUP asset)
set_tests_properties(outside_play PROPERTIES FIXTURES_REQUIRED "prefix;asset" FIXTURES_SETUP player)
set_tests_properties(player_links_no_baker PROPERTIES FIXTURES_REQUIRED player
    PASS_REGULAR_EXPRESSION "libstdc" FAIL_REGULAR_EXPRESSION "embree|libtbb|assimp|OpenEXR|libGL")
set_tests_properties(install outside_bake outside_play player_links_no_baker PROPERTIES LABELS install)

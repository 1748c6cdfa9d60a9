# Precompiled headers for each program below this folder that links to GoogleTest's main(), if it is
# compiled as most are.
set(flags -O0 -g0)
add_library(skybake_test_headers OBJECT precompiled_headers.cpp)
target_link_libraries(skybake_test_headers PRIVATE skybake_options rapidcheck GTest::gtest)
target_compile_options(skybake_test_headers PRIVATE ${flags})
target_precompile_headers(skybake_test_headers PRIVATE
    <gtest/gtest.h> <rapidcheck.h> <rapidcheck/gtest.h>
    <algorithm> <array> <atomic> <chrono> <cmath> <filesystem> <fstream> <functional> <limits> <map>
    <numbers> <optional> <random> <set> <sstream> <string> <thread> <variant> <vector>)

get_property(folders DIRECTORY PROPERTY SUBDIRECTORIES)
foreach(folder IN LISTS folders)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_target_property(libraries ${target} LINK_LIBRARIES)
        get_target_property(options ${target} COMPILE_OPTIONS)
        if("GTest::gtest_main" IN_LIST libraries AND "${options}" STREQUAL "${flags}")
            target_precompile_headers(${target} REUSE_FROM skybake_test_headers)
        endif()
    endforeach()
endforeach()

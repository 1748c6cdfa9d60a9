# For builds from nothing. The headers of GoogleTest, RapidCheck and the standard library cost a test
# more than it does itself: one compilation of them serves all programs below this folder that link to
# GoogleTest's main() and are compiled as most are, and their sources are compiled several at once.
set(flags -O0 -g0)
add_library(skybake_test_headers OBJECT precompiled_headers.cpp)
target_link_libraries(skybake_test_headers PRIVATE skybake_options rapidcheck GTest::gtest)
target_compile_options(skybake_test_headers PRIVATE ${flags})
target_precompile_headers(skybake_test_headers PRIVATE
    <gtest/gtest.h> <rapidcheck.h> <rapidcheck/gtest.h>
    <algorithm> <array> <atomic> <chrono> <cmath> <filesystem> <fstream> <functional> <limits> <map>
    <numbers> <optional> <random> <set> <sstream> <string> <thread> <variant> <vector>)

# Gives the sources of a program the batches that batches.py divides them into.
function(skybake_compile_tests_in_batches target)
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources EXCLUDE REGEX support/)  # those are compiled with optimisation
    list(TRANSFORM sources PREPEND ${folder}/)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
    execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/batches.py ${sources}
        OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[^\n]+" lines "${lines}")
    foreach(line IN LISTS lines)
        string(REPLACE " " ";" line ${line})
        list(GET line 0 batch)
        list(GET line 1 source)
        set_source_files_properties(${source} DIRECTORY ${folder} PROPERTIES UNITY_GROUP ${batch})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

get_property(folders DIRECTORY PROPERTY SUBDIRECTORIES)
foreach(folder IN LISTS folders)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_target_property(libraries ${target} LINK_LIBRARIES)
        get_target_property(options ${target} COMPILE_OPTIONS)
        if("GTest::gtest_main" IN_LIST libraries AND "${options}" STREQUAL "${flags}")
            target_precompile_headers(${target} REUSE_FROM skybake_test_headers)
            skybake_compile_tests_in_batches(${target})
        endif()
    endforeach()
endforeach()

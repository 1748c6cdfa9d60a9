# find_package(skybake): the program, as skybake::skybake, and skybake_add_assets().
cmake_minimum_required(VERSION 3.21)  # DEPFILE under every generator
include(${CMAKE_CURRENT_LIST_DIR}/skybakeTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/skybake_add_assets.cmake)

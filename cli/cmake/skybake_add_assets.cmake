# Bakes a recipe as a part of a build.
#
#   skybake_add_assets(<target>
#       RECIPE <file>             # relative to the current source folder
#       OUTPUTS <file>...         # the files of the recipe that the build should know of
#       [FOLDER <folder>]         # output folder, relative to the current binary folder; default <target>
#       [SET <key=value>...]      # as `skybake bake --set`
#       [ONLY <name>...]          # as --only
#       [CERTIFY quick|full|off]  # as --certify
#       [CACHE_DIR <folder>])     # as --cache-dir
#
# Makes the custom target <target>, which is built by default, and sets the variable
# <target>_FOLDER. A rule that reads a file depends on both, so that all generators keep the order:
#
#   add_custom_command(OUTPUT ... DEPENDS sky ${sky_FOLDER}/transmittance.exr ...)
#
# skybake runs again when the recipe, one of its includes or images, or the program has changed, or
# when an output is missing. It bakes what is out of date, and leaves every other file and its time
# stamp alone, so that nothing made from those is made again. A folder holds one recipe's files.

cmake_policy(PUSH)
# The code below must mean the same whatever policies the caller has.
cmake_policy(VERSION 3.21)

# Two recipes in one folder would treat each other's files as foreign.
function(_skybake_claim_folder folder target)
    get_property(owner GLOBAL PROPERTY "skybake owner of ${folder}")
    if(owner)
        message(FATAL_ERROR "skybake_add_assets(${target}): ${owner} bakes into ${folder} already; "
            "choose another folder with FOLDER")
    endif()
    set_property(GLOBAL PROPERTY "skybake owner of ${folder}" ${target})
endfunction()

# The words of `skybake bake` for the caller's arg_SET and so on.
function(_skybake_options result)
    set(options --quiet)
    foreach(value IN LISTS arg_SET)
        list(APPEND options --set ${value})
    endforeach()
    foreach(name IN LISTS arg_ONLY)
        list(APPEND options --only ${name})
    endforeach()
    if(arg_CERTIFY)
        list(APPEND options --certify ${arg_CERTIFY})
    endif()
    if(arg_CACHE_DIR)
        cmake_path(ABSOLUTE_PATH arg_CACHE_DIR NORMALIZE
            BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
        list(APPEND options --cache-dir ${arg_CACHE_DIR})
    endif()
    set(${result} ${options} PARENT_SCOPE)
endfunction()

# The rule that bakes. Its output is an empty file, since the assets' own time stamps do not tell
# when skybake ran last.
function(_skybake_add_rule target recipe folder outputs options)
    set(files ${outputs})
    list(TRANSFORM files PREPEND ${folder}/)
    if(CMAKE_GENERATOR MATCHES Ninja)
        # Ninja runs a rule of which an output is missing, and looks at the time stamp of each
        # ("restat") before it goes on to what depends on it.
        set(byproducts BYPRODUCTS ${files} ${folder}/manifest.json)
    else()
        # Make knows nothing of by-products. A missing file makes the stamp out of date by a rule
        # of its own, which does nothing and has no prerequisites: Make assumes that the target of
        # such a rule is new.
        foreach(file IN LISTS files)
            add_custom_command(OUTPUT ${file} COMMAND ${CMAKE_COMMAND} -E true COMMENT "")
        endforeach()
        set(required_files ${files})
    endif()

    set(state ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/skybake/${target})
    # Make does not see that a command has changed, only that a file has.
    file(GENERATE OUTPUT ${state}.options CONTENT "${folder};${options}\n")
    add_custom_command(
        OUTPUT ${state}.stamp
        ${byproducts}
        COMMAND skybake::skybake bake ${recipe} -o ${folder} ${options}
                --depfile ${state}.rules > ${state}.files
        COMMAND ${CMAKE_COMMAND} -D "WHO=skybake_add_assets(${target})" -D "OUTPUTS=${files}"
                -D FILES=${state}.files -D RULES=${state}.rules -D STAMP=${state}.stamp
                -D DEPFILE=${state}.d -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/skybake_finish_bake.cmake
        DEPENDS ${recipe} ${state}.options $<TARGET_FILE:skybake::skybake> ${required_files}
        DEPFILE ${state}.d
        COMMENT "Baking ${target}"
        VERBATIM)
    add_custom_target(${target} ALL DEPENDS ${state}.stamp)
endfunction()

function(skybake_add_assets target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "RECIPE;FOLDER;CERTIFY;CACHE_DIR" "OUTPUTS;SET;ONLY")
    if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
        message(FATAL_ERROR "skybake_add_assets(${target}): unknown or incomplete arguments: "
            "${arg_UNPARSED_ARGUMENTS} ${arg_KEYWORDS_MISSING_VALUES}")
    endif()
    if(NOT arg_RECIPE OR NOT arg_OUTPUTS)
        message(FATAL_ERROR "skybake_add_assets(${target}) needs RECIPE and OUTPUTS")
    endif()
    if(NOT arg_FOLDER)
        set(arg_FOLDER ${target})
    endif()
    cmake_path(ABSOLUTE_PATH arg_RECIPE NORMALIZE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(ABSOLUTE_PATH arg_FOLDER NORMALIZE BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
    string(REGEX REPLACE "/$" "" arg_FOLDER ${arg_FOLDER})
    _skybake_claim_folder(${arg_FOLDER} ${target})
    _skybake_options(options)
    _skybake_add_rule(${target} ${arg_RECIPE} ${arg_FOLDER} "${arg_OUTPUTS}" "${options}")
    set(${target}_FOLDER ${arg_FOLDER} PARENT_SCOPE)
endfunction()

cmake_policy(POP)

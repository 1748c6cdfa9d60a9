# Bakes a recipe and prints the lookup of every file of it: FOLDER/glsl has each as GLSL, and HEADER
# all as C++, each in a namespace that is named as its file.
#   cmake -DSKYBAKE=skybake -DRECIPE=printed.toml -DFOLDER=printed -DHEADER=printed/lookups.h
#         -P print_lookups.cmake
set(text "// Made of what `skybake info --lookup` prints.\n")

# Runs the program and fails as it does.
function(skybake result)
    execute_process(COMMAND ${SKYBAKE} ${ARGN}
        OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "skybake ${ARGN}\n${error}")
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

# Prints the files of a bake; their namespaces begin with PREFIX.
function(print_lookups baked prefix)
    file(GLOB files ${baked}/*.*)
    foreach(file IN LISTS files)
        get_filename_component(name ${file} NAME)
        if(name MATCHES "json$")
            continue()
        endif()
        string(MAKE_C_IDENTIFIER ${prefix}${name} name)
        skybake(lookup info --lookup ${file})
        file(WRITE ${FOLDER}/glsl/${name}.glsl "${lookup}")
        execute_process(COMMAND ${CMAKE_COMMAND} -DFROM=${FOLDER}/glsl/${name}.glsl
            -DTO=${FOLDER}/as_cpp.h -P ${CMAKE_CURRENT_LIST_DIR}/glsl_to_cpp.cmake
            COMMAND_ERROR_IS_FATAL ANY)
        file(READ ${FOLDER}/as_cpp.h as_cpp)
        string(APPEND text "namespace ${name} {\n${as_cpp}}\n")
    endforeach()
    set(text "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER}/glsl)
skybake(said bake ${RECIPE} -o ${FOLDER}/colours --certify=off --prune)
print_lookups(${FOLDER}/colours "")
# Files of one wavelength have other channels.
skybake(said bake ${RECIPE} -o ${FOLDER}/one_colour --certify=off --prune
    --set "wavelengths=[\"550 nm\"]" --set "bake.air.content=\"in_scatter\""
    --set "atmosphere.layers.rayleigh.scattering=\"1.36e-5 /m\""
    --set "atmosphere.layers.ozone.absorption=\"1.88e-6 /m\""
    --only transmittance --only air --only sky)
print_lookups(${FOLDER}/one_colour "one_colour_")
file(WRITE ${HEADER} "${text}")

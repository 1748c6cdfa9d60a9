# Bakes a recipe and prints the lookup of every file of it in every language: FOLDER/glsl has each as
# GLSL, FOLDER/hlsl as HLSL and so on. lookups.h has all of GLSL as C++, each in a namespace that is
# named as its file, and lookups_msl.h those of Metal's language. Headers are written only where
# something else was printed.
#   cmake -DSKYBAKE=skybake -DRECIPE=lookups.toml -DFOLDER=printed -P print_lookups.cmake
set(languages glsl hlsl msl wgsl godot)
foreach(language IN LISTS languages)
    set(text_${language} "// Made of what `skybake info --lookup` prints.\n")
endforeach()

# Runs the program and fails as it does.
function(skybake result)
    execute_process(COMMAND ${SKYBAKE} ${ARGN}
        OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "skybake ${ARGN}\n${error}")
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

# Prints the files of a bake, and the library of its folder, which is named as that; their namespaces begin with PREFIX.
function(print_lookups baked prefix)
    file(GLOB files ${baked}/*.*)
    foreach(file IN LISTS files ITEMS ${baked})  # the folder's own is the library of all
        get_filename_component(name ${file} NAME)
        if(name MATCHES "json$")
            continue()
        endif()
        string(MAKE_C_IDENTIFIER ${prefix}${name} name)
        foreach(language IN LISTS languages)
            skybake(lookup info --lookup --language ${language} ${file})
            set(printed ${FOLDER}/${language}/${name}.${language})
            file(WRITE ${printed} "${lookup}")
            if(language MATCHES "^(glsl|msl)$")
                set(FROM ${printed})
                set(TO ${FOLDER}/as_cpp.h)
                include(${CMAKE_CURRENT_LIST_DIR}/glsl_to_cpp.cmake)
                file(READ ${FOLDER}/as_cpp.h as_cpp)
                string(APPEND text_${language} "namespace ${name} {\n${as_cpp}}\n")
            endif()
        endforeach()
    endforeach()
    set(text_glsl "${text_glsl}" PARENT_SCOPE)
    set(text_msl "${text_msl}" PARENT_SCOPE)
endfunction()

foreach(language IN LISTS languages)
    file(REMOVE_RECURSE ${FOLDER}/${language})
endforeach()
skybake(said bake ${RECIPE} -o ${FOLDER}/colours --certify=off --prune)
print_lookups(${FOLDER}/colours "")
# Files of one wavelength have other channels.
skybake(said bake ${RECIPE} -o ${FOLDER}/one_colour --certify=off --prune
    --set "wavelengths=[\"550 nm\"]" --set "bake.air.content=\"in_scatter\""
    --set "bake.air_from_space.content=\"in_scatter\""
    --set "atmosphere.layers.rayleigh.scattering=\"1.36e-5 /m\""
    --set "atmosphere.layers.ozone.absorption=\"1.88e-6 /m\""
    --only transmittance --only air --only sky)
print_lookups(${FOLDER}/one_colour "one_colour_")
# A folder may lack assets of its recipe, such as the grid by which marches through a cloud leap.
skybake(said bake ${RECIPE} -o ${FOLDER}/few --certify=off --prune
    --only transmittance --only hillaire --only cloud)
print_lookups(${FOLDER}/few "few_")
skybake(said bake ${CMAKE_CURRENT_LIST_DIR}/printed_wavelengths.toml -o ${FOLDER}/four_wavelengths
    --certify=off --prune)
print_lookups(${FOLDER}/four_wavelengths "four_wavelengths_")
skybake(said bake ${CMAKE_CURRENT_LIST_DIR}/printed_packets.toml -o ${FOLDER}/packets
    --certify=off --prune)
print_lookups(${FOLDER}/packets "packets_")
file(CONFIGURE OUTPUT ${FOLDER}/lookups.h CONTENT "${text_glsl}" @ONLY)
file(CONFIGURE OUTPUT ${FOLDER}/lookups_msl.h CONTENT "${text_msl}" @ONLY)

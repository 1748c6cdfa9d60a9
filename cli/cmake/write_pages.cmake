# Writes the man pages and shell completions that the program makes of its tables of commands, and
# the JSON Schema of manifests.
#   cmake -DSKYBAKE=PROGRAM -DFOLDER=WHERE -P write_pages.cmake
function(write_page file)
    execute_process(COMMAND ${SKYBAKE} ${ARGN} OUTPUT_FILE "${FOLDER}/${file}"
        RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${SKYBAKE} ${ARGN} fails")
    endif()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/man1")
write_page(man1/skybake.1 help --man)
# The page of the program lists those of its commands.
file(READ "${FOLDER}/man1/skybake.1" overview)
string(REGEX MATCHALL "skybake\\\\-[a-z]+" pages "${overview}")
list(REMOVE_DUPLICATES pages)
foreach(page IN LISTS pages)
    string(REGEX REPLACE ".*-" "" command "${page}")
    write_page(man1/skybake-${command}.1 help ${command} --man)
endforeach()
write_page(skybake help --completion bash)
write_page(_skybake help --completion zsh)
write_page(skybake.fish help --completion fish)
write_page(manifest_schema.json schema manifest)

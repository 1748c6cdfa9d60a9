# After a bake of skybake_add_assets: are the outputs made, and what does the stamp depend on?
#
#   WHO      skybake_add_assets(<target>)
#   OUTPUTS  paths that the build knows of
#   FILES    what skybake printed: a path a line
#   RULES    the dependency file that skybake wrote, a rule for every file of the recipe
#   STAMP    the one output of which the build shall have a rule
#   DEPFILE  where to write that rule
cmake_minimum_required(VERSION 3.21)

file(STRINGS ${FILES} made ENCODING UTF-8)
foreach(output IN LISTS OUTPUTS)
    if(NOT output IN_LIST made)
        list(JOIN made "\n  " paths)
        message(FATAL_ERROR "${WHO}: OUTPUTS names a file that the recipe does not bake:\n"
            "  ${output}\nIt bakes:\n  ${paths}")
    endif()
endforeach()

# Ninja takes a dependency file only if it names the first output of its rule first, and others not
# at all; Make looks for the stamp.
string(REGEX REPLACE "([\\ #])" "\\\\\\1" target "${STAMP}")
string(REPLACE "$" "$$" target "${target}")
file(READ ${RULES} rules)
string(FIND "${rules}" ": \\\n" end_of_targets)
string(SUBSTRING "${rules}" ${end_of_targets} -1 prerequisites)
# CMake reads these files, too, and knows no escaped colon.
string(REPLACE "\\:" ":" prerequisites "${prerequisites}")
file(WRITE ${DEPFILE} "${target}${prerequisites}")
file(TOUCH ${STAMP})

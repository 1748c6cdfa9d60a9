# Writes the C++ source that holds the preset texts.
#   cmake -DOUTPUT=presets_data.cpp -DPRESETS=a.toml;b.toml -P embed_presets.cmake
# Called by the build whenever a preset changes.
set(entries "")
set(count 0)
list(SORT PRESETS)
foreach(path IN LISTS PRESETS)
    get_filename_component(name "${path}" NAME_WE)
    # FILE(READ) would take semicolons and brackets for list syntax only if the text were split; it
    # is not. The delimiter of the raw string is one that no recipe contains.
    file(READ "${path}" text)
    string(APPEND entries "    Preset{\"${name}\", R\"preset(${text})preset\"},\n")
    math(EXPR count "${count} + 1")
endforeach()
file(WRITE "${OUTPUT}.new" "// Made from config/presets/*.toml by embed_presets.cmake.
#include <array>

#include \"config/presets.h\"

namespace skybake::config {
namespace {

constexpr std::array<Preset, ${count}> all = {
${entries}};

}  // namespace

std::span<const Preset> presets() {
    return all;
}

}  // namespace skybake::config
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")

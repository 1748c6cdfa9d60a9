# Writes the C++ source that holds the texts of the presets and of the diagnostic codes.
#   cmake -DOUTPUT=presets_data.cpp -DPRESETS=a.toml;b.toml -DNOISE_PRESETS=c.toml
#         -DCLOUD_PRESETS=d.toml -DPARTICLE_PRESETS=e.toml -DLAYER_PRESETS=f.toml
#         -DCODES=codes.toml -P embed_presets.cmake
# Called by the build whenever one of them changes.

# The presets of a list of files as the function NAME that returns them.
function(append_presets name)
    set(entries "")
    set(count 0)
    list(SORT ARGN)
    foreach(path IN LISTS ARGN)
        get_filename_component(stem "${path}" NAME_WE)
        # FILE(READ) would take semicolons and brackets for list syntax only if the text were split;
        # it is not. The delimiter of the raw string is one that no recipe contains.
        file(READ "${path}" text)
        string(APPEND entries "    Preset{\"${stem}\", R\"preset(${text})preset\"},\n")
        math(EXPR count "${count} + 1")
    endforeach()
    file(APPEND "${OUTPUT}.new" "
std::span<const Preset> ${name}() {
    static constexpr std::array<Preset, ${count}> all = {
${entries}};
    return all;
}
")
endfunction()

file(WRITE "${OUTPUT}.new" "// Made from config/presets/**/*.toml and codes.toml by embed_presets.cmake.
#include <array>

#include \"config/diagnostics/diagnostic_codes.h\"
#include \"config/presets/presets.h\"

namespace skybake::config {
")
append_presets(presets ${PRESETS})
append_presets(noise_presets ${NOISE_PRESETS})
append_presets(cloud_presets ${CLOUD_PRESETS})
append_presets(particle_presets ${PARTICLE_PRESETS})
append_presets(layer_presets ${LAYER_PRESETS})
file(READ "${CODES}" codes)
file(APPEND "${OUTPUT}.new" "
std::string_view diagnostic_codes_toml() {
    return R\"codes(${codes})codes\";
}

}  // namespace skybake::config
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")

#!/usr/bin/env bash
# Which room may use which, and which library is included behind which wall. Rooms are the folders of
# config/ and of bakers/. A room may use itself and the rooms of its line, and those of bakers/ all of
# config/ besides.
set -euo pipefail
cd "$1"
failures=0

# complain LINES...: what stands there is not allowed
complain() {
    echo "not allowed here:"
    echo "$1"
    failures=$((failures + 1))
}

# forbid WHAT WHERE EXCEPT: no include matching WHAT under WHERE, but in files matching EXCEPT
forbid() {
    local found
    found=$(grep -rnE "#include [<\"]$1" --include='*.h' --include='*.cpp' $2 | grep -vE "^($3):" || true)
    [[ -z "$found" ]] || complain "$found"
}

# --- Rooms ------------------------------------------------------------------------------------------

rooms=()

# room NAME MAY_USE...: every include of another room that is not in the list is an arrow too many
room() {
    local house=${1%%/*} allowed found
    rooms+=("$1")
    allowed=$(IFS='|'; echo "${*#"$house"/}")
    found=$(grep -rnE "#include \"$house/" --include='*.h' --include='*.cpp' "$1" |
        grep -vE "#include \"$house/($allowed)/" || true)
    [[ -z "$found" ]] || complain "$found"
}

room config/text
room config/optics text
room config/presets
room config/diagnostics text
room config/fields presets text diagnostics
room config/sections text optics diagnostics fields
room config/assets text optics diagnostics fields sections
room config/sweep text diagnostics fields
room config/recipe presets text optics diagnostics fields sections assets sweep

room bakers/math
room bakers/color math
room bakers/field math
room bakers/io math field
room bakers/air math
room bakers/light math color field air
room bakers/noise math field
room bakers/clouds math field noise
room bakers/occupancy math field
room bakers/march math field air occupancy
room bakers/assets math color field io air light noise clouds occupancy march
room bakers/shading
room bakers/workspace math field io assets
room bakers/plot field io
room bakers/render math color field io air light occupancy march plot
room bakers/report math color field io air light noise clouds occupancy march assets plot render
room bakers/preview math color field io air light occupancy march assets workspace plot render report

# Each room has its line, and nothing lies beside the rooms.
for path in config/* bakers/*; do
    name=${path#*/}
    [[ $name == CMakeLists.txt || $name == *.md || $name == *.cmake ||
        " ${rooms[*]} " == *" $path "* ]] || complain "$path is no room that this test knows"
    [[ ! -d $path || -s $path/README.md ]] || complain "$path has no README.md"
done

none='^$'
forbid '(bakers|cli)/' config "$none"
forbid 'cli/' 'config bakers' "$none"

# --- Libraries --------------------------------------------------------------------------------------

formats='bakers/io/formats'
forbid 'toml\+\+' 'config bakers cli' 'config/diagnostics/toml_source\.cpp'
forbid 'CLI/' 'config bakers cli' 'cli/parse_arguments\.cpp'
forbid '(OpenEXR|Imf)' 'config bakers cli' "$formats/exr/exr(_[a-z]+)?\.cpp|$formats/exr/exr_(library|stream)\.h"
forbid "$formats/exr/exr_library\.h" 'config bakers cli' "$formats/exr/exr(_[a-z]+)?\.cpp"
forbid 'libdeflate' 'config bakers cli' "$formats/exr/exr_chunks\.cpp|$formats/nvdb/nvdb_checksum\.cpp|bakers/preview/live/zlib_bytes\.cpp"
forbid 'zstd\.h' 'config bakers cli' "$formats/ktx2/zstd_stream\.cpp"
forbid 'nanovdb/' 'config bakers cli' "$formats/nvdb/nvdb_layout\.h"
forbid 'openvdb/' 'config bakers cli' "$formats/vdb/vdb_(decoder|encoder|grid_tree|grid_voxels|input)\.cpp|$formats/vdb/vdb_(library|input)\.h"
forbid 'OpenImageIO/' 'config bakers cli' "$formats/png/(map_reader|image_codec)\.cpp"
forbid '(cairo|pango|fontconfig|ft2build)' 'config bakers cli' 'bakers/plot/cairo_drawing\.cpp'
forbid 'curl/' 'config bakers cli' 'bakers/io/files/http_curl\.cpp'
forbid 'Imath' 'config bakers cli' "$formats/exr/exr(_[a-z]+)?\.cpp"
forbid '(oneapi/)?tbb' 'config bakers cli' 'bakers/math/parallel_tbb\.cpp'
forbid 'xxh' 'config bakers cli' 'bakers/math/hash\.cpp'
forbid '(thread|mutex|OpenEXR)' config "$none"
# The console, and the reading and writing of files, are not a baker's business.
makers='bakers/math bakers/color bakers/field bakers/air bakers/light bakers/noise bakers/clouds bakers/occupancy bakers/march bakers/assets'
forbid '(iostream|fstream)' "$makers" "$none"
forbid 'bakers/io/' bakers/assets \
    'bakers/assets/([a-z_]+_check\.(h|cpp)|occupancy/occupancy_check\.(h|cpp)|cloud_distance/distance_folder_check\.(h|cpp)|source_files\.(h|cpp)|cloud_volume/cloud_(files|inputs)\.cpp)'

# --- The C library's functions ----------------------------------------------------------------------

# Its exponentials, sines and lengths have other last bits on other processors and in other versions.
# Code of baked values, and of facts in manifests, takes config/optics/elementary.h and
# bakers/math/transcendental.h in place of them. The first exception only refuses towers that are too
# narrow for their voxels; the second times a published method whose table nobody keeps.
functions='exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|erf|erfc|[tl]gamma|a?(sin|cos|tan)h?|atan2|sincos'
called=$(grep -rlE "\b($functions)[fl]?\(" --include='*.h' --include='*.cpp' config $makers bakers/io |
    grep -vE '^(config/sections/towers|bakers/assets/transmittance/transmittance_table)\.cpp$' |
    while IFS= read -r source; do
        # Drops comments, strings and lines of GLSL.
        sed -E 's@//.*@@; s/"([^"\\]|\\.)*"//g' "$source" |
            grep -nE "(^|[^A-Za-z_.>])((std|glm)?::)?($functions)[fl]?\(" | sed "s@^@$source:@"
    done || true)
[[ -z "$called" ]] || complain "$called"

# Sources are compiled in batches, where a namespace that one source opens is open in those after it.
opened=$(grep -rnE '^using namespace ' --include='*.h' --include='*.cpp' config bakers cli |
    grep -v 'std::string_view_literals;' || true)
[[ -z "$opened" ]] || complain "$opened"

exit "$failures"

#!/usr/bin/env bash
# Which room may use which, and which library is included behind which wall. Rooms are the folders of
# config/ and of bakers/. A room may use itself and the rooms of its line, and those of bakers/ all of
# config/ besides.
#   arrows.sh SOURCE            fails where an include or the sentence of a README says otherwise
#   arrows.sh SOURCE --write    writes those sentences
set -euo pipefail
cd "$1"
mode=${2:-}
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
arrows=()  # "room used"

# Says in its README which rooms a room may use, or fails where another sentence stands there.
say_in_readme() {
    local page=$1/README.md sentence found
    sentence=$(printf ', %s' "${@:2}")
    [[ $# -gt 1 ]] || sentence=', no other room'
    [[ $# -le 2 ]] || sentence="${sentence%, *} and ${sentence##*, }"
    sentence="It may use ${sentence#, }"
    sentence+=" (\`tests/architecture/arrows.sh\`)."
    if [[ $mode == --write ]]; then
        sentence=$sentence perl -0pi -e 's/^It may use .*?(?=\n\n|\n*\z)/$ENV{sentence}/ms' "$page"
    fi
    found=$(grep -m 1 '^It may use ' "$page" || true)
    [[ "$found" == "$sentence" ]] || complain "$page says: $found"
}

# room NAME MAY_USE...: every include of another room that is not in the list is an arrow too many
room() {
    local house=${1%%/*} allowed found
    rooms+=("$1")
    allowed=$(IFS='|'; echo "${*#"$house"/}")
    found=$(grep -rnE "#include \"$house/" --include='*.h' --include='*.cpp' "$1" |
        grep -vE "#include \"$house/($allowed)/" || true)
    [[ -z "$found" ]] || complain "$found"
    say_in_readme "$@"
    [[ $house == config ]] || arrows+=("${@/#/${1#*/} }")
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
room bakers/convection math
room bakers/clouds math field noise convection
room bakers/occupancy math field
room bakers/march math field air occupancy
room bakers/assets math color field io air light noise convection clouds occupancy march
room bakers/shading
room bakers/workspace math field io assets
room bakers/plot field io
room bakers/render math color field io air light occupancy march plot
room bakers/report math field io assets plot
room bakers/plan math field io air light occupancy march assets workspace plot render report
room bakers/preview math color field io air light occupancy march assets workspace plot render report

# The drawing of bakers/FLOW.md leaves out arrows that follow from others: rooms are listed after all that
# they use, so an arrow follows if another room that is used reaches its end.
drawing=$(printf '%s\n' "${arrows[@]}" | awk '
    $1 == $2 || $2 ~ /\// { next }
    { used[$1] = used[$1] " " $2; if (!($1 in seen)) { seen[$1] = 1; order[++rooms] = $1 } }
    END {
        print "graph BT"
        for (i = 1; i <= rooms; ++i) {
            room = order[i]; count = split(used[room], ends, " ")
            for (j = 1; j <= count; ++j) {
                follows = 0
                for (k = 1; k <= count; ++k) follows = follows || ((ends[k], ends[j]) in reaches)
                if (!follows) print "    " room " --> " ends[j]
                reaches[room, ends[j]] = 1
            }
        }
    }')
if [[ $mode == --write ]]; then
    drawing=$drawing perl -0pi -e 's/(```mermaid\n).*?(```)/$1$ENV{drawing}\n$2/s' bakers/FLOW.md
fi
[[ "$(sed -n '/^```mermaid$/,/^```$/p' bakers/FLOW.md | sed '1d;$d')" == "$drawing" ]] ||
    complain "bakers/FLOW.md draws other arrows than this file has"

# Each room has its line, and nothing lies beside the rooms.
for path in config/* bakers/*; do
    name=${path#*/}
    [[ $name == CMakeLists.txt || $name == *.md || $name == *.cmake ||
        " ${rooms[*]} " == *" $path "* ]] || complain "$path is no room that this test knows"
    [[ ! -d $path || -s $path/README.md ]] || complain "$path has no README.md"
done

# What assets share stands in folders of its own, below those of the assets.
# shared NAME MAY_USE...
shared() {
    local allowed found
    allowed=$(IFS='|'; echo "$*")
    found=$(grep -rn '#include "bakers/assets/' "bakers/assets/$1" |
        grep -vE "#include \"bakers/assets/($allowed)/" || true)
    [[ -z "$found" ]] || complain "$found"
}

shared description
shared sky description
shared registry description sky
shared sources registry cloud_volume
loose=$(find bakers/assets -maxdepth 1 -type f ! -name README.md)
[[ -z "$loose" ]] || complain "$loose"

none='^$'
forbid '(bakers|cli)/' config "$none"
forbid 'cli/' 'config bakers' "$none"

# --- Libraries --------------------------------------------------------------------------------------

formats='bakers/io/formats'
forbid 'toml\+\+' 'config bakers cli' 'config/diagnostics/toml_source\.cpp'
forbid '(OpenEXR|Imf)' 'config bakers cli' "$formats/exr/exr(_[a-z]+)?\.cpp|$formats/exr/exr_(library|stream)\.h"
forbid "$formats/exr/exr_library\.h" 'config bakers cli' "$formats/exr/exr(_[a-z]+)?\.cpp"
forbid 'libdeflate' 'config bakers cli' "$formats/exr/exr_chunks\.cpp|$formats/nvdb/nvdb_(checksum|input)\.cpp|bakers/preview/live/zlib_bytes\.cpp"
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
makers='bakers/math bakers/color bakers/field bakers/air bakers/light bakers/noise bakers/convection bakers/clouds bakers/occupancy bakers/march bakers/assets'
forbid '(iostream|fstream)' "$makers" "$none"
forbid 'bakers/io/' bakers/assets \
    'bakers/assets/(registry/probe_check\.(h|cpp)|occupancy/occupancy_check\.(h|cpp)|cloud_distance/distance_folder_check\.(h|cpp)|sources/source_files\.(h|cpp)|cloud_volume/cloud_(files|inputs)\.cpp)'

# --- The C library's functions ----------------------------------------------------------------------

# Its exponentials, sines and lengths have other last bits on other processors and in other versions.
# Code of baked values, and of facts in manifests, takes config/optics/elementary.h and
# bakers/math/transcendental.h in place of them. The exception only refuses towers that are too narrow
# for their voxels.
functions='exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|erf|erfc|[tl]gamma|a?(sin|cos|tan)h?|atan2|sincos'
called=$(grep -rlE "\b($functions)[fl]?\(" --include='*.h' --include='*.cpp' config $makers bakers/io |
    grep -vE '^config/sections/towers\.cpp$' |
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

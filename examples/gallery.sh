#!/usr/bin/env bash
# Draws every kind of picture, plot and page that skybake makes, and puts them on contact sheets of at
# most 20 pictures, to look at.
#   examples/gallery.sh FOLDER [PART...]   draws presets, assets, reports, sweeps, pages, or some of these
#   examples/gallery.sh --page [NAME...]   makes the pictures of the pages anew, or those of these names
# The parts of a folder may be drawn one after the other; `pages` shows the pages of all that are there.
# SKYBAKE names the program, SIZE the size of pictures of clouds, SUNS the elevations of the sun, and ONLY
# what is drawn of a part: a regular expression for the names of presets, assets, reports or sweeps.
# It needs imagemagick, librsvg2-bin and chromium.
set -euo pipefail
examples=$(cd "$(dirname "$0")" && pwd)
skybake=$(realpath "$(command -v "${SKYBAKE:-skybake}")")
size=${SIZE:-320x180} suns=${SUNS:-40,10,2}

# run COMMAND...: says what it does, and nothing else unless it fails
run() {
    echo "$*" >&2
    local log
    log=$("$skybake" "$@" 2>&1) || { echo "$log" >&2; return 1; }
}

# sheets NAME FILE...: FOLDER/NAME.png, or NAME-0.png and so on, of all pictures with their names
sheets() {
    local name=$1 labelled=() file
    shift
    (($#)) || return 0
    for file; do
        local short=${file#"$folder/"}
        labelled+=(-label "${short%.*}" "$file")
    done
    rm -f "$folder/$name".png "$folder/$name"-*.png
    montage "${labelled[@]}" -tile 4x5 -geometry '400x300>+6+6' -background '#171d26' -fill white \
        -font /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "$folder/$name.png"
    find "$folder" -maxdepth 1 \( -name "$name.png" -o -name "$name-*.png" \) | sort -V
}

# pictures PATTERN: the files below FOLDER, sorted by their names with numbers in order
pictures() { find "$folder" -path "$folder/$1" | sort -V; }

# recipe_of PAGE: the first recipe that the page prints
recipe_of() { awk '/^```toml/ {inside = 1; next} /^```/ {if (inside) exit} inside' "$1"; }

# drawn RECIPE NAME OPTION...: bakes a recipe and makes its preview, in FOLDER/NAME
drawn() {
    run bake "$1" -o "$folder/$2/baked" --certify off
    run preview "$folder/$2/baked" -o "$folder/$2" "${@:3}"
}

# with_light RECIPE: the options of a preview, as far as its pictures use them
with_light() {
    if grep -q '^\[clouds\.' "$1"; then echo "--size=$size"; fi
    if grep -qE 'cloud_volume|^\[bake\.multiple_scattering' "$1"; then echo "--sun-elevation=$suns"; fi
}

# --- The parts ------------------------------------------------------------------------------------

# The presets of skies, clouds, noises and particles, as `init` writes them.
presets() {
    local preset options
    for preset in $(preset_names); do
        [[ $preset =~ ${ONLY:-} ]] || continue
        mkdir -p "$folder/presets"
        run init "$folder/presets/$preset.toml" --preset "$preset" --force
        mapfile -t options < <(with_light "$folder/presets/$preset.toml")
        drawn "$folder/presets/$preset.toml" "presets/$preset" "${options[@]}"
    done
    mapfile -t shown < <(pictures 'presets/*/*' | grep -E '/(sky_panoramas|([^/]*_lit|scene)_sun_[0-9_]+(_against)?)\.png$')
    sheets presets_light "${shown[@]}"
    mapfile -t shown < <(pictures 'presets/*/*.png' | grep -E '/presets/(noise|particles)\.')
    sheets presets_others "${shown[@]}"
}

preset_names() {
    "$skybake" init --list --json | python3 -c '
import json, sys
for preset in json.load(sys.stdin)["presets"]:
    if preset["makes_recipe"]:
        print(preset["kind"] + "." + preset["name"])'
}

# One recipe for each kind of asset: the first of its page.
assets() {
    local page name options
    mkdir -p "$folder/assets"
    for page in "$examples"/assets/*.md; do
        name=$(basename "$page" .md)
        [[ $name =~ ${ONLY:-} ]] || continue
        recipe_of "$page" >"$folder/assets/$name.toml"
        mapfile -t options < <(with_light "$folder/assets/$name.toml")
        drawn "$folder/assets/$name.toml" "assets/$name" "${options[@]}"
    done
    mapfile -t shown < <(pictures 'assets/*/*.png' | grep -vE '_00(0[2-9]|[1-9][0-9])[_.]')
    sheets assets "${shown[@]}"
}

# Plots the costs of accuracy, for each kind of asset that has such a plot, and for whole skies and colours.
reports() {
    local recipe name file
    mkdir -p "$folder/reports"
    for recipe in earth phase bruneton volume; do reported "$recipe"; done
    for file in $(pictures 'reports/*/*.svg'); do rsvg-convert "$file" -o "${file%.svg}.png"; done
    mapfile -t shown < <(pictures 'reports/*/*.png')
    sheets reports "${shown[@]}"
}

# reported RECIPE
reported() {
    [[ ! $1 =~ ${ONLY:-} ]] || run report "$examples/$1.toml" --quick -o "$folder/reports/$1" --force
}

# Sweeps along one, two and three axes.
sweeps() {
    swept one "$examples/earth.toml" --vary 'bake.transmittance.size=[32,8],[64,16],[128,32],[256,64]'
    swept two "$examples/earth.toml" --vary 'bake.multiple_scattering.size=[8,8],[16,16],[32,32]' \
        --vary bake.multiple_scattering.pixel_type=float,half
    swept three "$examples/clouds.toml" --vary 'bake.cumulus.size=[100,100,16],[200,200,32]' \
        --vary clouds.cumulus.cover=0.2,0.4,0.6 --vary clouds.cumulus.convection.seed=1,2
    mapfile -t shown < <(pictures 'sweeps/*_page/*.png' | grep -E '/(contact_sheet[a-z_]*|[a-z_]+_variants)\.png$')
    sheets sweeps "${shown[@]}"
}

# swept NAME RECIPE OPTION...
swept() {
    [[ $1 =~ ${ONLY:-} ]] || return 0
    local out="$folder/sweeps/$1"
    run sweep "$2" -o "$out" "${@:3}"
    run preview "$out" -o "${out}_page" --size "$size" --sun-elevation "${suns%%,*}"
}

# The pages that are there, in light, dark and on a phone, and one that renders.
pages() {
    local page name
    run preview "$examples/clouds.toml" -o "$folder/live" --live
    rm -rf "$folder/pages"
    mkdir -p "$folder/pages"
    for page in $(pictures '*/index.html'); do
        name=${page#"$folder/"} name=${name%/index.html} name=${name//\//_}
        shot "$page" "$folder/pages/$name.png" 1280,1600
        shot "$page" "$folder/pages/${name}_dark.png" 1280,1600 --blink-settings=preferredColorScheme=0
        shot "$page" "$folder/pages/${name}_phone.png" 500,900
    done
    mapfile -t shown < <(pictures 'pages/*.png')
    sheets pages "${shown[@]}"
}

# shot PAGE PICTURE WIDTH,HEIGHT OPTION...: what Chromium shows of a page, after some time to render it
shot() {
    local profile
    profile=$(mktemp -d)
    chromium --headless --no-sandbox --hide-scrollbars --disable-background-networking --user-data-dir="$profile" \
        --use-angle=swiftshader --enable-unsafe-swiftshader --virtual-time-budget=4000 \
        --window-size="$3" --screenshot="$2" "${@:4}" "file://$1" >/dev/null 2>&1
    rm -rf "$profile"
}

# --- The pictures of the pages --------------------------------------------------------------------

# page [NAME...]: the pictures of gallery.md, of the recipes there, with the times that they took, and
# those that other pages show besides
page() {
    local name file command words seconds
    wanted=("$@")
    awk '/^!\[/ {name = $0; sub(/.*\(pictures\//, "", name); sub(/\).*/, "", name); stem = name; sub(/\..*/, "", stem)}
        /^```toml/ {recipe = stem ".toml"; next} /^```/ {recipe = ""; next} recipe {print >recipe}
        /^`skybake preview / {split($0, part, "`"); print name "|" part[4] "|" part[2]}' "$examples/gallery.md" >entries
    while IFS='|' read -r name file command <&3; do
        is_wanted "${name%.*}" || continue
        read -ra words <<<"${command#skybake }"
        if [[ ${SIZE:-} ]] && grep -q '^\[clouds\.' "${name%.*}.toml"; then words+=("--size=$SIZE"); fi
        seconds=$({ TIMEFORMAT=%U; time run "${words[@]}" -o "${name%.*}" 2>&4; } 4>&2 2>&1)
        if [[ $name == *.png ]]; then
            cp "${name%.*}/$file" "$examples/pictures/$name"
        else
            convert "${name%.*}/$file" -quality 88 "$examples/pictures/$name"
        fi
        sed -i "s/^\(\`skybake preview ${name%.*}.toml.* in \)[0-9]* s/\1$((${seconds%.*} + 1)) s/" "$examples/gallery.md"
    done 3<entries
    cd "$examples"
    taken earth.toml --sun-elevation 30,10,2,-4 -- sky_panoramas sky_sun_10
    taken clouds.toml --set 'clouds.cumulus.convection.cells=[144,144,23]' --sun-elevation 20 -- cumulus_lit_sun_20 cumulus_occupancy_cells_z
    taken takram_clouds.toml --only local_weather --only stbn -- local_weather_channels=takram_weather_channels \
        stbn_frames=blue_noise_frames stbn_spectrum=blue_noise_spectrum
    if is_wanted sky_presets; then
        printf '%s\n' 'preset = "earth"' '[bake.transmittance]' '[bake.multiple_scattering]' \
            'method = "solved"' 'mapping = "twilight"' >"$folder/skies.toml"
        run sweep "$folder/skies.toml" -o "$folder/skies" --certify off \
            --vary preset=earth,earth_clear_mountain,earth_maritime,earth_urban_haze,earth_desert_dust,mars
        taken "$folder/skies" --sun-elevation 8 -- contact_sheet=sky_presets
    fi
    if is_wanted live_page; then
        run preview clouds.toml -o "$folder/live" --live --sun-elevation 20
        shot "$folder/live/index.html" pictures/live_page.png 1280,800
    fi
    cloud_sheets
}

# is_wanted NAME: whether it is among those that were asked for, or none was
is_wanted() { ((${#wanted[@]} == 0)) || [[ " ${wanted[*]} " == *" $1 "* ]]; }

# taken RECIPE OPTION... -- NAME...: pictures of a preview; FILE=NAME where the pages call one otherwise
taken() {
    local options=() picture any=
    while [[ $1 != -- ]]; do options+=("$1") && shift; done
    shift
    for picture; do ! is_wanted "${picture#*=}" || any=1; done
    [[ $any ]] || return 0
    run preview "${options[@]}" -o "$folder/taken" --force
    for picture; do
        ! is_wanted "${picture#*=}" || cp "$folder/taken/${picture%=*}.png" "$examples/pictures/${picture#*=}.png"
    done
}

# Each cloud preset from two cameras, its rows, under six suns, its columns.
cloud_sheets() {
    local below="position=2km,0km,50m heading=63deg pitch=14deg fov=60deg"
    local layer="position=3km,1km,50m heading=63deg pitch=18deg fov=60deg"
    cloud_sheet cumulus_humilis "$below" "position=2km,0km,2.6km heading=63deg pitch=-14deg fov=60deg"
    cloud_sheet cumulus_mediocris "$below" "position=2km,0km,3.4km heading=63deg pitch=-12deg fov=60deg"
    cloud_sheet cumulus_congestus "position=0.6km,0km,200m heading=60deg pitch=16deg fov=70deg" \
        "position=2km,0km,6km heading=63deg pitch=-14deg fov=60deg"
    cloud_sheet cumulonimbus "heading=75deg pitch=4deg fov=42deg" "heading=20deg pitch=-8deg fov=45deg" --single
    cloud_sheet stratus "position=3km,1km,20m heading=63deg pitch=18deg fov=60deg" \
        "position=3km,1km,1.4km heading=63deg pitch=-9deg fov=60deg"
    cloud_sheet stratocumulus "$layer" "position=3km,1km,2.2km heading=63deg pitch=-9deg fov=60deg"
    cloud_sheet altocumulus "position=2km,1km,50m heading=63deg pitch=28deg fov=60deg" \
        "position=2km,1km,5km heading=63deg pitch=-9deg fov=60deg"
    cloud_sheet cirrus "position=3km,1km,50m heading=40deg pitch=28deg fov=65deg" \
        "position=3km,1km,12km heading=63deg pitch=-7deg fov=60deg"
    cloud_sheet fog_bank "position=1km,1km,230m heading=63deg pitch=-4deg fov=60deg" \
        "position=1km,1km,450m heading=63deg pitch=-12deg fov=60deg"
}

# cloud_sheet PRESET CAMERA CAMERA [OPTION...]
cloud_sheet() {
    local preset=$1 camera shown=()
    is_wanted "clouds_$preset" || return 0
    run init "$folder/$preset.toml" --preset "clouds.$preset" --force
    run bake "$folder/$preset.toml" -o "$folder/$preset" --certify off
    for camera in "$2" "$3"; do
        local view="$folder/${preset}_${#shown[@]}"
        run preview "$folder/$preset" -o "$view" --size 240x135 --sun-elevation 60,30,15,8,3,0.5 \
            --camera "$camera" "${@:4}"
        shown+=("$view/${preset}_lit_sun_"{60,30,15,8,3,0_5}.png)
    done
    montage "${shown[@]}" -tile 6x2 -geometry +2+2 -background black -quality 88 "pictures/clouds_$preset.jpg"
}

if [[ ${1:-} == --page ]]; then
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    cd "$folder"
    page "${@:2}"
elif (($#)) && [[ $1 != -* ]]; then
    mkdir -p "$1"
    folder=$(realpath "$1")
    shift
    (($#)) || set -- presets assets reports sweeps pages
    for part; do
        [[ " presets assets reports sweeps pages " == *" $part "* ]] || { echo "there is no part $part" >&2; exit 2; }
        "$part"
    done
else
    sed -n '2,9s/^# \?//p' "$0" >&2
    exit 2
fi

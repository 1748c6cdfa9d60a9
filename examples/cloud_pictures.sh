#!/usr/bin/env bash
# Makes the pictures of the cloud presets: each from two cameras under six suns.
#   examples/cloud_pictures.sh [path of skybake] [preset...]
set -euo pipefail
cd "$(dirname "$0")"
skybake=${1:-skybake}
wanted=("${@:2}")

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p pictures

# make_sheet PRESET CAMERA CAMERA [option...]: a row for each camera, a column for each sun.
make_sheet() {
    local preset=$1 cameras=("$2" "$3") options=("${@:4}") pictures=()
    [[ ${#wanted[@]} == 0 || " ${wanted[*]} " == *" $preset "* ]] || return 0
    "$skybake" init "$folder/$preset.toml" --preset "clouds.$preset" -q >/dev/null
    "$skybake" bake "$folder/$preset.toml" -o "$folder/$preset" --certify off -q >/dev/null
    for camera in 0 1; do
        local view="$folder/${preset}_$camera"
        "$skybake" preview "$folder/$preset" -o "$view" -q --size 240x135 \
            --sun-elevation 60,30,15,8,3,0.5 --camera "${cameras[$camera]}" "${options[@]}" >/dev/null
        for sun in 60 30 15 8 3 0_5; do
            pictures+=("$view/${preset}_lit_sun_$sun.png")
        done
    done
    oiiotool "${pictures[@]}" --mosaic:pad=4 6x2 --quality 88 -o "pictures/clouds_$preset.jpg"
}

make_sheet cumulus_humilis "position=2km,0km,50m heading=63deg pitch=14deg fov=60deg" \
    "position=2km,0km,2.6km heading=63deg pitch=-14deg fov=60deg"
make_sheet cumulus_mediocris "position=2km,0km,50m heading=63deg pitch=14deg fov=60deg" \
    "position=2km,0km,3.4km heading=63deg pitch=-12deg fov=60deg"
make_sheet cumulus_congestus "position=1km,1km,100m heading=45deg pitch=14deg fov=60deg" \
    "position=2km,0km,6km heading=63deg pitch=-14deg fov=60deg"
make_sheet cumulonimbus "heading=75deg pitch=4deg fov=42deg" \
    "heading=20deg pitch=-8deg fov=45deg" --single
make_sheet stratus "position=3km,1km,20m heading=63deg pitch=18deg fov=60deg" \
    "position=3km,1km,1.4km heading=63deg pitch=-9deg fov=60deg"
make_sheet stratocumulus "position=3km,1km,50m heading=63deg pitch=18deg fov=60deg" \
    "position=3km,1km,2.2km heading=63deg pitch=-9deg fov=60deg"
make_sheet altocumulus "position=2km,1km,50m heading=63deg pitch=28deg fov=60deg" \
    "position=2km,1km,5km heading=63deg pitch=-9deg fov=60deg"
make_sheet cirrus "position=3km,1km,50m heading=40deg pitch=28deg fov=65deg" \
    "position=3km,1km,12km heading=63deg pitch=-7deg fov=60deg"
make_sheet fog_bank "position=1km,1km,230m heading=63deg pitch=-4deg fov=60deg" \
    "position=1km,1km,450m heading=63deg pitch=-12deg fov=60deg"

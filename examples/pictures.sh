#!/usr/bin/env bash
# Makes the pictures that the pages show, from the examples beside it.
#   examples/pictures.sh [path of skybake]
set -euo pipefail
cd "$(dirname "$0")"
skybake=${1:-skybake}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$skybake" preview earth.toml -o "$folder/sky" --sun-elevation 30,10,2,-4 -q >/dev/null
"$skybake" preview phase.toml --only cloud_phase --only sky_view -o "$folder/phase" -q >/dev/null
"$skybake" preview clouds.toml -o "$folder/clouds" --sun-elevation 20 -q >/dev/null

mkdir -p pictures
for picture in clouds/cumulus_lit_sun_20 clouds/cumulus_occupancy_cells_z phase/cloud_phase sky/sky_panoramas sky/sky_sun_10; do
    cp "$folder/$picture.png" pictures/
done
cp "$folder/phase/sky_view_sun_20.png" pictures/fog_bow.png

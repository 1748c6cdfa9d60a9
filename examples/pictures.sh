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
"$skybake" preview takram_clouds.toml -o "$folder/takram" --only local_weather --only stbn -q >/dev/null
cat >"$folder/one_sky.toml" <<'RECIPE'
preset = "earth"

[bake.transmittance]

[bake.multiple_scattering]

[clouds.cumulus]
preset = "cumulus_mediocris"
scatter.count = 22

[clouds.cirrus]
preset = "cirrus"
coverage = 0.3

[bake.cumulus]
asset = "cloud_volume"
cloud = "cumulus"
size = [512, 512, 104]

[bake.cirrus]
asset = "cloud_volume"
cloud = "cirrus"
size = [512, 256, 32]

[preview]
sun_azimuth = "140 deg"

[preview.camera]
position = ["2.4 km", "1 km", "0.25 km"]
pitch = "11 deg"
fov = "58 deg"
RECIPE
"$skybake" preview "$folder/one_sky.toml" -o "$folder/one_sky" --sun-elevation 20 -q >/dev/null
"$skybake" init "$folder/mars.toml" --preset mars -q
"$skybake" preview "$folder/mars.toml" -o "$folder/mars" --sun-elevation 30,2 -q >/dev/null
cat >"$folder/presets.toml" <<'RECIPE'
preset = "earth"

[bake.transmittance]

[bake.multiple_scattering]
RECIPE
"$skybake" sweep "$folder/presets.toml" -o "$folder/presets" --certify off -q \
    --vary preset=earth,earth_clear_mountain,earth_maritime,earth_urban_haze,earth_desert_dust,mars
"$skybake" preview "$folder/presets" -o "$folder/presets_page" --sun-elevation 8 -q >/dev/null

./cloud_pictures.sh "$skybake"
for picture in clouds/cumulus_lit_sun_20 clouds/cumulus_occupancy_cells_z phase/cloud_phase sky/sky_panoramas sky/sky_sun_10; do
    cp "$folder/$picture.png" pictures/
done
cp "$folder/one_sky/scene_sun_20.png" pictures/one_sky.png
cp "$folder/phase/sky_view_sun_20.png" pictures/fog_bow.png
cp "$folder/mars/sky_panoramas.png" pictures/mars_panoramas.png
cp "$folder/presets_page/contact_sheet.png" pictures/sky_presets.png
cp "$folder/takram/local_weather_channels.png" pictures/takram_weather_channels.png
cp "$folder/takram/stbn_frames.png" pictures/blue_noise_frames.png
cp "$folder/takram/stbn_spectrum.png" pictures/blue_noise_spectrum.png

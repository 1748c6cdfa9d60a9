# Shared by the tests of bytes: bake recipes, compare folders.
#   NAME.sh SKYBAKE WORK_FOLDER REFERENCE_FOLDER     reference.sh fills the last for all others
set -euo pipefail

program=$1
work=$2
reference=$3
rm -rf "$work"
mkdir -p "$work"

presets=(earth tiny_planet dense_earth)
recipes=("${presets[@]}" noise clouds sky particles)

# bake FOLDER COMMAND...: all recipes, small tables and volumes, into FOLDER/RECIPE
bake() {
    local folder=$1 recipe
    shift
    for recipe in "${recipes[@]}"; do
        mkdir -p "$folder"
        if [[ " ${presets[*]} " != *" $recipe "* ]]; then
            "${recipe}_recipe" >"$folder/$recipe.toml"
        else
            printf 'preset = "%s"\n[bake.transmittance]\nsize = [64, 16]\n[bake.depth]\nasset = "transmittance"\ncontent = "optical_depth"\nsize = [33, 9]\n[bake.multiple_scattering]\nsize = [16, 8]\nmethod = "converged"\nmapping = "twilight"\nmax_texel_error = "2 %%"\n' \
                "$recipe" >"$folder/$recipe.toml"
        fi
        # Certificates of solved light are finer solutions: minutes on the slowest targets. That of
        # dense air takes more than ten times as long as its tables, by the kernels of the other planets.
        local certify=quick
        [[ $recipe != sky && $recipe != dense_earth ]] || certify=off
        "$@" bake "$folder/$recipe.toml" -o "$folder/$recipe" -q --certify="$certify" >/dev/null
    done
}

# All orders solved, and what sees them; no finer solution to measure against.
sky_recipe() {
    cat <<'TOML'
preset = "earth_hillaire"
[bake.sky_view]
size = [11, 9]
sun_elevations = ["2 deg"]
orders = "single"
[bake.scattering]
asset = "bruneton"
size = [32, 10, 6]
nu_size = 4
formats = ["exr", "bin"]
[bake.irradiance]
asset = "bruneton"
table = "irradiance"
size = [12, 5, 1]
pixel_type = "float"
TOML
}

# Spheres, phase functions, columns.
particles_recipe() {
    cat <<'TOML'
preset = "earth_hillaire"
[particles.haze]
preset = "haze"
[particles.drops]
material = "water"
sizes = "monodisperse"
radius = "3 um"
[atmosphere.layers.haze]
profile = "exponential"
scale_height = "1 km"
phase = { mie = "haze" }
number_density = "5e3 /cm3"
[bake.haze]
asset = "phase"
particles = "haze"
max_error = "1 %"
[bake.drops]
asset = "phase"
particles = "drops"
content = "inverse_cumulative"
pixel_type = "half"
[bake.transmittance]
size = [64, 16]
[bake.sky_view]
size = [11, 9]
sun_elevations = ["40 deg"]
orders = "single"
[bake.to_top]
asset = "optical_depth"
size = [40, 12, 1]
[bake.between]
asset = "optical_depth"
table = "between"
size = [12, 10, 9]
formats = ["bin"]
[bake.shells]
asset = "optical_depth"
size = [16, 8, 1]
sampling = "equal_attenuation"
TOML
}

# Every kernel of noise, wide cells and narrow ones, sizes that no vector divides, every format; a map
# and a mask.
noise_recipe() {
    cat <<'TOML'
[noise.shape]
preset = "nubis_shape"
[noise.packed]
preset = "takram_shape"
[noise.odd]
seed = "18446744073709551615"
[noise.odd.channels.R]
type = "perlin"
fractal = "ridged"
frequencies = [[3, 5, 2], 7, 90]
gains = [1, 0.5, 0.25]
[noise.odd.channels.G]
type = "worley"
feature = "f2_minus_f1"
value_form = "distance"
frequency = 5
[noise.odd.channels.B]
type = "curl"
frequency = 3
octaves = 2
component = "y"
[noise.odd.channels.A]
type = "worley"
feature = "f2"
frequencies = [2, 21, 75]
bias = 0.3
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [48, 48, 40]
formats = ["exr", "vdb", "bin"]
mips = 3
[bake.packed]
asset = "noise_volume"
noise = "packed"
size = [32, 32, 32]
formats = ["bin"]
pixel_type = "unorm8"
[bake.odd]
asset = "noise_volume"
noise = "odd"
size = [37, 29, 31]
formats = ["exr", "vdb"]
layout = "atlas"
columns = 6
compression = "piz"
vdb_compression = "zip"
pixel_type = "float"
[bake.map]
asset = "weather_map"
noise = "odd"
size = [53, 47]
covered = [0.4, 0.6, 1, 0.3]
full = [0.1, 0, 0, 0.2]
yields_to = ["G", "", "", ""]
streaks = [0, 0, 0.1, 0]
wind = "50 deg"
[bake.mask]
asset = "blue_noise"
size = [37, 29]
frames = 7
TOML
}

# Towers narrow and wide, turned and scattered, erosion, blended profiles, hard and soft edges, and
# grids of both rules, all filters and pixel types.
clouds_recipe() {
    cat <<'TOML'
[noise.shape]
preset = "nubis_shape"
pack = "shape"
[noise.detail]
preset = "nubis_detail"
pack = "detail"
[noise.four]
preset = "thesis"
[clouds.field]
noise = "shape"
detail = "detail"
detail_scale = 2
extent = ["1 km", "900 m", "500 m"]
coverage = 0.4
height_profile = { type = "blended", cloud_type = 0.7 }
scatter = { count = 9, seed = 4, sigma = [0.02, 0.3], aspect = [1, 3], amplitude = [0.1, 0.9] }
[[clouds.field.towers]]
center = [0.02, 0.97]
sigma = [0.3, 2]
rotation = "37 deg"
correlation = -0.6
amplitude = 0.4
[clouds.thesis]
preset = "thesis"
noise = "four"
[bake.field]
asset = "cloud_volume"
cloud = "field"
size = [133, 49, 41]
formats = ["vdb", "exr", "bin"]
mips = 3
[bake.thesis]
asset = "cloud_volume"
cloud = "thesis"
size = [40, 40, 40]
formats = ["vdb", "exr"]
pixel_type = "float"
[bake.field_light]
asset = "cloud_light"
of = "field"
sun_elevations = ["70 deg", "25 deg", "4 deg"]
sun_azimuths = ["10 deg", "130 deg", "250 deg"]
[bake.field_sky]
asset = "cloud_light"
of = "field"
contents = "sky_visibility"
cell = 8
[bake.thesis_light]
asset = "cloud_light"
of = "thesis"
channel = "G"
contents = "transmittance"
sun_elevations = "35 deg"
[bake.field_grid]
asset = "occupancy"
of = "field"
cell = 1
formats = ["vdb", "exr", "bin"]
[bake.thesis_grid]
asset = "occupancy"
of = "thesis"
channel = "G"
cell = 8
filter = "tricubic"
formats = ["bin"]
pixel_type = "unorm8"
[bake.field_distance]
asset = "cloud_distance"
of = "field"
cell = 1
formats = ["npy", "bin"]
[bake.thesis_distance]
asset = "cloud_distance"
of = "thesis"
channel = "G"
cell = 8
contents = ["distance", "profile", "detail_type", "density_scale"]
pixel_type = "half"
formats = ["exr"]
[bake.thesis_rule]
asset = "occupancy"
of = "thesis"
rule = "thesis"
contents = ["leap"]
formats = ["vdb", "exr", "bin"]
mips = 2
TOML
}

# same A B: every file equal, wall times in the manifest and the hashes over them aside
same() {
    local recipe file
    for recipe in "${recipes[@]}"; do
        diff <(cd "$1/$recipe" && ls) <(cd "$2/$recipe" && ls)
        for file in "$1/$recipe"/*; do
            [[ $file == */manifest.json ]] || cmp "$file" "$2/$recipe/${file##*/}"
        done
        diff <(sed -E 's/"([a-z]+_s|threads|hash)": [^,]*/"\1"/' "$1/$recipe/manifest.json") \
            <(sed -E 's/"([a-z]+_s|threads|hash)": [^,]*/"\1"/' "$2/$recipe/manifest.json")
    done
    echo "same bytes: $1 $2"
}

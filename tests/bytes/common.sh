# Shared by the tests of bytes: bake recipes, compare folders.
set -euo pipefail

program=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

recipes=(earth tiny_planet dense_earth)

# bake FOLDER COMMAND...: all recipes, small tables and volumes, into FOLDER/RECIPE
bake() {
    local folder=$1 recipe
    shift
    for recipe in "${recipes[@]}" noise; do
        mkdir -p "$folder"
        if [[ $recipe == noise ]]; then
            noise_recipe >"$folder/noise.toml"
        else
            printf 'preset = "%s"\n[bake.transmittance]\nsize = [64, 16]\n[bake.depth]\nasset = "transmittance"\ncontent = "optical_depth"\nsize = [33, 9]\n[bake.multiple_scattering]\nsize = [16, 8]\nmapping = "twilight"\nmax_texel_error = "2 %%"\n' \
                "$recipe" >"$folder/$recipe.toml"
        fi
        "$@" bake "$folder/$recipe.toml" -o "$folder/$recipe" -q >/dev/null
    done
}

# Every kernel of noise, wide cells and narrow ones, sizes that no vector divides, every format.
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
compression = "piz"
vdb_compression = "zip"
pixel_type = "float"
TOML
}

# same A B: every file equal, wall times in the manifest aside
same() {
    local recipe file
    for recipe in "${recipes[@]}" noise; do
        diff <(cd "$1/$recipe" && ls) <(cd "$2/$recipe" && ls)
        for file in "$1/$recipe"/*; do
            [[ $file == */manifest.json ]] || cmp "$file" "$2/$recipe/${file##*/}"
        done
        diff <(sed -E 's/"(bake_s|write_s|threads)": [^,]*/"\1"/' "$1/$recipe/manifest.json") \
            <(sed -E 's/"(bake_s|write_s|threads)": [^,]*/"\1"/' "$2/$recipe/manifest.json")
    done
    echo "same bytes: $1 $2"
}

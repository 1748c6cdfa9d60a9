# Shared by the tests of bytes: bake recipes, compare folders.
set -euo pipefail

program=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

recipes=(earth tiny_planet dense_earth)

# bake FOLDER COMMAND...: all recipes, small tables, into FOLDER/RECIPE
bake() {
    local folder=$1 recipe
    shift
    for recipe in "${recipes[@]}"; do
        mkdir -p "$folder"
        printf 'preset = "%s"\n[bake.transmittance]\nsize = [64, 16]\n[bake.depth]\nasset = "transmittance"\ncontent = "optical_depth"\nsize = [33, 9]\n[bake.multiple_scattering]\nsize = [16, 8]\nmapping = "twilight"\nmax_texel_error = "2 %%"\n' \
            "$recipe" >"$folder/$recipe.toml"
        "$@" bake "$folder/$recipe.toml" -o "$folder/$recipe" -q >/dev/null
    done
}

# same A B: every file equal, wall times in the manifest aside
same() {
    local recipe file
    for recipe in "${recipes[@]}"; do
        for file in transmittance.exr depth.exr multiple_scattering.exr; do
            cmp "$1/$recipe/$file" "$2/$recipe/$file"
        done
        diff <(sed -E 's/"(bake_s|write_s|threads)": [^,]*/"\1"/' "$1/$recipe/manifest.json") \
            <(sed -E 's/"(bake_s|write_s|threads)": [^,]*/"\1"/' "$2/$recipe/manifest.json")
    done
    echo "same bytes: $1 $2"
}

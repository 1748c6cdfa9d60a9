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
            cp "$(dirname "${BASH_SOURCE[0]}")/../recipes/bytes/$recipe.toml" "$folder"
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

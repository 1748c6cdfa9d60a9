#!/usr/bin/env bash
# Bakes what an example draws into its folder `baked`, with lookups.LANGUAGE, which reads the files there.
#   bake.sh webgl|webgpu|glsl|hlsl [SKYBAKE [FOLDER]]
set -euo pipefail
here=$(dirname "$0")
example=$1
skybake=${2:-skybake}
baked=${3:-$here/$example/baked}
case $example in
    webgl | glsl) language=glsl ;;
    webgpu) language=wgsl ;;
    hlsl) language=hlsl ;;
esac
"$skybake" bake "$here/recipe.toml" -o "$baked"
# Lookups of two files share functions, which are paragraphs: each is printed once. That of the folder is how
# pictures show its light.
for file in "$baked"/*.bin "$baked"; do
    "$skybake" info --lookup "$file" --language "$language"
    echo
done | awk 'BEGIN { RS = ""; ORS = "\n\n" } !seen[$0]++' >"$baked/lookups.$language"

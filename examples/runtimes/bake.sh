#!/usr/bin/env bash
# Bakes what an example draws into its folder `baked`, with lookups.LANGUAGE, which reads the files there.
#   bake.sh webgl|webgpu|glsl|hlsl|npm [SKYBAKE [FOLDER]]
set -euo pipefail
here=$(dirname "$0")
example=$1
skybake=${2:-skybake}
baked=${3:-$here/$example/baked}
case $example in
    webgl | glsl | npm) language=glsl ;;
    webgpu) language=wgsl ;;
    hlsl) language=hlsl ;;
esac
"$skybake" bake "$here/recipe.toml" -o "$baked"
"$skybake" info --lookup "$baked" --language "$language" >"$baked/lookups.$language"

#!/usr/bin/env bash
# Bakes what an example draws into its folder `baked`, with lookups.LANGUAGE, which reads the files there.
#   bake.sh webgl|webgpu|glsl|hlsl|godot|npm [SKYBAKE [FOLDER]]
set -euo pipefail
here=$(dirname "$0")
example=$1
skybake=${2:-skybake}
baked=${3:-$here/$example/baked}
options=()
ending=
case $example in
    webgl | glsl | npm) language=glsl ;;
    webgpu) language=wgsl ;;
    hlsl) language=hlsl ;;
    godot)  # loads DDS files as they are
        language=godot ending=gdshaderinc
        for asset in transmittance multiple_scattering cloud cells; do
            options+=(--set "bake.$asset.formats=\"dds\"")
        done
        ;;
esac
"$skybake" bake "$here/recipe.toml" -o "$baked" "${options[@]}"
"$skybake" info --lookup "$baked" --language "$language" >"$baked/lookups.${ending:-$language}"

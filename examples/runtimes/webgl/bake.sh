#!/usr/bin/env bash
# Bakes what the page draws into baked/ beside it, with the lookup of each file. Then, in this folder:
#   python3 -m http.server     and open http://localhost:8000/
#   bake.sh [SKYBAKE [FOLDER]]
set -euo pipefail
here=$(dirname "$0")
skybake=${1:-skybake}
baked=${2:-$here/baked}
"$skybake" bake "$here/recipe.toml" -o "$baked"
for file in "$baked"/*.bin; do
    "$skybake" info --lookup "$file" > "${file%.bin}.glsl"
done

#!/usr/bin/env bash
# An installed tree works from any folder, without the source or the build.
#   works_from_any_folder.sh CMAKE BUILD PREFIX
set -euo pipefail
cmake=$1 build=$2 prefix=$3
rm -rf "$prefix"
"$cmake" --install "$build" --prefix "$prefix" >/dev/null
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
"$prefix/bin/skybake" init mars.toml --preset mars
"$prefix/bin/skybake" bake mars.toml --only transmittance >paths
test "$(wc -l <paths)" = 2
"$prefix/bin/skybake" verify out
test -s "$prefix/share/skybake/manifest_schema.json"
test -s "$prefix/share/skybake/lookups/sky_view.glsl"
for module in "$build"/lib*/skybake/*.so; do
    test -s "$prefix/${module#"$build"/}"
done

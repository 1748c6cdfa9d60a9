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
"$prefix/bin/skybake" help --man | cmp - "$prefix/share/man/man1/skybake.1"
"$prefix/bin/skybake" help bake --man | cmp - "$prefix/share/man/man1/skybake-bake.1"
for command in $("$prefix/bin/skybake" help | sed -n '/^commands:/,/^$/ s/^  \([a-z]*\) .*/\1/p'); do
    test -s "$prefix/share/man/man1/skybake-$command.1"
done
"$prefix/bin/skybake" help --completion bash |
    cmp - "$prefix/share/bash-completion/completions/skybake"
"$prefix/bin/skybake" help --completion zsh | cmp - "$prefix/share/zsh/site-functions/_skybake"
"$prefix/bin/skybake" help --completion fish |
    cmp - "$prefix/share/fish/vendor_completions.d/skybake.fish"
test -s "$prefix/share/doc/skybake/LICENSE"
"$prefix/bin/skybake" check "$prefix/share/skybake/examples/earth.toml"
for module in "$build"/lib*/skybake/*.so; do
    test -s "$prefix/${module#"$build"/}"
done

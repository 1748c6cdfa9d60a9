#!/usr/bin/env bash
# bake --prune removes what left the recipe, and nothing else, whenever it is killed.
source "$(dirname "$0")/common.sh"

# The recipe without its cloud and the grid of it.
sed '/^\[clouds.puff\]/,$d' sky.toml >less.toml
bake_less() { "$program" bake less.toml --certify off --quiet -o "$1" "${@:2}" >/dev/null; }
bake_less clean_less
clean[less]=$(sums clean_less)
gone=(puff.vdb puff_grid.exr)

bake a out
echo mine >out/mine.exr
bake_less out
for file in "${gone[@]}" mine.exr; do [[ -e out/$file ]] || fail "$file is gone without --prune"; done
listed=$(sums out)
"$program" bake less.toml --certify off -o out --prune --dry-run >plan
for file in "${gone[@]}"; do grep -q "$file is no longer in the recipe and would be removed" plan || fail "$file: $(cat plan)"; done
[[ "$(sums out)" == "$listed" ]] || fail "--dry-run has changed files"
bake_less out --prune
[[ $(cat out/mine.exr) == mine ]] || fail "--prune has touched a file of somebody else"
rm out/mine.exr
holds out less || fail "pruned: $(sums out)"

# A file that was changed by hand is kept, and so is what a link at its place points to.
rm -rf out
bake a out
echo changed >>out/puff.vdb
mv out/puff_grid.exr elsewhere.exr
ln -s ../elsewhere.exr out/puff_grid.exr
bake_less out --prune
[[ $(tail -c 8 out/puff.vdb) == changed ]] || fail "a changed file is gone"
[[ -L out/puff_grid.exr && -s elsewhere.exr ]] || fail "a link or its target is gone"
echo "changed files are kept"

# Killed at any moment, the next run ends where a clean one ends.
rm -rf out
bake a out
timed bake_less out --prune
kills=0
while ((kills < 10)); do
    rm -rf out
    bake a out
    random_moment "$bake_ms"
    timeout -s KILL "$moment" "$program" bake less.toml --certify off --quiet -o out --prune >/dev/null 2>&1 ||
        kills=$((kills + 1))
    bake_less out --prune
    holds out less || fail "after a kill: $(sums out)"
done 2> >(grep -v Killed >&2)
echo "$kills kills"

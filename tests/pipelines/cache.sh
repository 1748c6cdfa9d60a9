#!/usr/bin/env bash
# One cache for many: whoever else uses, prunes, kills or damages it, folders hold the right bytes.
source "$(dirname "$0")/common.sh"

assets=5
cached() { bake "$1" "$2" --cache-dir cache; }
whole_cache() { "$program" cache verify --cache-dir cache >log || fail "cache: $(cat log)"; }
entries() { find cache/assets -mindepth 2 -maxdepth 2 | wc -l; }

# Processes at once, each in a folder of its own.
for round in {1..5}; do
    rm -rf cache out_*
    jobs=()
    for i in 1 2 3; do
        cached a "out_$i" &
        jobs+=($!)
    done
    for job in "${jobs[@]}"; do wait "$job" || fail "exit code $?"; done
    for i in 1 2 3; do holds "out_$i" a || fail "process $i: $(sums "out_$i")"; done
    whole_cache
    (($(entries) == assets)) || fail "$(entries) entries"
done
echo "three processes: one cache of $assets assets"

# Killed while it fills or reads the cache.
kills=0
while ((kills < 40)); do
    rm -rf out
    ((RANDOM % 2)) || rm -rf cache
    options a
    random_moment "$bake_ms"
    timeout -s KILL "$moment" "$program" bake "${options[@]}" -o out --cache-dir cache >/dev/null 2>&1 ||
        kills=$((kills + 1))
    if [[ -d cache ]]; then whole_cache; fi
    rm -rf out
    cached a out || fail "after a kill"
    holds out a || fail "after a kill: $(sums out)"
done 2> >(grep -v Killed >&2)
"$program" cache gc --cache-dir cache --max-size 1GiB >/dev/null
[[ -z $(ls -A cache/pending) ]] || fail "left in pending: $(ls -A cache/pending)"
echo "$kills kills"

# Damage of every kind to every file costs a bake and never a byte.
damages=0
for kind in flip cut empty remove replace; do
    rm -rf cache out
    cached a out
    for file in cache/assets/*/*/*; do
        size=$(stat -c %s "$file")
        case $kind in
            flip) printf '\xa5' | dd of="$file" bs=1 seek=$((size / 2)) conv=notrunc status=none ;;
            cut) truncate -s $((size - 1)) "$file" ;;
            empty) : >"$file" ;;
            remove) rm "$file" ;;
            replace) cp clean_b/wisps.bin "$file" ;;
        esac
        damages=$((damages + 1))
    done
    rm -rf out
    cached a out || fail "$kind: exit code $?"
    holds out a || fail "$kind reached the output: $(sums out)"
    "$program" cache verify --cache-dir cache >/dev/null || true
    whole_cache  # the one before has removed what was damaged
done
echo "$damages damaged files"

# Pruned all the while.
rm -rf cache
(while [[ ! -e enough ]]; do "$program" cache gc --cache-dir cache --max-size 0 >/dev/null || touch failed; done) &
for round in {1..15}; do
    rm -rf out
    cached "$([[ $((round % 2)) == 0 ]] && echo a || echo b)" out || fail "while pruning"
    holds out "$([[ $((round % 2)) == 0 ]] && echo a || echo b)" || fail "while pruning: $(sums out)"
done
touch enough
wait
[[ ! -e failed ]] || fail "gc while baking"
whole_cache
echo "pruned all the while"

#!/usr/bin/env bash
# Limits of a user or of a container: few files open at once, and few threads. Either the bake goes on, or
# a sentence says what is missing; nothing aborts, waits for ever or loses what is done.
source "$(dirname "$0")/common.sh"

# --- Few descriptors -------------------------------------------------------------------------------
# 1200 files of 600 assets, each of which is staged before the first gets its name.
{
    printf '[noise.n.channels.Y]\ntype = "worley"\nfrequency = 1\n'
    for i in {1..600}; do
        printf '[bake.n%d]\nasset = "noise_volume"\nnoise = "n"\nsize = [4, 4, 4]\nformats = ["bin", "npy"]\n' "$i"
    done
} >many.toml
(ulimit -n 64 && "$program" bake many.toml --certify off -q -o many >/dev/null 2>log) || fail "64 descriptors: $(cat log)"
count=$(find many -name '*.bin' -o -name '*.npy' | wc -l)
((count == 1200)) || fail "$count files of 1200"
[[ -z $(find many -name '.*') ]] || fail "temporaries are left: $(find many -name '.*' | head -3)"
"$program" verify many >/dev/null || fail "verify"
echo "1200 files with 64 descriptors"

# --- Few threads -----------------------------------------------------------------------------------
# Root may have any number, and another user must be able to run the program and to write here.
as_user=()
((EUID)) || as_user=(setpriv --reuid 65534 --regid 65534 --clear-groups)
mkdir -m 777 threads
chmod 755 .
if ! "${as_user[@]}" test -x "$program" -a -w threads; then
    echo "few threads: not tested, no other user can run $program"
    exit 0
fi
cat >threads/tables.toml <<'TOML'
[noise.n.channels.Y]
type = "worley"
frequency = 4
[bake.n]
asset = "noise_volume"
noise = "n"
size = [16, 16, 16]
formats = ["exr", "bin", "ktx2"]
TOML
sed 's/"bin"/"bin", "vdb"/' threads/tables.toml >threads/vdb.toml
# with_few_threads N COMMAND...: a program that waits for ever is ended after a minute, in which a busy
# machine bakes this.
with_few_threads() {
    "${as_user[@]}" bash -c 'ulimit -u "$1" && exec timeout -s KILL 60 "${@:2}"' _ "$@" >/dev/null 2>log
}
says_few_threads() { grep -qE 'begin (only|no more)' log; }
baked=0 refused=0
for recipe in tables vdb; do
    "$program" bake threads/$recipe.toml --certify off -q -o clean_$recipe >/dev/null 2>log || fail "$(cat log)"
    for jobs in 2 8; do
        for most in {3..16}; do
            code=0
            out=threads/$recipe-$jobs-$most
            with_few_threads "$most" "$program" bake threads/$recipe.toml --certify off -j $jobs -o $out || code=$?
            case $code in
                0) baked=$((baked + 1))
                   [[ "$(sums $out)" == "$(sums clean_$recipe)" ]] || fail "$out: other bytes" ;;
                3) refused=$((refused + 1))
                   says_few_threads || fail "$out says: $(cat log)"
                   [[ ! -e $out ]] || fail "$out: $(ls -A $out)" ;;
                *) fail "$out: exit code $code: $(cat log)" ;;
            esac
        done
    done
done
# Whether a thread can begin may change between the count and the use. Pictures have text, for which Pango
# begins threads.
sweep=(sweep threads/tables.toml --vary noise.n.seed=1,2,3 --certify off -j 8)
for most in 3 5 7 9 11 13; do
    for command in "${sweep[*]}" "preview threads/tables.toml" "report threads/tables.toml --quick"; do
        code=0
        with_few_threads "$most" "$program" $command -o "threads/${command%% *}$most" || code=$?
        [[ $code == 0 ]] || { [[ $code == 3 ]] && says_few_threads; } ||
            fail "$command with $most threads: exit code $code: $(cat log)"
    done
done
# Tables need no thread but the first; OpenVDB's libraries begin threads of their own.
((baked >= 30)) || fail "only $baked bakes succeeded"
((refused > 0)) || fail "no limit was too low for OpenVDB"
echo "few threads: $baked bakes, $refused refused in a sentence"

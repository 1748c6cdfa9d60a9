#!/usr/bin/env bash
# A cache on a server: two folders share what one baked, and whatever the server does, folders hold the
# right bytes.
here=$(realpath "$(dirname "$0")")
source "$here/common.sh"
export no_proxy=127.0.0.1
unset SKYBAKE_CACHE SKYBAKE_CACHE_DIR

mkdir served
coproc SERVER { exec python3 "$here/cache_server.py" "$PWD/served" 2>server_log; }
read -r port <&"${SERVER[0]}"
url=http://127.0.0.1:$port
# requests MODE [METHOD]: how many there were
requests() { grep -c "^$1 ${2:-}" served/requests || true; }

# served MODE STORE FOLDER [OPTION...]: a bake with the cache; its words are in FOLDER.log
served() {
    rm -rf "$3"
    "$program" bake sky.toml --certify off -o "$3" --cache "$url/$1/$2" "${@:4}" >/dev/null 2>"$3.log" || fail "$1: exit code $?: $(cat "$3.log")"
    holds "$3" a || fail "$1: $(sums "$3")"
}
says() { grep -q -- "$2" "$1.log" || fail "no \`$2\` in: $(cat "$1.log")"; }
is_silent() { ! grep -q W0305 "$1.log" || fail "$(cat "$1.log")"; }

# The second bake makes nothing, and its bytes are those of the first, times aside.
served right a first
is_silent first
(($(requests right PUT) == 5 + 7)) || fail "$(requests right PUT) files were put"
served right a second
is_silent second
says second '5 assets (5 from the cache)'
(($(requests right PUT) == 5 + 7)) || fail "files were put again"
cmp <(sed 's/"hash": .*//' first/manifest.json) <(sed 's/"hash": .*//' second/manifest.json) ||
    fail "manifests differ"
# A folder that is up to date asks nobody.
before=$(requests right)
bake a second --cache "$url/right/a"
(($(requests right) == before)) || fail "an up-to-date folder asked the server"
# A folder's cache stands before the server and is filled from it.
served right a third --cache-dir cache
before=$(requests right)
served right a fourth --cache-dir cache
says fourth '5 assets (5 from the cache)'
(($(requests right) == before)) || fail "the server was asked for what the folder has"
SKYBAKE_CACHE=$url/right/a "$program" bake sky.toml --certify off -o by_variable >/dev/null 2>by_variable.log
says by_variable '5 from the cache'
echo "five folders share one server"

# Servers that fail. Those that cost time do it side by side.
(served silent a silent) &
silent=$!
(served dribble a dribble) &
dribble=$!
(served sink empty sink) &
sink=$!
for mode in status500 garbage redirect cut; do
    served "$mode" a "$mode"
    says "$mode" 'W0305.*it failed 3 times and was then left alone'
    (($(requests "$mode") <= 6)) || fail "$mode: $(requests "$mode") requests"
done
says status500 'GET was answered by status 500'
says redirect 'GET was answered by status 302'
[[ $(requests cut PUT) == 0 ]] || fail "a server that fails got files"
port_of_nobody=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
url=http://127.0.0.1:$port_of_nobody served refused a refused
says refused 'it failed 3 times and was then left alone.*connect'
served status403 empty status403
says status403 'first with `PUT was answered by status 403`'

# Servers that lie.
for mode in short wrong others wrong_manifest no_json endless endless_files; do
    served "$mode" a "$mode"
    says "$mode" 'W0305.*3 of its entries were damaged and not used'
    grep -q 'assets.*from the cache' "$mode.log" && fail "$mode was used: $(cat "$mode.log")"
    (($(requests "$mode" PUT) > 0)) || fail "$mode: nothing was put in place of what was damaged"
done
# A body without an end is cut off by its length, not by the time that it takes: after the 16 MiB of the
# largest manifest, and after the bytes that a file has. What the system holds under way comes on top.
most_sent() { awk -v mode="$1" '$1 == mode && $2 > most { most = $2 } END { print most + 0 }' served/sent; }
for _ in {1..600}; do
    (($(wc -l <served/sent) < 6)) || break
    sleep 0.05
done
(($(most_sent endless) < 64 << 20)) || fail "$(most_sent endless) bytes of a manifest without end"
(($(most_sent endless_files) < 16 << 20)) || fail "$(most_sent endless_files) bytes of a file without end"
served right a after
is_silent after
says after '5 from the cache'
# Damage on the server is mended by whoever finds it.
printf x >>"served/a/$(grep -A5 '"path": "wisps.vdb"' clean_a/manifest.json | sed -n 's/.*"xxh3": "\(.*\)".*/\1/p' | head -n 1)"
served right a damaged
says damaged '1 of its entries was damaged'
served right a mended
is_silent mended
says mended '5 from the cache'
for process in $silent $dribble $sink; do wait "$process" || fail "a slow server"; done
says silent 'it failed 3 times and was then left alone'
says dribble 'it failed 3 times and was then left alone'
says sink 'it failed 3 times and was then left alone, first with `PUT'
echo "16 kinds of wrong servers"

# A server that is right and slow costs what baking cost, and some seconds: then it is no longer read.
served right slow filling
served slow slow slow
says slow 'it was no longer read, because reading took longer than baking does'
(($(requests slow GET) < 8)) || fail "$(requests slow GET) requests to a server that is slower than baking"
! grep -q 'it failed' slow.log || fail "$(cat slow.log)"
echo "a slow server"

# An interrupt ends a bake that waits for a silent server.
before=$(requests silent)
"$program" bake sky.toml --certify off -o interrupted --cache "$url/silent/a" >/dev/null 2>interrupted.log &
process=$!
until (($(requests silent) > before)); do sleep 0.05; done
kill -TERM $process
code=0
wait $process || code=$?
[[ $code == 130 && ! -e interrupted ]] || fail "exit code $code after an interrupt"
(($(requests silent) == before + 1)) || fail "the server was asked again after the interrupt"
echo "an interrupt"

# A password opens the server and is seen nowhere.
locked=http://farm:s3cret@127.0.0.1:$port
url=$locked served locked b locked
is_silent locked
url=$locked served locked b locked_again
says locked_again '5 from the cache'
url=http://farm:wr0ng@127.0.0.1:$port served locked b refused_password
says refused_password '401'
mkdir home
printf 'machine 127.0.0.1 login farm password s3cret\n' >home/.netrc
chmod 600 home/.netrc
HOME=$PWD/home served locked b by_netrc
says by_netrc '5 from the cache'
! "$program" bake sky.toml --cache "ftp://farm:s3cret@host/" 2>words || fail "ftp was accepted"
! "$program" sweep sky.toml --vary noise.wisps.seed=1,2 --emit commands --cache "$locked/locked/b" >script 2>>words ||
    fail "a script with a password"
! SKYBAKE_CACHE=nonsense://farm:s3cret@host "$program" bake sky.toml 2>>words || fail "nonsense was accepted"
! grep -rE 's3cret|wr0ng' locked locked_again refused_password ./*.log words script served/b cache || fail "a password is shown"
echo "passwords stay out of sight"

# All threads of a sweep share a server and its failures.
sweep() {
    rm -rf "$1"
    "$program" sweep sky.toml --vary noise.wisps.seed=1,2,3 --certify off -o "$1" --cache "$url/$2" >/dev/null 2>"$1.log" ||
        fail "sweep: $(cat "$1.log")"
}
sweep swept right/c
is_silent swept
puts=$(requests right PUT)
sweep swept_again right/c
is_silent swept_again
(($(requests right PUT) == puts)) || fail "the second sweep put files"
sweep swept_badly status500/c
(($(grep -c W0305 swept_badly.log) == 1)) || fail "$(cat swept_badly.log)"
for variant in swept/*/; do
    name=$(basename "$variant")
    [[ "$(sums "swept/$name")" == "$(sums "swept_again/$name")" && "$(sums "swept/$name")" == "$(sums "swept_badly/$name")" ]] ||
        fail "sweeps differ in $name"
done
echo "sweeps share it too"
exec {SERVER[1]}>&-

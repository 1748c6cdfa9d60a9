#!/usr/bin/env bash
# A full disk, files that may not grow, folders that may not be written to and too little memory: the
# exit code says so, and what was there stays.
source "$(dirname "$0")/common.sh"

# refused CODE COMMAND...
refused() {
    local expected=$1 code=0
    shift
    "$@" >/dev/null 2>log || code=$?
    ((code == expected)) || fail "exit code $code, not $expected: $* $(cat log)"
}

# old_or_new FOLDER: bakes set b over a; where that fails, all of a is still there
old_or_new() {
    local folder=$1 code=0 log
    options b
    # Not into a file, which would be limited, too.
    log=$("$program" bake "${options[@]}" -o "$folder" 2>&1 >/dev/null) || code=$?
    case $code in
        0) holds "$folder" b || fail "not b: $(sums "$folder")" ;;
        3) holds "$folder" a || fail "not a any more: $(sums "$folder")"
           [[ $log == *E0301* ]] || fail "no E0301: $log" ;;
        *) fail "exit code $code: $log" ;;
    esac
    return "$code"
}

# --- Files of limited size -------------------------------------------------------------------------
failures=0
for kib in 0 1 2 4 6 8 12 16 24 32 64 1024; do
    bake a limited
    (ulimit -f "$kib" && old_or_new limited) || failures=$((failures + 1))
done
((failures > 5 && failures < 12)) || fail "$failures of 12 limits were too small"
echo "limited size: $failures of 12 bakes failed, none lost a file"

# --- A full disk -----------------------------------------------------------------------------------
mkdir disk
if mount -t tmpfs -o size=512k skybake_test disk 2>/dev/null; then
    trap 'umount "$work/disk"' EXIT
    failures=0
    for free_kib in 0 4 8 16 24 48 64 80 96 112 144 300; do
        rm -f disk/filler
        bake a disk/out
        available=$(df --output=avail -k disk | tail -1)
        filler=$((available > free_kib ? available - free_kib : 0))
        head -c "${filler}k" /dev/zero >disk/filler
        old_or_new disk/out || failures=$((failures + 1))
    done
    ((failures > 3 && failures < 12)) || fail "$failures of 12 disks were full"
    rm disk/filler
    bake b disk/out
    holds disk/out b || fail "not b once there is room"
    head -c 1M /dev/zero >disk/filler 2>/dev/null || true
    options a
    log=$("$program" bake "${options[@]}" -o beside --cache-dir disk/cache 2>&1 >/dev/null) ||
        fail "a cache without room fails a bake: $log"
    [[ $log == *W0301* ]] || fail "no W0301: $log"
    holds beside a || fail "beside a cache without room: $(sums beside)"
    echo "full disk: $failures of 12 bakes failed, none lost a file"
else
    echo "full disk: not tested, mounting is not permitted"
fi

# --- Folders that may not be written to ------------------------------------------------------------
as_user=()
((EUID)) || as_user=(setpriv --reuid 65534 --regid 65534 --clear-groups)
bake a read_only
chmod 555 read_only
chmod 755 .
if "${as_user[@]}" test -x "$program" -a -r sky.toml && ! "${as_user[@]}" test -w read_only; then
    options b
    refused 3 "${as_user[@]}" "$program" bake "${options[@]}" -o read_only
    grep -q 'E0302' log || fail "no E0302: $(cat log)"
    refused 3 "${as_user[@]}" "$program" bake "${options[@]}" -o read_only/new
    holds read_only a || fail "read-only: $(sums read_only)"
    echo "read-only folders: refused"
else
    echo "read-only folders: not tested, no user is kept from writing and can run $program"
fi
chmod 755 read_only

# --- Too little memory -----------------------------------------------------------------------------
options b
refused 2 "$program" bake "${options[@]}" -o new --max-memory 1MiB
grep -q 'E0002' log || fail "no E0002: $(cat log)"
[[ ! -e new ]] || fail "something was made"
bake a limited
options b
refused 2 "$program" bake "${options[@]}" -o limited --max-memory 1MiB
holds limited a || fail "--max-memory: $(sums limited)"
bake a limited --max-memory 1MiB || fail "what is up to date needs no memory"
bake b limited --max-memory 16GiB || fail "16 GiB are too little"
holds limited b || fail "--max-memory 16GiB: $(sums limited)"
echo "too little memory: refused before work"

# --- What a bake takes is within what it says ------------------------------------------------------
# peak_mib COMMAND...
peak_mib() {
    python3 -c 'import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)' "$@"
}
python3 -c 'import struct, sys, zlib
edge = 5000
def chunk(kind, data):
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
sys.stdout.buffer.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", edge, edge, 8, 0, 0, 0, 0))
    + chunk(b"IDAT", zlib.compress((b"\0" + b"\x80" * edge) * edge)) + chunk(b"IEND", b""))' >map.png
cloud='[noise.n.channels.Y]\ntype = "worley"\n[clouds.c]\nnoise = "n"\nextent = ["1 km", "1 km", "1 km"]'
cloud+='\ncoverage_map.file = "map.png"\n[bake.v]\nasset = "cloud_volume"\ncloud = "c"\nsize = [16, 16, 16]'
for keys in "$cloud" '[bake.transmittance]\nsize = [2048, 1024]' '[bake.transmittance]\nmax_error = 1e-4' \
    '[bake.multiple_scattering]\nmax_error = 0.05' '[bake.sky_view]\nsun_elevations = ["9 deg"]\n[bake.irradiance]' \
    '[bake.bruneton]\nsize = [256, 128, 32]\nnu_size = 16'; do
    printf 'preset = "earth"\nwavelengths = "best 4"\n%b\n' "$keys" >memory.toml
    for threads in 1 16; do
        command=("$program" bake memory.toml -o memory -q -j "$threads")
        said=$("${command[@]}" --max-memory 1KiB 2>&1 | sed -En 's/.*may need ([0-9]+).* MiB of memory.*/\1/p') || true
        peak=$(peak_mib "${command[@]}" --max-memory "$((said + 1))MiB")
        ((peak <= said)) || fail "$peak MiB taken, $said said: $keys"
        echo "memory: $peak MiB of $said with $threads threads: $keys"
        rm -r memory
    done
done

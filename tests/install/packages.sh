#!/usr/bin/env bash
# Makes the packages of a build and tries them.
#   packages.sh CPACK BUILD FOLDER --archive  lintian finds nothing in the .deb but what stands here, and
#                                             the archive runs from a folder of any name
#   packages.sh CPACK BUILD FOLDER --bare     apt installs the .deb in a bare Debian 12, where it bakes;
#                                             needs root and mmdebstrap
set -euo pipefail
cpack=$1 build=$2 folder=$3 mode=$4
skip() { echo "skipped: $1"; exit 77; }
for program in dpkg-shlibdeps file; do
    command -v $program >/dev/null || skip "there is no $program"
done
if [[ $mode == --bare ]]; then
    ((EUID == 0)) || skip "it needs root"
    command -v mmdebstrap >/dev/null || skip "it needs mmdebstrap"
fi
rm -rf "$folder"
mkdir -p "$folder"
(cd "$build" && "$cpack" -B "$folder") >"$folder/log" || { cat "$folder/log"; exit 1; }
package=$(ls "$folder"/skybake_*.deb)

# bakes HOW: `HOW COMMAND` runs a command of the package's program, in an empty folder.
bakes() {
    "$@" init mars.toml --preset mars
    "$@" bake mars.toml --only transmittance
    "$@" verify out
    "$@" init clouds.toml --preset stratocumulus
    "$@" bake clouds.toml --set bake.stratocumulus.size=[64,64,8] --certify off -o clouds
    "$@" verify clouds
    "$@" preview mars.toml --only transmittance
}

if [[ $mode == --bare ]]; then
    root=$(mktemp -d "${TMPDIR:-/tmp}/bare_root.XXXXXX")
    trap 'rm -rf --one-file-system "$root"' EXIT
    sources=/etc/apt/sources.list.d/debian.sources
    [[ -s $sources ]] || sources=/etc/apt/sources.list
    mmdebstrap --quiet --variant=apt bookworm "$root" "$sources"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    cp "$package" "$root/skybake.deb"
    chroot "$root" apt-get update -qq
    chroot "$root" apt-get install -y -qq --no-install-recommends /skybake.deb >"$folder/apt.log" 2>&1 ||
        { cat "$folder/apt.log"; exit 1; }
    in_root() {
        unshare --mount bash -c 'mount -t proc proc "$0/proc"; exec chroot "$0" "$@"' "$root" \
            /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/bin:/bin skybake "$@"
    }
    bakes in_root
    chroot "$root" apt-get purge -y -qq skybake >/dev/null 2>&1
    [[ ! -e $root/usr/bin/skybake && ! -e $root/usr/lib/skybake && ! -e $root/usr/share/skybake ]]
    exit
fi

if command -v lintian >/dev/null; then
    # The project has no mail address, and CPack calls ldconfig for any library.
    tags=bogus-mail-host,bogus-mail-host-in-debian-changelog,maintscript-calls-ldconfig
    lintian --suppress-tags "$tags" --fail-on warning --allow-root "$package"
else
    echo "lintian was not run, since it is not installed"
fi
place="$folder/any where"
mkdir "$place"
tar -xf "$folder"/skybake-*.tar.gz -C "$place"
program=$(echo "$place"/skybake-*/bin/skybake)
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
bakes "$program"

#!/usr/bin/env bash
# Tries the README's commands as somebody with a fresh Debian 12 would: makes a bare root from this
# machine's own package sources, clones HEAD into it, and runs the commands there. Needs root and
# mmdebstrap; exits with 77 where they are missing.
#   fresh_machine.sh --configure   installs the packages and configures
#   fresh_machine.sh --bake        builds as well, bakes and verifies
#   fresh_machine.sh --all         runs all tests as well
#   --keep                         leaves the root in place and says where it is
set -euo pipefail
cd "$(dirname "$0")/../.."

mode=
keep=no
for argument in "$@"; do
    case $argument in
        --configure | --bake | --all) mode=${argument#--} ;;
        --keep) keep=yes ;;
        *) mode= && break ;;
    esac
done
[[ -n $mode ]] || { echo "fresh_machine.sh --configure|--bake|--all [--keep]" >&2; exit 2; }
((EUID == 0)) || { echo "fresh_machine.sh was skipped: it needs root" >&2; exit 77; }
command -v mmdebstrap >/dev/null || { echo "fresh_machine.sh was skipped: it needs mmdebstrap" >&2; exit 77; }

# The suites of Debian alone: other sources are not part of a fresh machine.
sources=
for file in /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list; do
    if [[ -s $file ]]; then
        sources=$file
        break
    fi
done
[[ -n $sources ]] || { echo "fresh_machine.sh was skipped: no package sources of Debian" >&2; exit 77; }

root=$(mktemp -d "${TMPDIR:-/tmp}/fresh_machine.XXXXXX")
remove() {
    if [[ $keep == yes ]]; then
        echo "the root is in $root" >&2
    else
        rm -rf --one-file-system "$root"
    fi
}
trap remove EXIT

echo "making a bare Debian 12 in $root" >&2
mmdebstrap --quiet --variant=minbase bookworm "$root" "$sources"
cp /etc/resolv.conf "$root/etc/resolv.conf"
# Debian's installer names the machine; mmdebstrap does not.
printf '127.0.0.1 localhost\n127.0.1.1 %s\n' "$(hostname)" >"$root/etc/hosts"
# The root is thrown away, so dpkg need not wait until every file is on the disk.
echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
git clone --quiet --no-hardlinks . "$root/skybake"
# A network may stand behind certificates of its own, which npm has to know for the browser tests.
certificates=
if [[ -r ${NODE_EXTRA_CA_CERTS:-} ]]; then
    certificates=NODE_EXTRA_CA_CERTS=/etc/network_certificates.pem
    cp "$NODE_EXTRA_CA_CERTS" "$root/etc/network_certificates.pem"
fi

# Runs a command of the README in the root, with an environment as after a login.
as_a_stranger() {
    echo "\$ $*" >&2
    unshare --mount bash -c '
        mount --bind "$0" "$0"  # a root is the root of a file system
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"  # Slurm looks for control groups there
        mount --rbind /dev "$0/dev"
        exec chroot "$0" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 $1 \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            bash -c "cd /skybake && $2"' "$root" "$certificates" "$*"
}

# Whatever a command prints besides its own words would frighten somebody who arrived today.
without_alarms() {
    local log=$root/output.txt
    "$@" 2>&1 | tee "$log"
    if grep -inE 'warning|error:|does not exist|debconf' "$log" >&2; then
        echo "fresh_machine.sh: the lines above do not belong into a first build" >&2
        return 1
    fi
}

if [[ $mode == configure ]]; then
    without_alarms as_a_stranger ./examples/quickstart.sh --configure
    exit
fi
without_alarms as_a_stranger ./examples/quickstart.sh
[[ $mode == all ]] || exit 0
as_a_stranger ./tests/run.sh --all

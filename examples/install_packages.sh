#!/usr/bin/env bash
# Installs what skybake needs on Debian 12, as root or with sudo. Does nothing where all is there.
#   examples/install_packages.sh            to build and run
#   examples/install_packages.sh --tests    to run the tests as well; those of pages where npm is there
#   examples/install_packages.sh --browser  to run those of pages: Debian's npm has some 300 packages
#   examples/install_packages.sh --all      to run all of them: Blender, Slurm and more, some 400
set -euo pipefail

packages=(
    cmake g++ ninja-build
    fonts-dejavu-core libboost-iostreams-dev libcli11-dev libfmt-dev libfreetype-dev libhwy-dev
    libimath-dev libopenexr-dev libopenimageio-dev libopenvdb-dev libtbb-dev libtomlplusplus-dev
    libxxhash-dev nlohmann-json3-dev zlib1g-dev
)
if [[ "${1:-}" == --tests || "${1:-}" == --browser || "${1:-}" == --all ]]; then
    packages+=(
        clang-14 glslang-tools libclang-rt-14-dev libbenchmark-dev libboost-dev libglm-dev
        libgtest-dev librapidcheck-dev locales-all make openexr python3 python3-jsonschema
    )
    if command -v npm >/dev/null; then
        packages+=(chromium)
    elif [[ "$1" != --tests ]]; then
        packages+=(chromium nodejs npm)
    fi
    # What programs of others make of the files, and sweeps on a farm.
    if [[ "$1" == --all ]]; then
        packages+=(
            blender ffmpeg libopenvdb-tools munge openimageio-tools python3-openvdb slurm-wlm
        )
    fi
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ "$status" == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "install as root: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
# debconf remarks on packages that it would use to ask questions, of which there are none.
quietly() { "${as_root[@]}" "$@" >/dev/null 2> >(grep -v '^debconf: ' >&2); }
quietly apt-get update -qq
quietly apt-get install -y -qq --no-install-recommends "${missing[@]}"

#!/usr/bin/env bash
# Installs what skybake needs on Debian 12, as root or with sudo. It does nothing if all is installed.
#   examples/install_packages.sh            installs what building and running need
#   examples/install_packages.sh --tests    also for the tests of the first tier
#   examples/install_packages.sh --more     also for Clang and browsers; where npm is missing, some 300 more
#   examples/install_packages.sh --all      also for all others: Blender, Slurm and more, some 400 packages
set -euo pipefail

packages=(
    cmake g++ ninja-build
    fonts-dejavu-core libboost-iostreams-dev libcairo2-dev libcurl4-openssl-dev
    libdeflate-dev libfmt-dev libglm-dev libhwy-dev libimath-dev libnanovdb-dev libopenexr-dev
    libopenimageio-dev libopenvdb-dev libpango1.0-dev libpng-dev libtbb-dev libtomlplusplus-dev libxxhash-dev
    libzstd-dev nlohmann-json3-dev pkg-config zlib1g-dev
)
mode=${1:-}
if [[ $mode == --tests || $mode == --more || $mode == --all ]]; then
    packages+=(
        glslang-tools libboost-dev libgtest-dev librapidcheck-dev librsvg2-bin libsquish-dev locales-all make
        openexr python3 python3-jsonschema spirv-tools strace
    )
    if [[ $mode != --tests ]]; then
        packages+=(chromium clang-14 libbenchmark-dev libclang-rt-14-dev spirv-cross)
        command -v npm >/dev/null || packages+=(nodejs npm)
    fi
    # These are for tests of the files in other programs and of sweeps on a farm.
    if [[ $mode == --all ]]; then
        packages+=(
            blender buildah dpkg-dev ffmpeg fish groff imagemagick libfilament-tools libnanovdb-tools libopenvdb-tools lintian mmdebstrap
            munge nginx-light openimageio-tools povray python3-numpy python3-openvdb python3-vtk9 python3-yaml slurm-wlm xvfb zsh
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
    command -v sudo >/dev/null || { echo "these packages must be installed as root: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
# debconf warns that it lacks packages for asking questions, but there are no questions.
quietly() { "${as_root[@]}" "$@" >/dev/null 2> >(grep -v '^debconf: ' >&2); }
quietly apt-get update -qq
quietly apt-get install -y -qq --no-install-recommends "${missing[@]}"

#!/usr/bin/env bash
# From a fresh Debian 12 to the first tables: installs packages, builds, bakes examples/earth.toml.
set -euo pipefail
cd "$(dirname "$0")/.."

examples/install_packages.sh
cmake -S . -B build/quickstart -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DSKYBAKE_TESTS=OFF -DSKYBAKE_BENCHMARKS=OFF >/dev/null
cmake --build build/quickstart
build/quickstart/cli/skybake bake examples/earth.toml -o out
build/quickstart/cli/skybake verify out

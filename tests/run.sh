#!/usr/bin/env bash
# Installs what the tests need, builds and runs them all through CTest.
#   tests/run.sh          everything but the tests labelled `slow`
#   tests/run.sh --all    those too
#   tests/run.sh --hard   just the hard cases, and their table
set -euo pipefail
cd "$(dirname "$0")/.."

examples/install_packages.sh --tests
# Without line numbers, which nobody reads here and which take a twentieth of the time.
cmake --preset dev -DSKYBAKE_PRECOMPILED_HEADERS=ON \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -DNDEBUG" >/dev/null
cmake --build --preset dev
jobs=$(nproc)
case "${1:-}" in
    --all) ctest --test-dir build/dev --output-on-failure -j "$jobs" ;;
    --hard) ctest --test-dir build/dev --output-on-failure -j "$jobs" -L hard --verbose | grep -E '\[hard\]|tests passed|tests failed' ;;
    "") ctest --test-dir build/dev --output-on-failure -j "$jobs" -LE slow ;;
    *) echo "tests/run.sh [--all|--hard]" >&2; exit 2 ;;
esac

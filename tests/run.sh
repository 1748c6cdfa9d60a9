#!/usr/bin/env bash
# Installs what the tests need, builds them and runs them through CTest. At the end it prints the time
# that each label and folder took, and every test that was skipped or left out.
#   tests/run.sh          runs all tests but those labelled `slow`, with the programs that are installed
#   tests/run.sh --all    runs those too, and installs every program that a test uses
#   tests/run.sh --hard   runs only the hard cases, and prints their table
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ "${1:-}" == --all ]]; then
    examples/install_packages.sh --all
else
    examples/install_packages.sh --tests
fi
# Without line numbers, which nobody reads here and which take a twentieth of the time.
cmake --preset dev -DSKYBAKE_PRECOMPILED_HEADERS=ON -DSKYBAKE_BATCHES=ON \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -DNDEBUG" >/dev/null
cmake --build --preset dev
jobs=$(nproc)

# run OPTION...: of ctest; ends with its exit code
run() {
    local code=0
    ctest --test-dir build/dev --output-on-failure -j "$jobs" --output-junit results.xml \
        --test-output-size-passed 16384 "$@" || code=$?
    tests/summary.py build/dev build/dev/results.xml || echo "tests/summary.py failed" >&2
    return "$code"
}
case "${1:-}" in
    --all) run ;;
    --hard) ctest --test-dir build/dev --output-on-failure -j "$jobs" -L hard | grep -E '\(bound |^total |tests passed|tests failed' ;;
    "") run -LE slow ;;
    *) echo "tests/run.sh [--all|--hard]" >&2; exit 2 ;;
esac

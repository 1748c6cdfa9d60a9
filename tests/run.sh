#!/usr/bin/env bash
# Installs what the tests need, builds them and runs them through CTest. At the end it prints the time
# that each step, label and folder took, and every test that was skipped or left out.
#   tests/run.sh          runs the first tier: laws, references, hard cases and golden hashes
#   tests/run.sh --more   runs the second tier: compilers, farms, browsers, consumers, long random cases
#   tests/run.sh --all    runs all tests, the slow ones as well, and installs every program that one uses
#   tests/run.sh --hard   runs only the hard cases, and prints their table
# tests/README.md says what each tier protects.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/quickstart
jobs=$(($(nproc) + 1))  # some tests wait: for servers, disks, signals

mode=${1:-}
packages=--tests
benchmarks=OFF
filter=()
case $mode in
    "") filter=(-LE 'slow|more|browser|consumers|farm') ;;
    --more) packages=--more benchmarks=ON filter=(-L 'more|browser|consumers|farm' -LE slow) ;;
    --all) packages=--all benchmarks=ON ;;
    --hard) filter=(-L hard) ;;
    *) echo "tests/run.sh [--more|--all|--hard]" >&2; exit 2 ;;
esac

# step NAME COMMAND...: notes the seconds of the clock and of the processors for the table at the end
steps=()
step() {
    local name=$1 code=0 begin=$SECONDS before after
    shift
    before=$(processor_seconds)
    "$@" || code=$?
    after=$(processor_seconds)
    steps+=("$name" $((SECONDS - begin)) $((after - before)))
    return "$code"
}
# The seconds of processors that this shell's children have taken.
processor_seconds() {
    local fields
    read -ra fields </proc/$$/stat
    echo $(((fields[15] + fields[16]) / $(getconf CLK_TCK)))
}
configure_and_build() {
    cmake --preset quickstart -DSKYBAKE_TESTS=ON -DSKYBAKE_BENCHMARKS=$benchmarks \
        -DSKYBAKE_WARNINGS_AS_ERRORS=${CI:+ON} >/dev/null
    cmake --build $folder
}
run() {
    ctest --test-dir $folder --output-on-failure -j "$jobs" --output-junit results.xml \
        --test-output-size-passed 16384 "${filter[@]}"
}

step install examples/install_packages.sh $packages
step build configure_and_build
code=0
if [[ $mode == --hard ]]; then
    run | grep -E '\(bound |^total |tests passed|tests failed' || code=$?
else
    step test run || code=$?
    tests/summary.py $folder $folder/results.xml "${steps[@]}" || code=$?
fi
exit "$code"

#!/usr/bin/env bash
# Runs each fuzzer for the given number of seconds in all (60 by default) on its kept corpus, under
# AddressSanitizer and UndefinedBehaviorSanitizer.
#   tests/fuzz/run.sh [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/../.."

fuzzers=(recipe units setting)
seconds=$((${1:-60} / ${#fuzzers[@]}))
examples/install_packages.sh --tests
cmake --preset fuzz -DSKYBAKE_PRECOMPILED_HEADERS=ON >/dev/null
cmake --build --preset fuzz --target "${fuzzers[@]/%/_fuzzer}"
for fuzzer in "${fuzzers[@]}"; do
    found=build/fuzz/found/$fuzzer
    mkdir -p "$found"
    "build/fuzz/tests/fuzz/${fuzzer}_fuzzer" -max_total_time="$seconds" -timeout=10 \
        -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="$found/" "$found" "tests/fuzz/corpus/$fuzzer"
done

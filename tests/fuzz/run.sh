#!/usr/bin/env bash
# Runs the fuzzers side by side for half the given number of seconds (60 by default), on two cores as
# long as that in all, each on its kept corpus, under AddressSanitizer and UndefinedBehaviorSanitizer.
#   tests/fuzz/run.sh [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/../.."

fuzzers=(recipe units setting reader)
seconds=$(((${1:-60} + 1) / 2))  # 0 would have no end
examples/install_packages.sh --more
cmake --preset fuzz -DSKYBAKE_PRECOMPILED_HEADERS=ON -DSKYBAKE_BATCHES=ON >/dev/null
cmake --build --preset fuzz --target "${fuzzers[@]/%/_fuzzer}"
pids=()
for fuzzer in "${fuzzers[@]}"; do
    found=build/fuzz/found/$fuzzer
    mkdir -p "$found"
    "build/fuzz/tests/fuzz/${fuzzer}_fuzzer" -max_total_time="$seconds" -timeout=10 \
        -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="$found/" "$found" "tests/fuzz/corpus/$fuzzer" >"$found.log" 2>&1 &
    pids+=($!)
done
failed=0
for i in "${!fuzzers[@]}"; do
    log=build/fuzz/found/${fuzzers[i]}.log
    if wait "${pids[i]}"; then
        echo "${fuzzers[i]}: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") runs"
    else
        failed=1
        tail -n 60 "$log"
    fi
done
exit "$failed"

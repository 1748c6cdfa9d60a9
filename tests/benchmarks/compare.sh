#!/usr/bin/env bash
# Times the benchmarks of two builds in turns, and prints how long those of the first take over those of
# the second: medians of processor times.
#
#     tests/benchmarks/compare.sh BUILD OLDER_BUILD BENCHMARK [ROUNDS [FILTER]]
#
# BENCHMARK is a program's name, such as noise_benchmark.
set -euo pipefail
(($# >= 3)) || { sed -n '2,7s/^# \?//p' "$0"; exit 2; }
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
for ((round = 0; round < ${4:-7}; ++round)); do
    for build in "$1" "$2"; do
        side=$([[ $build == "$1" ]] && echo new || echo old)
        "$build/tests/benchmarks/$3" --benchmark_filter="${5:-.}" --benchmark_format=json \
            >"$results/$side.$round.json"
    done
done
python3 - "$results" <<'PYTHON'
import collections, json, pathlib, re, statistics, sys

times = collections.defaultdict(lambda: collections.defaultdict(list))
for file in pathlib.Path(sys.argv[1]).glob("*.json"):
    for row in json.loads(file.read_text())["benchmarks"]:
        times[row["name"]][file.name.split(".")[0]].append(row["cpu_time"])
model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
print(f"Processor: {model[1] if model else 'unknown'}\n\n| benchmark | time over that of the older build |\n|---|---|")
for name, of in times.items():
    if len(of) == 2:
        print(f"| {name} | {statistics.median(of['new']) / statistics.median(of['old']):.2f} |")
PYTHON

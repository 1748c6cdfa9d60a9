#!/usr/bin/env python3
"""Prints a job template of Open Job Description, version 2023-09: a step with the tasks of a sweep, and one that
merges them.

  skybake sweep sky.toml -o sweep --emit commands > tasks
  python3 openjd.py tasks > sweep.json && openjd check sweep.json

Workers read the file of tasks, under the path that it has here, while they run.
"""

import json
import re
import sys
from pathlib import Path

tasks = Path(sys.argv[1]).resolve()
lines = tasks.read_text().splitlines()
threads = int(re.search(r" -j (\d+) --shard \S+$", lines[0]).group(1))


def shell(script, *words):
    return {"actions": {"onRun": {"command": "sh", "args": ["-c", script, "sh", str(tasks), *words]}}}


bake = {
    "name": "Bake",
    "parameterSpace": {"taskParameterDefinitions": [{"name": "Task", "type": "INT", "range": f"1-{len(lines)}"}]},
    "hostRequirements": {"amounts": [{"name": "amount.worker.vcpu", "min": threads}]},
    "script": shell('exec sh -c "$(sed -n "$2p" "$1")"', "{{Task.Param.Task}}"),
}
merge = {
    "name": "Merge",
    "dependencies": [{"dependsOn": "Bake"}],
    "script": shell('exec sh -c "$(sed "s| -j [0-9]* --shard [0-9/]*\\$| --merge|;q" "$1")"'),
}
job = {"specificationVersion": "jobtemplate-2023-09", "name": "skybake sweep", "steps": [bake, merge]}
print(json.dumps(job, indent=2))

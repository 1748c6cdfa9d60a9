#!/usr/bin/env python3
"""Prints an Indexed Job of Kubernetes 1.24 or later that runs the tasks of a sweep in an image that has skybake.

  skybake sweep /work/sky.toml -o /work/sweep --emit commands > /work/tasks
  python3 kubernetes.py registry/skybake /work/tasks [FOLDER...] > job.json && kubectl create -f job.json

Containers see the folder of the file of tasks and each FOLDER, such as that of the recipe or of a cache, under the
paths that they have here, in the volume that the claim `skybake` names. When all are done, run the sweep again with
--merge, which writes the index.
"""

import json
import re
import sys
from pathlib import Path

image, tasks = sys.argv[1], Path(sys.argv[2]).resolve()
lines = tasks.read_text().splitlines()
threads = re.search(r" -j (\d+) --shard \S+$", lines[0]).group(1)
folders = {tasks.parent, *(Path(folder).resolve() for folder in sys.argv[3:])}
outermost = sorted(str(folder) for folder in folders if not folders & set(folder.parents))

# Kubernetes counts from 0, lines from 1; it replaces $(NAME) and $$ before the shell sees them. The image's program
# takes the place of the first word.
script = r"""
line=$((JOB_COMPLETION_INDEX + 1))
exec sh -c "$(sed -n "${line}s#^\('[^']*'\|\\.\|[^ '\\]\)*#skybake#p" "$1")"
""".replace("$(", "$$(")
container = {
    "name": "skybake",
    "image": image,
    "command": ["sh", "-c", script, "sh", str(tasks).replace("$", "$$")],
    "resources": {"requests": {"cpu": threads}},
    # A claim's folder of the same path keeps several mounts apart.
    "volumeMounts": [{"name": "work", "mountPath": folder, "subPath": folder[1:]} for folder in outermost],
}
pod = {
    "restartPolicy": "Never",
    "containers": [container],
    "volumes": [{"name": "work", "persistentVolumeClaim": {"claimName": "skybake"}}],
}
spec = {
    "completionMode": "Indexed",
    "completions": len(lines),
    "parallelism": len(lines),
    "backoffLimit": 2 * len(lines),
    "template": {"spec": pod},
}
job = {"apiVersion": "batch/v1", "kind": "Job", "metadata": {"generateName": "skybake-sweep-"}, "spec": spec}
print(json.dumps(job, indent=2))

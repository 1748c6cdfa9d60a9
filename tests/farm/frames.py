#!/usr/bin/env python3
"""Frames as an axis of a sweep, by what examples/farm/ makes of its tasks for an engine: each frame is made once, by
one task, and its texels are byte for byte those of one bake of the whole sequence.

  frames.py PROGRAM FOLDER ENGINE     ENGINE: commands, ninja, openjd, kubernetes, slurm

The jobs of OpenJD and Kubernetes are run here as their engines would: with each value of the task's parameter, and
with each index of an indexed job. Those of Slurm run on the farm that SLURM_CONF names. Ends with 77 where the engine
is not installed.
"""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

FRAMES = 6
TASKS = 4
FARM = Path(__file__).resolve().parents[2] / "examples/farm"
RECIPE = """
[noise.n]
period = 6
drift = [1, 0, 0]
[noise.n.channels.Y]
type = "alligator"
frequency = 2
[clouds.c]
noise = "n"
extent = ["1 km", "1 km", "500 m"]
period = 6
[[clouds.c.towers]]
center = [0.5, 0.4]
sigma = [0.2, 0.15]
amplitude = 1
life = [0.4, 0.2, 0.3]
born = 0.1
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [16, 16, 8]
formats = ["bin", "vdb"]
"""


def run(command, **more):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, **more).stdout


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


# --- Engines --------------------------------------------------------------------------------------


def commands_of(tasks, _):
    return [["sh", "-c", line] for line in tasks.read_text().splitlines()]


def ninja_of(tasks, folder):
    if not shutil.which("ninja"):
        skip("there is no ninja")
    file = folder / "build.ninja"
    file.write_text(run(["sh", str(FARM / "ninja.sh"), str(tasks)]))
    return [["ninja", "-f", str(file), name] for name in (*(f"task{i + 1}" for i in range(TASKS)), "index")]


def openjd_of(tasks, _):
    job = json.loads(run([sys.executable, str(FARM / "openjd.py"), str(tasks)]))
    bake, merge = job["steps"]
    assert merge["dependencies"] == [{"dependsOn": bake["name"]}]
    parameter = bake["parameterSpace"]["taskParameterDefinitions"][0]
    first, last = map(int, parameter["range"].split("-"))
    mark = "{{Task.Param." + parameter["name"] + "}}"

    def command(step, value):
        action = step["script"]["actions"]["onRun"]
        return [action["command"], *(one.replace(mark, str(value)) for one in action["args"])]

    return [*(command(bake, value) for value in range(first, last + 1)), command(merge, 0)]


def expanded(word):
    """A word of a container's command as Kubernetes hands it on: $$ is $, and an unknown $(NAME) stays."""
    assert "$(" not in word.replace("$$", ""), "Kubernetes would replace a name"
    return word.replace("$$", "$")


def kubernetes_of(tasks, _):
    spec = json.loads(run([sys.executable, str(FARM / "kubernetes.py"), "registry/skybake", str(tasks)]))["spec"]
    assert spec["completionMode"] == "Indexed"
    container = spec["template"]["spec"]["containers"][0]
    assert [mount["mountPath"] for mount in container["volumeMounts"]] == [str(tasks.parent)]
    command = [expanded(word) for word in container["command"]]
    return [["env", f"JOB_COMPLETION_INDEX={index}", *command] for index in range(spec["completions"])]


ENGINES = {"commands": commands_of, "ninja": ninja_of, "openjd": openjd_of, "kubernetes": kubernetes_of}


def variants_in(folder):
    """By folder of a variant, when its texels were written."""
    return {path.parent: path.stat().st_mtime_ns for path in folder.glob("*/c.bin")}


def run_tasks(tasks, folder, program):
    """Runs the tasks one after the other. Returns what each of them made."""
    environment = {**os.environ, "PATH": f"{Path(program).parent}:{os.environ['PATH']}"}
    made = []
    for task in tasks:
        before = variants_in(folder)
        run(task, env=environment)
        after = variants_in(folder)
        made.append(sorted(path.name for path in after if after[path] != before.get(path)))
    return made


def run_on_slurm(tasks):
    run(["bash", str(FARM / "slurm.sh"), str(tasks)])
    while run(["squeue", "--noheader"]).strip():
        time.sleep(0.2)
    jobs = run(["scontrol", "show", "job"])
    states = [word for word in jobs.split() if word.startswith("JobState=")]
    assert states == (TASKS + 1) * ["JobState=COMPLETED"], states
    assert jobs.count("Restarts=0") == TASKS + 1, "a task ran twice"


# --- Checks ---------------------------------------------------------------------------------------


def faults_of(folder, home):
    """What is wrong with the frames of a sweep, in words."""
    faults = []
    rows = [json.loads(line) for line in (folder / "index.jsonl").read_text().splitlines()]
    frames = sorted(row["values"]["bake.c.frame"] for row in rows)
    if frames != list(range(1, FRAMES + 1)):
        faults.append(f"the index has frames {frames}")
    names = sorted(path.name for path in folder.glob("*_frame=*"))
    if names != sorted(row["name"] for row in rows):
        faults.append(f"the folders are {names}")
    whole = {asset["name"]: asset for asset in json.loads((home / "manifest.json").read_text())["assets"]}
    for row in rows:
        frame = row["values"]["bake.c.frame"]
        name = f"c_{frame:04}"
        variant = folder / row["name"]
        try:
            if (variant / "c.bin").read_bytes() != (home / f"{name}.bin").read_bytes():
                faults.append(f"frame {frame} has other bytes")
            own = json.loads((variant / "manifest.json").read_text())["assets"]
            if [asset["content_hash"] for asset in own] != [whole[name]["content_hash"]]:
                faults.append(f"frame {frame} has another hash of its content")
        except FileNotFoundError as missing:
            faults.append(f"frame {frame}: there is no {missing.filename}")
    return faults


def spoilt(folder, how):
    """A copy of a sweep in which something is wrong."""
    copy = folder.with_name(f"{folder.name}_spoilt")
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(folder, copy)
    first, second = sorted(copy.glob("*/c.bin"))[:2]
    if how == "exchanged":
        bytes_of_first = first.read_bytes()
        first.write_bytes(second.read_bytes())
        second.write_bytes(bytes_of_first)
    elif how == "zeros":
        first.write_bytes(bytes(first.stat().st_size))
    elif how == "missing":
        shutil.rmtree(first.parent)
    elif how == "twice":
        rows = (copy / "index.jsonl").read_text().splitlines()
        (copy / "index.jsonl").write_text("\n".join([rows[0], *rows]) + "\n")
    return copy


def faults_of_ninja_after_a_failure(folder, sweep):
    """A variant that cannot be made fails the merge, which still writes the index."""
    first = sorted(sweep.glob("*_frame=*"))[0]
    shutil.rmtree(first)
    first.write_text("in the way")
    (sweep / "index.jsonl").unlink()
    done = subprocess.run(["ninja", "-f", str(folder / "build.ninja")], stdout=subprocess.PIPE, text=True)
    faults = [] if done.returncode else ["ninja does not tell of a variant that failed"]
    if "FAILED: index" not in done.stdout:
        faults.append("what failed was not the merge")
    if not (sweep / "index.jsonl").exists():
        faults.append("a variant that fails keeps the index from being written")
    return faults


def main():
    program, work, engine = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).resolve(), sys.argv[3]
    folder = work / f"frames_{engine}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "moving.toml").write_text(RECIPE)
    (folder / "whole.toml").write_text(f"{RECIPE}frames = {FRAMES}\n")
    home, sweep = folder / "home", folder / "a $(HOME) $$sweep"
    run([program, "bake", str(folder / "whole.toml"), "-o", str(home), "-q"])
    arguments = [program, "sweep", str(folder / "moving.toml"), "--vary", f"bake.c.frame=1:{FRAMES}:{FRAMES}",
                 "-o", str(sweep)]
    tasks = folder / "it's $tasks"
    tasks.write_text(run([*arguments, "--emit", "commands", "--tasks", str(TASKS), "-q"]))
    if engine == "slurm":
        run_on_slurm(tasks)
    else:
        made = run_tasks(ENGINES[engine](tasks, folder), sweep, program)
        once = sorted(name for names in made for name in names)
        assert all(made[:TASKS]), f"the tasks made {made}"
        assert len(once) == FRAMES and len(set(once)) == FRAMES, f"not each frame was made once: {made}"
        if engine not in ("ninja", "openjd"):  # which merge themselves
            run([*arguments, "--merge", "-q"])
    faults = faults_of(sweep, home)
    for how in ("exchanged", "zeros", "missing", "twice"):
        if not faults_of(spoilt(sweep, how), home):
            faults.append(f"frames that are {how} pass")
    if engine == "ninja":
        faults += faults_of_ninja_after_a_failure(folder, sweep)
    if faults:
        print("\n".join(faults))
        sys.exit(1)
    print(f"{FRAMES} frames by {TASKS} tasks of {engine} are those of one bake")


main()

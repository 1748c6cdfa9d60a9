#!/usr/bin/env python3
"""Compiles each source of the product by itself, without batches and precompiled headers.

In a batch a source sees what the sources before it include and define, and may come to use it: a
name of another file is then taken for its own. usage: units_alone.py PROJECT
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def errors_of(entry):
    command = re.sub(r" -o \S+| -O[0-3]\b", "", entry["command"]) + " -fsyntax-only"
    result = subprocess.run(command, shell=True, cwd=entry["directory"], capture_output=True,
                            text=True)
    return result.stderr if result.returncode != 0 else ""


def main():
    project = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as build:
        subprocess.run(["cmake", "--preset", "dev", "-B", build, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                        "-DSKYBAKE_BATCHES=OFF", "-DSKYBAKE_PRECOMPILED_HEADERS=OFF"],
                       cwd=project, check=True, stdout=subprocess.DEVNULL)
        entries = json.loads(Path(build, "compile_commands.json").read_text(encoding="utf-8"))
        rooms = tuple(f"{project}/{room}/" for room in ("bakers", "cli", "config"))
        units = [entry for entry in entries if entry["file"].startswith(rooms)]
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            failures = [errors for errors in pool.map(errors_of, units) if errors]
    print("\n".join(failures) or f"{len(units)} sources compile by themselves")
    sys.exit(1 if failures or len(units) < 100 else 0)


main()

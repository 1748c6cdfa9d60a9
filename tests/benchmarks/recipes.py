#!/usr/bin/env python3
"""The processor time of whole recipes, by stage, beside that of a volume of noise.

    tests/benchmarks/recipes.py SKYBAKE [OTHER] [--runs N] [--only NAME ...]

Bakes every example, and a recipe for each preset of air and of clouds, on one thread with a quick
certificate. Work that is done twice shows here and in no benchmark of a kernel. Seconds depend on the
machine; their ratio to those of 256^3 voxels of noise, baked in the same run, hardly does, and has the
bars. With OTHER, an older program, both take turns, and the last column is its time over this one's.
"""

import argparse
import json
import os
import statistics
import tempfile
from pathlib import Path

from growth import noise as noise_of, resources

ROOT = Path(__file__).resolve().parents[2]
STAGES = ("light", "colors", "texels", "certificate", "write")
AIR = """preset = "{}"
[bake.multiple_scattering]
[bake.sky_view]
sun_elevations = ["20 deg", "0 deg"]"""
CLOUD = """[clouds.cloud]
preset = "{}"
[bake.volume]
asset = "cloud_volume"
cloud = "cloud"
"""
THICK = """preset = "earth_hillaire"
[atmosphere.layers.mie]
enabled = false
[atmosphere.layers.thick]
scattering = "37.5 /km"
extinction = "41.66 /km"
phase = "henyey_greenstein"
g = 0.8
profile = "exponential"
scale_height = "1.2 km"
[bake.multiple_scattering]
method = "solved"
"""
GROWN = CLOUD.format("cumulus_humilis") + "size = [{}, {}, {}]\n"
LARGE = "1024 x 1024 x 256 voxels of a grown cloud"
# Times over that of the noise.
BARS = {"earth": 3.8, "sky": 9.4, "phase": 5.7, "optical_depth": 0.94, "earth_maritime": 4.7,
        "haze of depth 50": 7.5, LARGE: 4.7}


def recipes():
    """Every recipe by its name: its text, and the folder that its files lie in."""
    examples, presets = ROOT / "examples", ROOT / "config" / "presets"
    found = {file.stem: (file.read_text(), examples) for file in sorted(examples.glob("*.toml"))}
    found |= {file.stem: (AIR.format(file.stem), examples) for file in sorted(presets.glob("*.toml"))
              if file.stem not in found}
    found |= {file.stem: (CLOUD.format(file.stem), examples)
              for file in sorted((presets / "clouds").glob("*.toml"))}
    return found | {"haze of depth 50": (THICK, examples), LARGE: (GROWN.format(1024, 1024, 256), examples)}


def bake(program, text, folder, *options, cache=""):
    """The processor time of a bake in a folder in which nothing was baked, and of its stages."""
    with tempfile.TemporaryDirectory() as output, tempfile.TemporaryFile("w+") as recipe:
        recipe.write(text)
        recipe.seek(0)
        usage = resources([program, "bake", "-", "-o", output, "-q", "-j", "1", "--diagnostics", "short", *options],
                          cwd=folder, env={**os.environ, "SKYBAKE_CACHE_DIR": cache}, stdin=recipe)
        assets = json.loads((Path(output) / "manifest.json").read_text())["assets"]
    stages = [sum(asset["timing"].get(f"{stage}_s", 0) for asset in assets) for stage in STAGES]
    return usage.ru_utime, stages


def bake_of_grown(program, text, folder):
    """The same without the time in which the cloud grows, by a cache that a smaller cloud has left."""
    with tempfile.TemporaryDirectory() as cache:
        bake(program, GROWN.format(64, 64, 16), folder, cache=cache)
        return bake(program, text, folder, cache=cache)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("skybake", type=os.path.abspath)
    parser.add_argument("other", nargs="?", type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", action="append")
    options = parser.parse_args()
    rows = {name: row for name, row in recipes().items() if not options.only or name in options.only}
    print(f"| recipe | s | {' | '.join(STAGES)} | over noise | bar |{' older over this |' if options.other else ''}")
    print("|---" * (len(STAGES) + 4 + bool(options.other)) + "|")
    for name, (text, folder) in rows.items():
        ours, noise, theirs = [], [], []
        measure = bake_of_grown if name == LARGE else bake
        for _ in range(options.runs):
            noise.append(bake(options.skybake, noise_of(256), folder, "--certify", "off")[0])
            ours.append(measure(options.skybake, text, folder))
            theirs += [measure(options.other, text, folder)[0]] if options.other else []
        seconds = statistics.median(run[0] for run in ours)
        stages = (f"{statistics.median(run[1][i] for run in ours):.2f}" for i in range(len(STAGES)))
        ratio = seconds / statistics.median(noise)
        before = f" {statistics.median(theirs) / seconds:.2f} |" if theirs else ""
        print(f"| {name} | {seconds:.2f} | {' | '.join(stages)} | {ratio:.1f} | {BARS.get(name, '')} |{before}",
              flush=True)


if __name__ == "__main__":
    main()

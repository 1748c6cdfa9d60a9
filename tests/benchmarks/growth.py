#!/usr/bin/env python3
"""How the time of a bake grows with what a recipe asks for.

    tests/benchmarks/growth.py SKYBAKE [--plot FILE.png] [--runs N] [--only NAME ...]

Each series bakes a recipe in which one number rises by steps. The table shows the median of the
processor time of each step, and the exponent of the power law through the last two: 1 where twice
as much takes twice as long. Baking nothing takes some hundredths of a second, which flattens the
first steps. The plot needs Python's matplotlib.
"""

import argparse
import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def layered_air(count, profile):
    """An Earth whose haze is split into `count` layers, each as `profile` writes it."""
    layers = [f"""
[atmosphere.layers.haze_{i}]
scattering = "{0.004 / count} /km"
extinction = "{0.0044 / count} /km"
phase = "henyey_greenstein"
g = {0.6 + 0.2 * i / count}
{profile(i)}""" for i in range(count)]
    return "\n".join(["""preset = "earth_bruneton"
[atmosphere.layers.mie]
enabled = false""", *layers, """
[bake.multiple_scattering]
method = "solved"
size = [32, 32]"""])


def exponential(i):
    return f'profile = "exponential"\nscale_height = "{1.2 + 0.05 * i} km"'


def jagged(count):
    """A profile of `count` altitudes that no smooth curve passes through."""
    rows = ", ".join(f'["{20.0 * i / count} km", {math.exp(-i * 16.0 / count) * (1 + 0.5 * (i % 2))}]'
                     for i in range(count))
    return f'profile = "tabulated"\ntable = [{rows}]'


def noise(edge):
    return f"""[noise.shape]
preset = "nubis_shape"
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [{edge}, {edge}, {edge}]
pixel_type = "half"
formats = ["bin"]"""


def cloud(edge):
    return f"""[clouds.layer]
preset = "stratocumulus"
[bake.layer]
asset = "cloud_volume"
cloud = "layer"
size = [{edge}, {edge}, {edge}]
pixel_type = "half"
formats = ["vdb"]"""


TABLE = """preset = "earth_bruneton"
[bake.transmittance]
size = [8, 8]"""


def resources(command, **options):
    """What a run of skybake took."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **options)
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"skybake ended with {process.returncode}:\n{said}")
    return usage


class Bench:
    """Runs skybake in folders of its own."""

    def __init__(self, skybake, folder):
        self.skybake = skybake
        self.folder = Path(folder)
        self.count = 0

    def seconds(self, recipe, command="bake", *options):
        """The processor time of one run, in a folder in which nothing was baked."""
        self.count += 1
        output = self.folder / str(self.count)
        file = self.folder / "recipe.toml"
        file.write_text(recipe)
        usage = resources([self.skybake, command, file, "-o", output, "-q", "--certify", "off", "-j", "1",
                           "--diagnostics", "short", *options])
        return usage.ru_utime + usage.ru_stime

    def sweep(self, variants, *options):
        return self.seconds(TABLE, "sweep", "--vary", f"atmosphere.ground_albedo=0:1:{variants}", *options)

    def cached(self, entries):
        """A bake whose asset is one of `entries` in a cache."""
        cache = self.folder / f"cache_{entries}"
        if not cache.exists():
            self.sweep(entries, "--cache-dir", str(cache))
        return self.seconds(TABLE + "\n[atmosphere]\nground_albedo = 0", "bake", "--cache-dir", str(cache))


def series(bench):
    """Every series by its name: what rises, its steps, and the time of a step."""
    return {
        "layers of air": ((1, 2, 4, 8, 16), lambda n: bench.seconds(layered_air(n, exponential))),
        "altitudes of a jagged profile": (
            (8, 16, 32, 64), lambda n: bench.seconds(layered_air(1, lambda _: jagged(n)))),
        "voxels of noise": ((32**3, 64**3, 128**3, 256**3), lambda n: bench.seconds(noise(round(n ** (1 / 3))))),
        "voxels of a cloud": ((64**3, 128**3, 256**3), lambda n: bench.seconds(cloud(round(n ** (1 / 3))))),
        "variants of a sweep": ((16, 64, 256, 1024), bench.sweep),
        "entries of a cache": ((16, 64, 256, 1024), bench.cached),
    }


def measure(chosen, runs):
    """Medians by series and step; the runs of all steps take turns."""
    times = {name: [[] for _ in steps] for name, (steps, _) in chosen.items()}
    for _ in range(runs):
        for name, (steps, run) in chosen.items():
            for i, step in enumerate(steps):
                times[name][i].append(run(step))
    return {name: [statistics.median(of_step) for of_step in of_series] for name, of_series in times.items()}


def exponent(steps, seconds):
    return math.log(seconds[-1] / seconds[-2]) / math.log(steps[-1] / steps[-2])


def print_table(chosen, medians):
    print("| what rises | its steps | processor time | exponent |\n|---|---|---|---|")
    for name, (steps, _) in chosen.items():
        print(f"| {name} | {', '.join(map(str, steps))} | {', '.join(f'{s:.3g}' for s in medians[name])} s "
              f"| {exponent(steps, medians[name]):.2f} |")


def plot(chosen, medians, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(8, 5), dpi=110)
    for name, (steps, _) in chosen.items():
        ratios = [step / steps[0] for step in steps]
        axes.loglog(ratios, [s / medians[name][0] for s in medians[name]], marker="o",
                    label=f"{name} ({exponent(steps, medians[name]):.2f})")
    axes.loglog([1, 1000], [1, 1000], color="grey", linestyle=":", label="in proportion (1.00)")
    axes.set_xlabel("times as much as in the first step")
    axes.set_ylabel("times the processor time of the first step")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("skybake")
    parser.add_argument("--plot", metavar="FILE")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", action="append")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        chosen = {name: row for name, row in series(Bench(options.skybake, folder)).items()
                  if not options.only or name in options.only}
        medians = measure(chosen, options.runs)
    print_table(chosen, medians)
    if options.plot:
        plot(chosen, medians, options.plot)


if __name__ == "__main__":
    main()

"""Runs `skybake report` on a small recipe and reads all that it writes with independent parsers."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

RECIPE = """
preset = "earth_hillaire"
[bake.air]
asset = "transmittance"
size = [16, 8]
[bake."light_2"]
asset = "multiple_scattering"
mapping = "hillaire"
size = [4, 4]
[noise.cells]
seed = 5
size = [16, 16, 8]
channels.R = {type = "worley", frequency = 2, octaves = 2, gain = 0.5}
channels.G = {type = "perlin", frequency = 2, octaves = 3, gain = 0.5}
channels.B = {type = "constant", value = 0.5}
[bake.cells]
asset = "noise_volume"
noise = "cells"
formats = ["exr", "vdb", "bin"]
"""


def report(program, folder, *options):
    command = [program, "report", str(folder / "small.toml"), "--quick", "-o", str(folder / "out")]
    return subprocess.run(command + list(options), capture_output=True, text=True)


def check_svg(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg", root.tag
    for extent in ("width", "height"):
        assert float(root.get(extent).removesuffix("px")) > 100, root.attrib
    for element in root.iter():
        for name, value in element.attrib.items():
            assert "nan" not in value and "inf" not in value, (path, name, value)


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "small.toml").write_text(RECIPE)

        run = report(program, folder)
        assert run.returncode == 0, run.stderr
        assert "baseline: Hillaire 2020" in run.stdout and "this recipe" in run.stdout, run.stdout
        assert "16x16x8" in run.stdout, run.stdout
        out = folder / "out"
        assert sorted(path.name for path in out.iterdir()) == [
            "air.svg", "cells.svg", "light_2.svg", "report.csv", "report.json"]
        for path in out.iterdir():
            assert str(path) in run.stderr, run.stderr
        for path in out.glob("*.svg"):
            check_svg(path)
        with open(out / "report.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        assets = json.loads((out / "report.json").read_text())["assets"]
        assert [asset["name"] for asset in assets] == ["air", "light_2", "cells"]
        assert len(rows) == sum(len(asset["rows"]) for asset in assets)
        for row in rows:
            assert None not in row and None not in row.values(), row
            assert float(row["time_ms"]) > 0 and float(row["lookup_error_rms"]) >= 0, row
            assert (int(row["depth"]) > 1) == (row["asset"] == "cells"), row
            assert float(row["write_ms"]) > 0, row
        for row in rows[:4]:
            milliseconds = float(row["time_ms"])
            decimals = 2 if milliseconds < 10 else 1 if milliseconds < 100 else 0
            assert f" {milliseconds:.{decimals}f} ms " in run.stdout, (row["time_ms"], run.stdout)

        run = report(program, folder, "--only", "air", "--json")
        assert [asset["name"] for asset in json.loads(run.stdout)["assets"]] == ["air"]
        run = report(program, folder, "--only", "air", "--csv")
        assert len(list(csv.DictReader(run.stdout.splitlines()))) == len(assets[0]["rows"])

        assert report(program, folder, "--json", "--csv").returncode == 2
        assert report(program, folder, "--only", "water").returncode == 2
        assert report(program, folder, "-j", "none").returncode == 2
        assert report(program, folder, "-o", str(folder / "small.toml")).returncode == 3
        # Accounts of farms have neither a home nor settings of fonts; no library may complain.
        plot = (out / "air.svg").stat().st_mtime_ns
        bare = subprocess.run([program, "report", str(folder / "small.toml"), "--quick", "-q",
                               "--only", "air", "-o", str(out)],
                              capture_output=True, text=True,
                              env={"FONTCONFIG_FILE": "/nowhere"})
        assert bare.returncode == 0, bare.stderr
        assert bare.stderr.startswith("warning[W0203]: 3 octaves are too fine"), bare.stderr
        assert bare.stderr.endswith("\n1 warning\n") and len(bare.stderr.splitlines()) == 6, bare.stderr
        assert (out / "air.svg").stat().st_mtime_ns > plot
        check_svg(out / "air.svg")
        (out / "air.svg").write_text("drawn by hand")
        assert report(program, folder).returncode == 3
        assert (out / "air.svg").read_text() == "drawn by hand"
        assert report(program, folder, "--only", "air", "--force").returncode == 0


main()

"""Runs `skybake report` on a small recipe and reads all that it writes with independent parsers."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

RECIPE = """
preset = "earth"
[bake.air]
asset = "transmittance"
size = [16, 8]
[bake."light_2"]
asset = "multiple_scattering"
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
    assert float(root.get("width")) > 0 and float(root.get("height")) > 0
    for element in root.iter():
        for name, value in element.attrib.items():
            assert "nan" not in value and "inf" not in value, (path, name, value)


def check_volume(asset, table):
    assert asset["seam_error"] == 0 and len(asset["statistics"]) == 3, asset
    for channel in asset["statistics"]:
        assert channel["min"] <= channel["mean"] <= channel["max"], channel
    assert "B: 0.5000 to 0.5000, mean 0.5000" in table, table
    assert "16x16x8" in table, table
    rows = asset["rows"]
    own = [(row["format"], row["compression"]) for row in rows if row["of_recipe"]]
    assert own == [("exr", "zip"), ("vdb", "blosc"), ("bin", "none")], own
    assert {row["compression"] for row in rows if row["format"] == "exr"} == {
        "none", "zip", "zips", "piz"}
    assert {row["pixel_type"] for row in rows} == {"float", "half", "unorm8", "unorm16"}
    assert {"1 of 3 octaves", "2 of 3 octaves"} <= {row["variant"] for row in rows}
    for row in rows:
        if row["format"] == "bin":
            voxel = 3 * {"float": 4, "half": 2, "unorm16": 2, "unorm8": 1}[row["pixel_type"]]
            assert row["file_bytes"] == voxel * row["width"] * row["height"] * row["depth"], row


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "small.toml").write_text(RECIPE)

        run = report(program, folder)
        assert run.returncode == 0, run.stderr
        assert "baseline: Hillaire 2020" in run.stdout and "this recipe" in run.stdout, run.stdout
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
            is_volume = row["asset"] == "cells"
            assert (row["depth"] != "") == is_volume and (row["write_ms"] != "") == is_volume, row
        check_volume(assets[2], run.stdout)

        run = report(program, folder, "--only", "air", "--json")
        assert [asset["name"] for asset in json.loads(run.stdout)["assets"]] == ["air"]
        run = report(program, folder, "--only", "air", "--csv")
        assert len(list(csv.DictReader(run.stdout.splitlines()))) == len(assets[0]["rows"])

        assert report(program, folder, "--json", "--csv").returncode == 2
        assert report(program, folder, "--only", "water").returncode == 2
        assert report(program, folder, "-j", "none").returncode == 2
        assert report(program, folder, "-o", str(folder / "small.toml")).returncode == 3
        (out / "air.svg").write_text("drawn by hand")
        assert report(program, folder).returncode == 3
        assert (out / "air.svg").read_text() == "drawn by hand"
        assert report(program, folder, "--only", "air", "--force").returncode == 0


main()

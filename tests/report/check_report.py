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
            "air.svg", "light_2.svg", "report.csv", "report.json"]
        for path in out.iterdir():
            assert str(path) in run.stderr, run.stderr
        for path in out.glob("*.svg"):
            check_svg(path)
        with open(out / "report.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        assets = json.loads((out / "report.json").read_text())["assets"]
        assert [asset["name"] for asset in assets] == ["air", "light_2"]
        assert len(rows) == sum(len(asset["rows"]) for asset in assets)
        for row in rows:
            assert None not in row and None not in row.values(), row
            assert float(row["time_ms"]) > 0 and float(row["lookup_error_rms"]) >= 0, row

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

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
method = "converged"
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
    assert {row["pixel_type"] for row in rows} == {
        "float", "half", "unorm8", "unorm16", "bc6h", "fp16", "fp8"}
    assert {"1 of 3 octaves", "2 of 3 octaves"} <= {row["variant"] for row in rows}
    for row in rows:
        if row["format"] == "bin":
            voxel = 3 * {"float": 4, "half": 2, "unorm16": 2, "unorm8": 1}[row["pixel_type"]]
            assert row["file_bytes"] == voxel * row["width"] * row["height"] * row["depth"], row


def check_truth(program, folder):
    """The sky against path tracing: what it writes, and that truth is taken from the cache."""
    cache = folder / "cache"
    few = ["--truth", "--truth-paths", "64", "--cache-dir", str(cache), "-o", str(folder / "sky")]
    run = report(program, folder, *few)
    assert run.returncode == 0, run.stderr
    assert "baseline: Hillaire 2020" in run.stdout and "degree 8" in run.stdout, run.stdout
    sky = folder / "sky"
    result = json.loads((sky / "sky_error.json").read_text())
    methods = [row["method"] for row in result["rows"]]
    assert result["mean_paths"] == 64 and result["directions"] == 178, result
    pictures = sorted(f"sky_error_{method}.png" for method in methods[:-1])
    assert sorted(path.name for path in sky.iterdir()) == sorted(
        pictures + ["sky_error.csv", "sky_error.json", "sky_error.svg", "sky_truth.csv"])
    check_svg(sky / "sky_error.svg")
    with open(sky / "sky_error.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["method"] for row in rows] == methods + ["truth"], rows
    for row, entry in zip(rows, result["rows"]):
        assert None not in row and None not in row.values(), row
        assert float(row["error_median"]) == entry["error"]["median"] > 0, row
    (kept,) = cache.rglob("*.csv")
    truth = (sky / "sky_truth.csv").read_bytes()
    assert kept.read_bytes() == truth

    kept.write_bytes(truth[:-1])
    (sky / "sky_truth.csv").unlink()
    # The ladder: six steps, each with a sentence and, for this Earth of papers, a size.
    names = ["colour", "air", "profile", "polarisation", "closure", "table"]
    assert [step["step"] for step in result["ladder"]] == names, result["ladder"]
    for step in result["ladder"]:
        assert 0 < step["typical"] <= step["high"] < 10, step
        assert step["sentence"].endswith("."), step
        (line,) = [line for line in run.stdout.splitlines() if step["sentence"] in line]
        assert line.split()[0] == step["step"], line
        assert abs(float(line.split()[2]) - 100 * step["high"]) <= 0.5, line

    run = report(program, folder, *few, "--json")
    assert run.returncode == 0 and json.loads(run.stdout)["directions"] == 178, run.stderr
    assert kept.read_bytes() == truth == (sky / "sky_truth.csv").read_bytes()

    assert report(program, folder, *few, "--only", "air").returncode == 2
    for paths in ["0", "15", "-1", "1e6", "many", "1000000001"]:
        assert report(program, folder, "--truth", "--truth-paths", paths).returncode == 2, paths
    assert report(program, folder, "--truth-paths", "64").returncode == 2
    (folder / "cells.toml").write_text(RECIPE[RECIPE.index("[noise"):])
    cells = subprocess.run([program, "report", "--truth", str(folder / "cells.toml")],
                           capture_output=True, text=True, cwd=folder)
    assert cells.returncode == 2 and "E0105" in cells.stderr, cells.stderr
    (sky / "sky_truth.csv").write_text("h,sun\n")
    assert report(program, folder, *few).returncode == 3


def check_colors(program, folder):
    """Wavelengths and ways of using them, by their colours and times."""
    out = folder / "colours"
    run = report(program, folder, "--colors", "-o", str(out))
    assert run.returncode == 0, run.stderr
    assert sorted(path.name for path in out.iterdir()) == [
        "color_error.csv", "color_error.json", "color_error.svg"]
    check_svg(out / "color_error.svg")
    result = json.loads((out / "color_error.json").read_text())
    assert result["space"] == "linear_srgb", result
    with open(out / "color_error.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(result["rows"]) >= 12, rows
    for row, entry in zip(rows, result["rows"]):
        assert None not in row and None not in row.values(), row
        assert float(row["error_p90"]) == entry["error"]["p90"] > 0, row
        assert int(row["wavelengths"]) == len(entry["wavelengths_nm"]), row
        assert float(row["time_ms"]) > 0 and row["variant"] in run.stdout, row
    error = {(row["family"], row["variant"]): float(row["error_median"]) for row in rows}
    plain = error["as R, G, B", "680, 550, 440 nm"]
    assert plain > 5 * error["fitted matrix", "best 4"] > 5 * error["fitted matrix", "best 8"]
    assert error["linear spectrum", "best 4"] > error["fitted matrix", "best 4"]
    again = report(program, folder, "--colors", "-o", str(out), "--csv")
    assert again.returncode == 0 and again.stdout.startswith("way,family,"), again.stderr
    assert report(program, folder, "--colors", "--truth").returncode == 2
    assert report(program, folder, "--colors", "--only", "air").returncode == 2
    (out / "color_error.csv").write_text("h,sun\n")
    assert report(program, folder, "--colors", "-o", str(out)).returncode == 3


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
        check_truth(program, folder)
        check_colors(program, folder)
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

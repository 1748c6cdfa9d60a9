"""Runs `skybake plan` on a small scene and reads all that it writes with independent parsers."""

import base64
import csv
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import jsonschema
except ImportError:
    jsonschema = None

SCENE = """
preset = "earth_hillaire"
[scene]
suns = ["40 deg"]
sky_by = ["picture"]
"""

CLOUD = """
[clouds.small]
preset = "cumulus_humilis"
extent = ["1.5 km", "1.5 km", "0.75 km"]
[clouds.small.convection]
cells = [16, 16, 8]
patches = 4
[bake.small]
asset = "cloud_volume"
cloud = "small"
size = [32, 32, 16]
"""


def images_of(page):
    """The pictures of a page, by the names under which its script looks for them."""
    found = re.findall(r'data-file="([^"]+)"[^>]*src="data:image/png;base64,([^"]*)"', page)
    assert len(dict(found)) == len(found), [name for name, _ in found]
    return {name: base64.b64decode(image) for name, image in found}


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.toml").write_text(SCENE)

        def plan(*options, text=None):
            return subprocess.run([program, "plan", *options, "--cache-dir", str(folder / "cache")],
                                  capture_output=True, text=True, cwd=folder, input=text)

        run = plan("scene.toml", "--write", "planned.toml")
        assert run.returncode == 0, run.stderr
        out = folder / "plan"
        assert sorted(path.name for path in out.iterdir()) == ["index.html", "plan.csv", "plan.json", "plan.png", "plan.svg"]
        for path in [*out.iterdir(), folder / "planned.toml"]:
            assert path.name in run.stderr, run.stderr
        root = xml.etree.ElementTree.parse(out / "plan.svg").getroot()
        assert root.tag == "{http://www.w3.org/2000/svg}svg", root.tag
        with open(out / "plan.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        result = json.loads((out / "plan.json").read_text())
        assert [plan["subject"] for plan in result["subjects"]] == ["sky"]
        sky = result["subjects"][0]
        assert len(rows) == len(sky["ways"]) == 3, rows
        chosen = [row["chosen"] for row in rows].index("true")
        assert sky["chosen"] == chosen and rows[chosen]["variant"] in run.stdout, run.stdout
        for row, way in zip(rows, sky["ways"]):
            assert None not in row and None not in row.values(), row
            assert 0 < float(row["median"]) <= float(row["p90"]) == way["p90"] < 1, row

        # It is as its schema says, and another text is not.
        schema = json.loads(subprocess.run([program, "schema", "plan"], capture_output=True, check=True).stdout)
        if jsonschema:
            jsonschema.Draft202012Validator.check_schema(schema)
            jsonschema.validate(result, schema)
            assert not jsonschema.Draft202012Validator(schema).is_valid({**result, "subjects": [{**sky, "knee": -1}]})

        # The page has the chart, the pictures and all ways, the least error first.
        page = (out / "index.html").read_text()
        data = json.loads(re.search(r'id="preview">(.*?)</script>', page, re.DOTALL)[1])
        [table] = data["tables"]
        errors = [line["cells"][1]["value"] for line in table["rows"]]
        assert errors == sorted(float(f"{way['p90']:.2g}") for way in sky["ways"]), errors
        assert [line["cells"][7]["text"] for line in table["rows"]].count("chosen") == 1
        assert [picture["name"] for picture in table["pictures"]] == ["plan_chart", "plan"]
        image = images_of(page)["plan.png"]
        assert image == (out / "plan.png").read_bytes()
        assert (table["pictures"][1]["width"], table["pictures"][1]["height"]) == struct.unpack(">II", image[16:24])

        # The planned recipe is one, and bakes what was planned.
        bake = subprocess.run([program, "bake", "planned.toml", "-o", "baked", "--certify=off"],
                              capture_output=True, text=True, cwd=folder)
        assert bake.returncode == 0, bake.stderr
        asset = json.loads((folder / "baked" / "manifest.json").read_text())["assets"][0]
        assert asset["kind"] == "sky_view", asset
        size = sky["ways"][chosen]["assets"]["sky_view"]["size"]
        assert asset["size"] == size, (asset["size"], size)

        # Figures are kept, standard input is read once, and choices are limited.
        again = plan("-", "--json", "--force", text=SCENE)
        assert again.returncode == 0 and json.loads(again.stdout) == result, again.stderr
        small = plan("scene.toml", "--max-size", "50KiB", "--csv")
        row = next(row for row in csv.DictReader(small.stdout.splitlines()) if row["chosen"] == "true")
        assert float(row["bytes"]) <= 50 * 1024, row
        shares = [json.loads(plan("scene.toml", "--max-sky-error", share, "--json").stdout)["subjects"][0]["limits"]["error"]
                  for share in ("95.7%", "0.957")]
        assert shares == [0.957, 0.957], shares
        none = plan("scene.toml", "--max-sky-error", "0.0001%", "--write", "none.toml")
        assert none.returncode == 4 and "E0408" in none.stderr, none.stderr
        assert not (folder / "none.toml").exists()

        # A cloud is planned beside the sky, and one recipe bakes both.
        (folder / "both.toml").write_text(SCENE + CLOUD)
        both = plan("both.toml", "-o", "both", "--write", "both_planned.toml")
        assert both.returncode == 0, both.stderr
        subjects = json.loads((folder / "both/plan.json").read_text())["subjects"]
        assert [plan["subject"] for plan in subjects] == ["sky", "clouds.small"], subjects
        assert (folder / "both/plan_small.svg").exists() and (folder / "both/plan_small.png").exists()
        images = images_of((folder / "both/index.html").read_text())
        assert sorted(images) == ["plan.png", "plan_chart.png", "plan_small.png", "plan_small_chart.png"], sorted(images)
        for name in ("plan.png", "plan_small.png"):
            assert images[name] == (folder / "both" / name).read_bytes(), name
        bake = subprocess.run([program, "bake", "both_planned.toml", "-o", "both_baked", "--certify=off"],
                              capture_output=True, text=True, cwd=folder)
        assert bake.returncode == 0, bake.stderr
        kinds = {asset["kind"] for asset in json.loads((folder / "both_baked/manifest.json").read_text())["assets"]}
        assert {"sky_view", "cloud_volume"} <= kinds, kinds

        # All that a scene may draw is planned, and one recipe bakes it.
        (folder / "all.toml").write_text(SCENE + 'draws = ["surroundings", "ground_light", "distance", "sky"]\n')
        every = plan("all.toml", "-o", "all", "--write", "all_planned.toml")
        assert every.returncode == 0, every.stderr
        result = json.loads((folder / "all/plan.json").read_text())
        words = ["sky", "distance", "ground_light", "surroundings"]
        assert [plan["subject"] for plan in result["subjects"]] == words, result
        if jsonschema:
            jsonschema.validate(result, schema)
        for word in words[1:]:
            assert (folder / f"all/{word}_plan.svg").exists(), word
            assert (folder / f"all/{word}_plan.png").exists() == (word != "ground_light"), word
        bake = subprocess.run([program, "bake", "all_planned.toml", "-o", "all_baked", "--certify=off"],
                              capture_output=True, text=True, cwd=folder)
        assert bake.returncode == 0, bake.stderr
        kinds = {asset["kind"] for asset in json.loads((folder / "all_baked/manifest.json").read_text())["assets"]}
        assert kinds == {"sky_view", "aerial_perspective", "irradiance", "environment"}, kinds

        # Nobody's file is touched.
        assert plan("scene.toml", "--write", "planned.toml").returncode == 3
        (out / "plan.csv").write_text("mine")
        assert plan("scene.toml").returncode == 3
        assert (out / "plan.csv").read_text() == "mine"
        for wrong in (["--max-sky-error", "much"], ["--max-fetches", "0"], ["--max-size", "1 lightyear"], ["--max-size", "1"],
                      ["--max-sky-error", "2"], ["--max-sky-error", "0.1 km"],
                      ["--json", "--csv"]):
            assert plan("scene.toml", *wrong).returncode == 2, wrong
        (folder / "cells.toml").write_text("format = 1\n")
        cells = plan("cells.toml", "-o", "other")
        assert cells.returncode == 2 and "E0105" in cells.stderr and "cells.toml" in cells.stderr


main()

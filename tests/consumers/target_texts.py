"""The scripts and scenes of targets whose programs do not run here are well-formed, and say where the cloud is.

They are read by other parsers than those of the programs: XML and Python by Python's own, the others by what each
format asks of names and brackets. COMMAND FOLDER bakes the assets without a target.
"""

import json
import re
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import consumer
import yaml

LOW, HIGH = (0, 0, 100), (600, 400, 300)
ONLY_CLOUDS = ("bevy", "pbrt", "unreal")  # targets that do not load the sky as well
CUBES = ("babylon", "bevy", "godot", "three", "unity")  # targets that load it as a cube


def baked(target, is_cube=False):
    """The texts of a target's sidecars, by name, and the files beside them."""
    *command, output = sys.argv[1:]
    settings = ["--set", f'target="{target}"']
    if is_cube:
        settings += ["--set", 'bake.sky.mapping="cube"', "--set", "bake.sky.size=[8, 48]"]
    elif target in ONLY_CLOUDS:
        settings = ["--set", f'bake.cloud.target="{target}"', "--only", "cloud"]
    with tempfile.TemporaryDirectory() as folder:
        consumer.output_of(*command, *settings, output, folder)
        files = [file for asset in json.loads((Path(folder) / "manifest.json").read_text())["assets"]
                 for file in asset["files"]]
        texts = {file["path"]: (Path(folder) / file["path"]).read_text() for file in files
                 if file["format"] in ("sidecar", "usda")}
        return texts, {file["path"] for file in files}


def check_brackets(failures, name, text):
    """Every bracket outside of strings and comments has its other half."""
    bare = re.sub(r'"""[\s\S]*?"""|"(\\.|[^"\\\n])*"|@[^@\n]*@|//[^\n]*', "", text)
    if not name.endswith(".rs"):
        bare = re.sub(r"'(\\.|[^'\\\n])*'|#[^\n]*", "", bare)
    open_ones = []
    for bracket in re.findall(r"[(){}\[\]]", bare):
        if bracket in "({[":
            open_ones.append(bracket)
        elif not open_ones or open_ones.pop() + bracket not in ("()", "{}", "[]"):
            failures.expect(bracket, "another one", f"a bracket of {name}")
            return
    failures.expect(open_ones, [], f"the open brackets of {name}")


def check_godot(failures, name, text, files):
    """Resources are defined before they are used, and lie beside the scene."""
    defined = set(re.findall(r'^\[(?:ext|sub)_resource .*id="(\w+)"\]$', text, re.MULTILINE))
    used = set(re.findall(r'(?:Ext|Sub)Resource\("(\w+)"\)', text))
    failures.expect(used, defined, f"the set of resources of {name}")
    for path in re.findall(r'^\[ext_resource .*path="([^"]+)"', text, re.MULTILINE):
        failures.expect(path in files, True, f"whether {path} lies beside {name}")


def check_godot_place(failures, text):
    numbers = [float(n) for n in re.search(r"Transform3D\(([^)]*)\)", text).group(1).split(",")]
    size = [float(n) for n in re.search(r"size = Vector3\(([^)]*)\)", text).group(1).split(",")]
    rows, origin = [numbers[0:3], numbers[3:6], numbers[6:9]], numbers[9:12]
    for corner, wanted in ((-0.5, LOW), (0.5, HIGH)):
        found = [sum(r * corner * s for r, s in zip(row, size)) + o for row, o in zip(rows, origin)]
        # Godot's axes are x, the file's z, and against the file's y.
        failures.expect([found[0], -found[2], found[1]], [float(w) for w in wanted], "a corner of Godot's fog")


# Unity's manual, "Text-based scene files": a file's identifier is 32 digits, and its importer is the only other part.
UNITY_IMPORTERS = {".cs": "MonoImporter", ".bin": "DefaultImporter"}


def check_unity(failures, texts, files):
    """Every file has a .meta with an identifier of its own and the importer of its ending."""
    metas = {name: yaml.safe_load(text) for name, text in texts.items() if name.endswith(".meta")}
    wanted = {file + ".meta" for file in files if file.endswith((".cs", ".bin"))}
    failures.expect(set(metas), wanted, "the set of Unity's .meta files")
    for name, meta in metas.items():
        importer = UNITY_IMPORTERS[Path(name[:-len(".meta")]).suffix]
        failures.expect(set(meta), {"fileFormatVersion", "guid", importer}, f"the set of keys of {name}")
        failures.expect(meta["fileFormatVersion"], 2, f"the version of {name}")
        failures.expect(re.fullmatch("[0-9a-f]{32}", str(meta["guid"])) is not None, True, f"whether {name} has a guid")
        failures.expect(isinstance(meta[importer]["externalObjects"], dict), True, f"whether {name} has its importer's keys")
    failures.expect(len({meta["guid"] for meta in metas.values()}), len(metas), "the number of Unity's identifiers")


def check_mitsuba(failures, name, text, files):
    scene = xml.fromstring(text)
    for string in scene.iter("string"):
        failures.expect(string.get("value") in files, True, f"whether {string.get('value')} lies beside {name}")
    if name.startswith("cloud"):
        scale, move = ([float(e.get(axis)) for axis in "xyz"] for e in (scene.find(".//scale"), scene.find(".//translate")))
        # The cube reaches from -1 to 1.
        failures.expect([m - s for s, m in zip(scale, move)], [float(l) for l in LOW], "the cube's low corner")
        failures.expect([m + s for s, m in zip(scale, move)], [float(h) for h in HIGH], "the cube's high corner")
        failures.expect(scene.find(".//float[@name='scale']").get("value"), "0.02", "the scale of Mitsuba's extinction")


def check_pbrt(failures, text, files):
    failures.expect(re.search(r'"string filename" "([^"]+)"', text).group(1) in files, True, "whether pbrt's grid is there")
    failures.expect(float(re.search(r'"float scale" (\S+)', text).group(1)), 0.02, "the scale of pbrt's medium")
    numbers = [float(n) for n in re.search(r'"point3 P" \[([^]]*)\]', text).group(1).split()]
    points = [numbers[i:i + 3] for i in range(0, 24, 3)]
    indices = [int(i) for i in re.search(r'"integer indices" \[([^]]*)\]', text).group(1).split()]
    volume = 0
    for i in range(0, 36, 3):
        a, b, c = (points[j] for j in indices[i:i + 3])
        volume += sum(a[k] * (b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3]) for k in range(3)) / 6
    # Closed, with every face outwards: light knows which side is within.
    failures.expect_near(volume, 600 * 400 * 200, 1, "the volume within pbrt's triangles")
    failures.expect((min(points), max(points)), ([float(l) for l in LOW], [float(h) for h in HIGH]), "pbrt's corners")


def main():
    failures = consumer.Failures()
    targets = ("babylon", "bevy", "blender", "godot", "houdini", "mitsuba", "omniverse", "pbrt", "three", "unity", "unreal")
    for target, is_cube in [(target, False) for target in targets] + [(target, True) for target in CUBES]:
        texts, files = baked(target, is_cube)
        failures.expect(len(texts) >= 1, True, f"whether {target} has files of its own")
        if target == "unity":
            check_unity(failures, texts, files)
        for name, text in texts.items():
            if name.endswith(".xml"):
                check_mitsuba(failures, name, text, files)
            elif name.endswith(".py"):
                compile(text, name, "exec")
            elif name.endswith((".tscn", ".tres")):
                check_godot(failures, name, text, files)
            elif not name.endswith((".js", ".meta")):  # browsers run those
                check_brackets(failures, name, text)
            if name.endswith(".tscn"):
                check_godot_place(failures, text)
            if name.endswith(".pbrt"):
                check_pbrt(failures, text, files)
            for reference in re.findall(r"@\./([^@]+)@", text) if name.endswith(".usda") else ():
                failures.expect(reference in files, True, f"whether {reference} lies beside {name}")
    failures.exit()


main()

"""The scripts and scenes of targets whose programs do not run here are well-formed, and say where the cloud is.

They are read by other parsers than those of the programs: XML and Python by Python's own, the others by what each
format asks of names and brackets. COMMAND FOLDER bakes the assets without a target.
"""

import ast
import itertools
import json
import math
import re
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import consumer
import yaml

# The direction (right, up, ahead) to the sun of targets.toml, 20 degrees high and 35 degrees to the right.
SUN = [math.sin(math.radians(35)) * math.cos(math.radians(20)), math.sin(math.radians(20)),
       math.cos(math.radians(35)) * math.cos(math.radians(20))]
LOW, HIGH = (0, 0, 100), (600, 400, 300)
CAMERAS = []  # that were found
CUBES = ("babylon", "bevy", "godot", "three", "unity")  # targets that load it as a cube


def baked(target, is_cube=False):
    """The texts of a target's sidecars, by name, and the files beside them."""
    *command, output = sys.argv[1:]
    settings = ["--set", f'target="{target}"']
    if is_cube:
        settings += ["--set", 'bake.sky.mapping="cube"', "--set", "bake.sky.size=[8, 48]"]
    elif target == "pbrt":
        settings += ["--set", "bake.sky.size=[8, 8]"]
    elif target == "bevy":
        settings += ["--set", 'bake.sky.target="none"']
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
    wanted = {file + ".meta" for file in files if file.endswith((".cs", ".bin")) and not file.startswith("moving_")}
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
    frame = scene.find("./default[@name='frame']")
    for string in scene.iter("string"):
        file = string.get("value").replace("$frame", frame.get("value") if frame is not None else "$frame")
        failures.expect(file in files, True, f"whether {file} lies beside {name}")
    if name.startswith("cloud"):
        scale, move = ([float(e.get(axis)) for axis in "xyz"] for e in (scene.find(".//scale"), scene.find(".//translate")))
        # The cube reaches from -1 to 1.
        failures.expect([m - s for s, m in zip(scale, move)], [float(l) for l in LOW], "the cube's low corner")
        failures.expect([m + s for s, m in zip(scale, move)], [float(h) for h in HIGH], "the cube's high corner")
        failures.expect(scene.find(".//float[@name='scale']").get("value"), "0.02", "the scale of Mitsuba's extinction")
    if name.startswith("sky"):
        # Light goes from the sun down, against (ahead, left, up).
        ray = [float(scene.find(".//vector[@name='direction']").get(axis)) for axis in "xyz"]
        for found, wanted in zip(ray, (-SUN[2], SUN[0], -SUN[1])):
            failures.expect_near(found, wanted, 1e-5, "the direction of Mitsuba's sunlight")


def calls(text, function):
    """The arguments of all calls of a method, as Python's parser finds them."""
    return [[ast.unparse(argument) for argument in node.args] for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == function]


def check_unreal_sky(failures, text):
    """Unreal's texture compressor looks up u = (1 + atan2(x, -y) / pi) / 2: ahead is -y, and +x is to the right of it."""
    [[_, _, rotation]] = [call for call in calls(text, "spawn_actor_from_class") if call[0] == "unreal.DirectionalLight"]
    failures.expect(rotation, "from_sun", "the rotation of Unreal's sun")
    [[forward]] = calls(text, "make_rot_from_x")
    ray = [eval(x) for x in re.fullmatch(r"unreal.Vector\((.*)\)", forward).group(1).split(",")]
    u, (right, up, ahead) = (1 + math.atan2(-ray[0], ray[1]) / math.pi) / 2, SUN
    failures.expect_near(u, 0.5 + math.atan2(right, ahead) / (2 * math.pi), 1e-6, "the azimuth of Unreal's sun")
    failures.expect_near(-ray[2], up, 1e-6, "the height of Unreal's sun")
    failures.expect([call[1] for call in calls(text, "set_editor_property") if call[0].lower() == "'cubemap'"],
                    ["texture", "texture"], "the cube of Unreal's sky")


def check_unreal(failures, name, text):
    """Unreal counts in centimetres, with y against that of a right-handed file, and volumes have the place of their file.

    Epic, "Heterogeneous Volumes in Unreal Engine" 5.4: imported transforms are applied automatically.
    """
    failures.expect(calls(text, "set_actor_scale3d"), [["unreal.Vector(100, -100, 100)"]], f"the scale of {name}")
    failures.expect(calls(text, "spawn_actor_from_class")[0][:2], ["unreal.HeterogeneousVolume", "unreal.Vector(0, 0, 0)"],
                    f"the actor of {name}")
    [[_, extinction]] = [call for call in calls(text, "set_editor_property") if call[0] == "'const_b'"]
    failures.expect_near(eval(extinction), 0.02 / 100, 1e-9, f"the extinction per centimetre of {name}")


def check_unity_sky(failures, text, is_cube):
    """Skybox/Panoramic looks up v = 1 - latitude / pi, so that the first row, v = 0, is straight down, and has +x ahead."""
    failures.expect("texels = Flipped(texels);" in text, not is_cube, "whether the rows of Unity's sky are turned")
    failures.expect('SetFloat("_Rotation", 90)' in text, not is_cube, "whether Unity's panorama is turned to +z")
    failures.expect('Shader.Find("Skybox/Cubemap")' in text, is_cube, "whether Unity's cube has the material of cubes")
    to_sun = re.search(r"LookRotation\(-new Vector3\(([^)]*)\)\)", text).group(1)
    for found, wanted in zip(to_sun.replace("f", "").split(","), SUN):
        failures.expect_near(float(found), wanted, 1e-5, "the direction of Unity's sun")


def check_camera(failures, name, at, axes, edges=(0.36, 0.2025)):
    """All corners of the cloud are in the picture, and one is at its rim. Axes go right, up and against the view."""
    shares = []
    for corner in itertools.product(*zip(LOW, HIGH)):
        across, up, back = (sum((c - p) * a for c, p, a in zip(corner, at, axis)) for axis in axes)
        failures.expect(back < 0, True, f"whether the camera of {name} has a corner before it")
        shares += [abs(across / back) / edges[0], abs(up / back) / edges[1]]
    failures.expect_near(max(shares), 1, 1e-4, f"how far the corners of the cloud are from the middle, as the camera of {name} has them")
    failures.expect(axes[1][2] > 0.9 and at[2] >= 2, True, f"whether the camera of {name} stands upright on the ground")


def rows_of(text, columns=3):
    numbers = [float(n) for n in re.findall(r"[-+.\de]+", text)]
    return [numbers[i:i + columns] for i in range(0, len(numbers), columns)]


def file_axes(v):
    """A vector of programs in which y points up, in the file's axes."""
    return [v[0], -v[2], v[1]]


def check_cameras(failures, name, text):
    """The axes of each program's camera: Godot's and Houdini's have y up, Unreal's y mirrored, and USD's are the file's."""
    if name == "cloud.tscn":
        numbers = rows_of(re.findall(r"Transform3D\(([^)]*)\)", text)[1])
        check_camera(failures, name, file_axes(numbers[3]), [file_axes(column) for column in zip(*numbers[:3])])
        failures.expect_near(math.tan(math.radians(float(re.search(r"fov = (\S+)", text)[1])) / 2), 0.2025, 1e-6, "Godot's fov")
    elif name == "cloud.houdini.py":
        *axes, at = [row[:3] for row in rows_of(re.search(r"hou\.Matrix4\(\((.*)\)\)\)", text, re.DOTALL)[1], 4)]
        check_camera(failures, name, file_axes(at), [file_axes(axis) for axis in axes])
    elif name == "cloud.usda":
        *axes, at = [row[:3] for row in rows_of(re.search(r"xformOp:transform = \((.*)\)", text)[1], 4)]
        check_camera(failures, name, at, axes)
    elif name in ("cloud.unreal.py", "cloud.blender.py"):
        pattern = r"x, y, z = \((.*)\)\nahead = \((.*)\)" if "unreal" in name else r"camera.location = \((.*)\)(?:.*\n.*\n.*Vector)\(\((.*?)\)\)"
        at, ahead = ([float(n) for n in numbers.split(",")] for numbers in re.search(pattern, text).groups())
        level = math.hypot(ahead[0], ahead[1])
        right = [ahead[1] / level, -ahead[0] / level, 0]
        up = [right[1] * ahead[2], -right[0] * ahead[2], level]
        check_camera(failures, name, at, [right, up, [-a for a in ahead]])
    else:
        return
    CAMERAS.append(name)


def check_usd_sky(failures, text):
    """UsdLux: domes are OpenEXR's maps, whose middle is at +z with +x left of it, and distant lights shine along -z.

    The intensity of a normalized distant light is what a surface that faces it receives.
    """
    rows = rows_of(re.search(r"xformOp:transform = \((.*)\)", text).group(1), 4)
    x, y, z = ([*row[:3]] for row in rows[:3])
    for found, wanted in zip(z, (-SUN[0], SUN[1], SUN[2])):
        failures.expect_near(found, wanted, 1e-5, "the direction of USD's sun")
    for a, b, wanted in ((x, x, 1), (y, y, 1), (x, y, 0), (y, z, 0), (z, x, 0)):
        failures.expect_near(sum(p * q for p, q in zip(a, b)), wanted, 1e-5, "the axes of USD's sun")
    failures.expect("bool inputs:normalize = 1" in text, True, "whether the intensity of USD's sun is an irradiance")


def check_bevy(failures, name, text):
    """Bevy's release notes: Skybox is in bevy_light from 0.19 on (pull request 22682)."""
    failures.expect("core_pipeline" in text, False, f"whether {name} looks for skyboxes where they were before Bevy 0.19")
    failures.expect("Bevy 0.19 and later" in text, True, f"whether {name} says which Bevy it needs")


def check_sequence(failures, target, texts, files):
    """A cloud that moves has one script, but for pbrt, whose scenes have no variables."""
    scripts = sorted(name for name in texts if name.startswith("moving") and not name.endswith((".meta", ".gdshaderinc")))
    wanted = 3 if target == "pbrt" else 1
    failures.expect(len(scripts), wanted, f"the number of scripts of {target} for three frames")
    frames = sorted(file for file in files if re.fullmatch(r"moving_\d{4}\.(?!pbrt)\w+", file))
    failures.expect(len(frames), 3, f"the number of frames of {target}")
    if target not in ("pbrt", "omniverse"):
        failures.expect(re.search(r"\b(3|12)\b", texts[scripts[0]]) is not None, True, f"whether {scripts[0]} plays")


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
        check_sequence(failures, target, texts, files)
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
            if name.endswith(".tscn") and "FogVolume" in text:
                check_godot_place(failures, text)
            check_cameras(failures, name, text)
            if name == "sky.usda":
                check_usd_sky(failures, text)
            if name == "sky.unreal.py":
                check_unreal_sky(failures, text)
            elif name.endswith(".unreal.py"):
                check_unreal(failures, name, text)
            if name == "sky.unity.cs":
                check_unity_sky(failures, text, is_cube)
            if name.endswith(".bevy.rs"):
                check_bevy(failures, name, text)
            if name.endswith(".pbrt") and name != "sky.pbrt":  # pbrt_sky.py reads that
                check_pbrt(failures, text, files)
            for reference in re.findall(r"@\./([^@]+)@", text) if name.endswith(".usda") else ():
                failures.expect(reference in files, True, f"whether {reference} lies beside {name}")
    failures.expect(sorted(set(CAMERAS)), [f"cloud.{end}" for end in ("blender.py", "houdini.py", "tscn", "unreal.py", "usda")], "the cameras")
    failures.exit()


main()

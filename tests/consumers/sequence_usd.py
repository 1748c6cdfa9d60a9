"""Blender imports the USD scene of a sequence: its volume is another file at each frame.

Runs itself within Blender, headless, as `blender -b --python sequence_usd.py -- SCENE.usda FRAMES`. Debian's Blender is
built without USD; then the test is skipped, and the text of the scene alone has been checked.
"""

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))


def play(bpy, scene, frames):
    if not bpy.app.build_options.usd:
        print("FACTS null")
        return
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=scene)
    volume = next(thing for thing in bpy.data.objects if thing.type == "VOLUME")
    shown = []
    for frame in range(1, frames + 1):
        bpy.context.scene.frame_set(frame)
        evaluated = volume.evaluated_get(bpy.context.evaluated_depsgraph_get())
        evaluated.data.grids.load()
        shown.append(Path(evaluated.data.grids.frame_filepath).name)
    print("FACTS " + json.dumps(shown))


def check_text(failures, text, files, frames):
    """What UsdVol's schema and the time codes of a stage ask for."""
    header = text[: text.index("def Volume")]
    for key, value in (("startTimeCode", "1"), ("endTimeCode", str(frames)), ("timeCodesPerSecond", "12"),
                       ("framesPerSecond", "12"), ("metersPerUnit", "1"), ("upAxis", '"Z"')):
        found = re.findall(rf"^    {key} = (.*)$", header, re.MULTILINE)
        failures.expect(found, [value], f"{key} of the stage")
    failures.expect(re.findall(r"extent = (.*)$", text, re.MULTILINE),
                    ["[(0, 0, 500), (1200, 1200, 1300)]"], "the extent in metres")
    samples = re.search(r"asset filePath\.timeSamples = \{(.*?)\}", text, re.DOTALL).group(1)
    found = re.findall(r"(\d+): @\./([^@]+)@,", samples)
    failures.expect(found, [(str(n), f"tower_{n:04}.vdb") for n in range(1, frames + 1)], "the time samples")
    failures.expect([name for _, name in found if name not in files], [], "samples without a file")


def main():
    import consumer

    failures = consumer.Failures()
    volumes = [volume for volume in consumer.baked_volumes() if volume.name.startswith("tower_")]
    scenes = [file["path"] for volume in volumes for file in volume.asset["files"] if file["format"] == "usda"]
    failures.expect(scenes, ["tower.usda"], "the scenes of the sequence")
    scene = volumes[0].folder / "tower.usda"
    files = {path.name for path in volumes[0].folder.iterdir()}
    check_text(failures, scene.read_text(), files, len(volumes))
    if failures.messages:
        failures.exit()
    blender = consumer.program("blender", "blender")
    text = consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                              "--", str(scene), str(len(volumes)))
    shown = json.loads(re.search(r"^FACTS (.*)$", text, re.MULTILINE).group(1))
    if shown is None:
        consumer.skip("this Blender is built without USD; the text of the scene is right")
    failures.expect(shown, [f"tower_{n + 1:04}.vdb" for n in range(len(volumes))], "the files at each frame")
    failures.exit()


try:
    import bpy
except ImportError:
    main()
else:
    scene, frames = sys.argv[sys.argv.index("--") + 1 :]
    play(bpy, scene, int(frames))

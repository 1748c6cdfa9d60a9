"""Blender plays numbered VDB files: at frame n it shows our frame n.

The files are imported by Blender's own loader, which finds the sequence by its numbers. What it shows is known by the
box around the leaves of its grid, which each frame has elsewhere.

Runs itself within Blender, headless, as `blender -b --python sequence_blender.py -- FIRST.vdb FRAMES`.
"""

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))


def play(bpy, first, frames):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    path = Path(first)
    files = sorted(path.parent.glob(re.sub(r"\d+$", "", path.stem) + "*.vdb"))
    bpy.ops.object.volume_import(filepath=first, directory=str(path.parent),
                                 files=[{"name": file.name} for file in files])
    volumes = [thing for thing in bpy.data.objects if thing.type == "VOLUME"]
    data = volumes[0].data
    facts = {"objects": len(volumes), "is_sequence": data.is_sequence, "duration": data.frame_duration,
             "start": data.frame_start, "offset": data.frame_offset, "boxes": []}
    for frame in range(1, frames + 1):
        bpy.context.scene.frame_set(frame)
        evaluated = volumes[0].evaluated_get(bpy.context.evaluated_depsgraph_get())
        evaluated.data.grids.load()
        corners = [list(corner) for corner in evaluated.bound_box]
        facts["boxes"].append([[edge(corner[axis] for corner in corners) for axis in range(3)]
                               for edge in (min, max)])
    print("FACTS " + json.dumps(facts))


def box_of(volume):
    """The lowest and highest voxels of the leaves of 8 x 8 x 8 with a voxel that is not 0."""
    width, height, _ = volume.size
    places = [(i % width, i // width % height, i // width // height)
              for i, value in enumerate(volume.voxels()[0]) if value != 0]
    return [[edge(place[axis] // 8 * 8 + inner for place in places) for axis in range(3)]
            for edge, inner in ((min, 0), (max, 7))]


def in_metres(box):
    """The middles of those voxels, of 25 m, above a base of 500 m."""
    return [[25 * (corner[axis] + 0.5) + (0, 0, 500)[axis] for axis in range(3)] for corner in box]


def distance(a, b):
    return max(abs(p - q) for low, high in zip(a, b) for p, q in zip(low, high))


def main():
    import consumer

    blender = consumer.program("blender", "blender")
    failures = consumer.Failures()
    volumes = [volume for volume in consumer.baked_volumes() if volume.name.startswith("tower_")]
    text = consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                              "--", volumes[0].path("vdb"), str(len(volumes)))
    facts = json.loads(re.search(r"^FACTS (.*)$", text, re.MULTILINE).group(1))
    failures.expect(facts["objects"], 1, "the number of volumes that Blender makes of the files")
    failures.expect(facts["is_sequence"], True, "whether Blender finds a sequence")
    failures.expect(facts["duration"], len(volumes), "the number of frames that Blender finds")
    failures.expect(facts["start"] + facts["offset"], 1, "the frame at which Blender shows the first file")
    wanted = [in_metres(box_of(volume)) for volume in volumes]
    for i, found in enumerate(facts["boxes"]):
        near = [n + 1 for n, box in enumerate(wanted) if distance(found, box) <= 1]
        failures.expect(near, [i + 1], f"our frames that look like Blender's frame {i + 1}")
    failures.exit()


try:
    import bpy
except ImportError:
    main()
else:
    first, frames = sys.argv[sys.argv.index("--") + 1 :]
    play(bpy, first, int(frames))

"""Blender lights a white, level plane with environments as their NAME.json says.

A diffuse plane of albedo 1 sends back the irradiance over pi. Blender's path tracer integrates the map with its own
weights and samples, and knows nothing of the numbers beside it. The sun's disc is in one map, and a lamp stands for
it beside the others; light is the sum of sun and sky. Each script takes away the lamp of the sky before.

Runs itself within Blender, headless, as `blender -b --python environment_blender.py -- FOLDER`.
"""

import json
import math
import sys
import tempfile
from pathlib import Path

NAMES = ("clear", "disc", "cloudy")
SIZE = 16

sys.path.insert(0, str(Path(__file__).resolve().parent))

from blender_scene import white_matt  # noqa: E402


def run(bpy, folder):
    """Renders the plane from above in the light of each map, which its sidecar loads."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1
    camera.location = (0, 0, 5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    bpy.ops.mesh.primitive_plane_add(size=100)
    bpy.context.object.data.materials.append(white_matt(bpy))
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 256
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.seed = 0
    scene.cycles.sample_clamp_indirect = 0
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    found = {}
    for name in NAMES:
        path = folder / f"{name}.blender.py"
        exec(compile(path.read_text(), str(path), "exec"), {"__file__": str(path), "__name__": "__main__"})
        scene.render.filepath = str(folder / f"{name}.plane.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels = list(image.pixels)
        found[name] = [sum(pixels[channel::4]) / SIZE**2 for channel in range(3)]
    (folder / "found.json").write_text(json.dumps(found))


def main():
    import consumer

    blender = consumer.program("blender", "blender")
    failures = consumer.Failures()
    with tempfile.TemporaryDirectory() as bare:
        folder = Path(bare)
        consumer.output_of(*sys.argv[1:], bare)
        print(consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                                 "--", bare))
        found = json.loads((folder / "found.json").read_text())
        for name in NAMES:
            lights = json.loads((folder / f"{name}.json").read_text())
            parts = zip(lights["sky"]["irradiance_of_level_surface"], lights["sun"]["irradiance_of_level_surface"])
            light = [sky + sun for sky, sun in parts]
            for channel, irradiance in enumerate(light):
                wanted = irradiance / math.pi
                print(name, "RGB"[channel], found[name][channel], wanted, found[name][channel] / wanted - 1)
                failures.expect_near(found[name][channel] / wanted, 1, 0.01,
                                     f"the plane under {name} in {'RGB'[channel]}, as a share of irradiance / pi,")
    failures.exit()


try:
    import bpy
except ImportError:
    main()
else:
    run(bpy, Path(sys.argv[sys.argv.index("--") + 1]))

"""Blender draws a cloud and its sky, by the scripts beside the files, as `skybake preview` draws them.

The scripts place the camera, the sun and the light; nothing is set by hand. Both pictures have the same curve, and
are compared above the horizon, by blocks of pixels, since a path tracer's picture is noisy. A picture without the sun,
or in which light is scattered once, is another one.

Runs itself within Blender, headless, as `blender -b --python picture_blender.py -- FOLDER SKYBAKE`.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

SIZE = (96, 54)  # of the camera
BLOCK = 4  # pixels
HORIZON = 44  # rows that are surely above it
EXPOSURE = 3  # stops


def preview(skybake, folder, camera):
    """Draws the view of Blender's camera; returns the picture's path."""
    x, y, z = camera.location
    forward = camera.matrix_world.to_quaternion() @ mathutils.Vector((0, 0, -1))
    heading, pitch = math.degrees(math.atan2(forward.y, forward.x)), math.degrees(math.asin(forward.z))
    text = (f"position={x:.1f}m,{y:.1f}m,{z:.1f}m heading={heading:.3f}deg pitch={pitch:.3f}deg "
            f"fov={math.degrees(camera.data.angle_x):.3f}deg")
    subprocess.run([skybake, "preview", folder / "cloud.vdb", "--single", "--camera", text, "--sun-elevation", "30",
                    "--sun-azimuth=-27", "--size", "x".join(map(str, SIZE)), "--tone-curve", "exponential", "--exposure",
                    str(EXPOSURE), "-o", folder / "preview", "-q"], check=True)
    return folder / "preview" / "cloud_lit_sun_30.png"


def run(bpy, folder, skybake):
    bpy.ops.wm.read_factory_settings()
    scene = bpy.context.scene
    for thing in [thing for thing in bpy.data.objects if thing.type == "MESH"]:
        bpy.data.objects.remove(thing)
    for name in ("cloud", "sky"):
        path = folder / f"{name}.blender.py"
        exec(compile(path.read_text(), str(path), "exec"), {"__file__": str(path), "__name__": "__main__"})
    for lamp in [thing for thing in bpy.data.objects if thing.type == "LIGHT" and thing.get("skybake") != "sun"]:
        bpy.data.objects.remove(lamp)  # of Blender's first scene
    scene.cycles.device = "CPU"
    scene.cycles.samples = 192
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.seed = 0
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    bpy.context.view_layer.update()
    found = {"exposure": scene.view_settings.exposure}
    pictures = {"preview": preview(skybake, folder, scene.camera)}
    for name, change in (("blender", lambda: None), ("once", lambda: once(scene)), ("sunless", lambda: without_sun(bpy))):
        change()
        pictures[name] = scene.render.filepath = str(folder / f"{name}.exr")
        bpy.ops.render.render(write_still=True)
    for name, path in pictures.items():
        image = bpy.data.images.load(str(path))
        image.colorspace_settings.name = "Non-Color"
        found[name] = list(image.pixels)
    (folder / "found.json").write_text(json.dumps(found))


def without_sun(bpy):
    bpy.context.scene.cycles.volume_bounces = 64
    bpy.data.objects.remove(next(thing for thing in bpy.data.objects if thing.get("skybake") == "sun"))


def once(scene):
    scene.cycles.volume_bounces = 0


def shown(light):
    """A share of white by the curve exponential, as sRGB."""
    linear = 1 - math.exp(-max(light, 0) * 2**EXPOSURE)
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def blocks(pixels, value_of):
    """Means over blocks of the rows from the top, of linear light; Blender's rows begin at the bottom."""
    width, height = SIZE
    means = []
    for top in range(0, HORIZON, BLOCK):
        for left in range(0, width, BLOCK):
            for channel in range(3):
                values = [value_of(pixels[4 * ((height - 1 - y) * width + x) + channel])
                          for y in range(top, top + BLOCK) for x in range(left, left + BLOCK)]
                means.append(sum(values) / len(values))
    return means


def light_of(byte):
    """The light that the curve shows so."""
    linear = byte / 12.92 if byte <= 0.04045 else ((byte + 0.055) / 1.055) ** 2.4
    return -math.log(max(1 - linear, 1e-4)) / 2**EXPOSURE


def difference(found, name):
    """The root mean square of what both show, as a share of white."""
    wanted = blocks(found["preview"], light_of)
    given = blocks(found[name], lambda light: light)
    return math.sqrt(sum((shown(a) - shown(b)) ** 2 for a, b in zip(given, wanted)) / len(wanted))


def main():
    import consumer

    blender = consumer.program("blender", "blender")
    failures = consumer.Failures()
    with tempfile.TemporaryDirectory() as bare:
        consumer.output_of(*sys.argv[1:], bare)
        print(consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                                 "--", bare, sys.argv[1]))
        found = json.loads((Path(bare) / "found.json").read_text())
    right, sunless, once_scattered = (difference(found, name) for name in ("blender", "sunless", "once"))
    print(f"RMS of white: {right:.4f}; without the sun {sunless:.4f}, scattered once {once_scattered:.4f}")
    failures.expect(right <= 0.04, True, f"whether Blender's picture is within 4 % of the preview ({right:.4f})")
    failures.expect(min(sunless, once_scattered) > 0.045, True, "whether wrong pictures differ more")
    failures.expect(0 < found["exposure"] < 4, True, f"whether the script brightens the view ({found['exposure']})")
    failures.exit()


try:
    import bpy
    import mathutils
except ImportError:
    main()
else:
    run(bpy, *map(Path, sys.argv[sys.argv.index("--") + 1:]))

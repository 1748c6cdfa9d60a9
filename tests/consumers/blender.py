"""Blender imports a VDB file and renders it: some light is scattered, some passes. It finds velocities.

Runs itself within Blender, headless, as `blender -b --python blender.py -- VDB PICTURE`.
"""

import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))


def render(bpy, vdb, picture):
    """256^2 pixels of Cycles, of the volume in the sun before a grey sky."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.object.volume_import(filepath=vdb)
    cloud = bpy.context.object
    cloud.data.grids.load()
    print("grids:", [grid.name for grid in cloud.data.grids])

    material = bpy.data.materials.new("fog")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    volume = nodes.new("ShaderNodeVolumePrincipled")
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(volume.outputs["Volume"], output.inputs["Volume"])
    cloud.data.materials.append(material)

    bpy.context.view_layer.update()
    low = [min(corner[axis] for corner in cloud.bound_box) for axis in range(3)]
    high = [max(corner[axis] for corner in cloud.bound_box) for axis in range(3)]
    extent = max(h - l for h, l in zip(high, low))
    volume.inputs["Density"].default_value = 10 / extent  # some optical depths across
    print("bounds:", low, high)

    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_end = 100 * extent
    camera.location = [(low[0] + high[0]) / 2, low[1] - 2 * extent, (low[2] + high[2]) / 2]
    camera.rotation_euler = (1.5707963, 0, 0)  # looks along +y
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("sky")
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 5
    scene.collection.objects.link(sun)

    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.cycles.seed = 0
    scene.render.resolution_x = scene.render.resolution_y = 256
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)

    image = bpy.data.images.load(picture)
    red = image.pixels[:][0::4]
    print(f"pixels: {len(red)}, of {len(set(red))} values from {min(red)} to {max(red)}")


def velocity_of(bpy, vdb):
    bpy.ops.object.volume_import(filepath=vdb)
    flow = bpy.context.object.data
    flow.grids.load()
    return flow.velocity_grid, flow.grids[flow.velocity_grid].data_type


def main():
    import consumer

    blender = consumer.program("blender", "blender")
    failures = consumer.Failures()
    volumes = consumer.baked_volumes()
    volume = volumes[0]
    flow = next(volume for volume in volumes if "velocity.x" in volume.grids())
    picture = volume.folder / "picture.png"
    text = consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1",
                              "--python", __file__, "--", volume.path("vdb"), str(picture),
                              flow.path("vdb"))
    print(text)
    velocity = ("velocity", "VECTOR_FLOAT")
    failures.expect(f"velocity: {velocity}" in text, True, "whether Blender finds the velocity")
    failures.expect(f"grids: {volume.grids()}" in text, True, "whether Blender lists the grids")
    pixels = re.search(r"^pixels: (\d+), of (\d+) values", text, re.MULTILINE)
    failures.expect(pixels is not None and int(pixels.group(1)), 256 * 256, "the number of pixels")
    values = int(pixels.group(2)) if pixels else 0
    failures.expect(values > 16, True, f"whether {values} different values are a picture")
    failures.exit()


try:
    import bpy
except ImportError:
    main()
else:
    volume_path, picture_path, flow_path = sys.argv[sys.argv.index("--") + 1 :]
    render(bpy, volume_path, picture_path)
    print("velocity:", velocity_of(bpy, flow_path))

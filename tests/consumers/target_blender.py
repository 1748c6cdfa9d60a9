"""Blender loads what its target writes by the scripts beside the files, with nothing set by hand.

The cloud stands where the recipe says, and light that falls through it is weakened as the baked densities and the
extinction say; the sky has the values of the probes, its zenith is above, and its sun over +x; the lamp lights white
planes as the irradiance of the sun does. Of a cloud that moves there is one script, by which all frames play.

Runs itself within Blender, headless, as `blender -b --python target_blender.py -- FOLDER`.
"""

import json
import math
import sys
import tempfile
from pathlib import Path

EXTINCTION = 0.02  # 1/m, as in targets.toml
VOXEL = 25  # m

sys.path.insert(0, str(Path(__file__).resolve().parent))

from blender_scene import white_matt  # noqa: E402


def rendered(bpy, folder, name, size, samples):
    """Red, green and blue of each pixel, rows from the bottom."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.cycles.seed = 0
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(folder / f"{name}.rendered.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    return list(image.pixels)


# Planes that face upwards and to all sides, as (right, up, ahead). The lamp's own direction is among the answers.
NORMALS = [[0, 1, 0], [0.6, 0.8, 0], [-0.6, 0.8, 0], [0, 0.6, 0.8], [0, 0.6, -0.8]]


def lit_planes(bpy, folder):
    """Red, green and blue of a white matt plane with each normal, under the lamp of the sky alone."""
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    bpy.ops.mesh.primitive_plane_add(size=2)
    plane = bpy.context.object
    plane.rotation_mode = scene.camera.rotation_mode = "QUATERNION"
    plane.data.materials.append(white_matt(bpy))
    scene.camera.data.ortho_scale = 0.1
    found = []
    for right, up, ahead in NORMALS:
        facing = mathutils.Vector((ahead, -right, up))
        scene.camera.location = facing
        plane.rotation_quaternion = scene.camera.rotation_quaternion = facing.to_track_quat("Z", "Y")
        found.append(rendered(bpy, folder, "plane", (1, 1), 64)[:3])
    return found


def run(bpy, folder):
    """Runs the sidecars as a user does, and writes what Blender then has and renders."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    found = {}
    for name in ("cloud", "sky"):
        path = folder / f"{name}.blender.py"
        exec(compile(path.read_text(), str(path), "exec"), {"__file__": str(path), "__name__": "__main__"})
        if name == "cloud":
            cloud = bpy.data.objects["cloud"]
            cloud.data.grids.load()
            found["grids"] = [grid.name for grid in cloud.data.grids]
            found["clip_end"] = camera.data.clip_end
            bpy.context.view_layer.update()
            found["low"] = [min(corner[axis] for corner in cloud.bound_box) for axis in range(3)]
            found["high"] = [max(corner[axis] for corner in cloud.bound_box) for axis in range(3)]
    image = scene.world.node_tree.nodes["Environment Texture"].image
    found["texels"] = list(image.pixels)

    # The sky around the camera, which looks towards +x. The cloud is out of the way.
    cloud.hide_render = True
    camera.data.type = "PANO"
    camera.data.cycles.panorama_type = "EQUIRECTANGULAR"
    camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    found["panorama"] = rendered(bpy, folder, "sky", image.size, 1)

    # Through the cloud, which now absorbs what it would scatter, onto white: down, and along y. A pixel is a voxel.
    cloud.hide_render = False
    cloud.data.materials[0].node_tree.nodes["Principled Volume"].inputs["Color"].default_value = (0, 0, 0, 1)
    world = scene.world.node_tree
    world.links.remove(next(link for link in world.links if link.to_socket.name == "Color"))
    world.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 600
    camera.rotation_euler = (0, 0, 0)
    camera.location = (300, 200, 1000)
    found["down"] = rendered(bpy, folder, "down", (24, 16), 64)[0::4]
    camera.rotation_euler = (math.pi / 2, 0, 0)
    camera.location = (300, -1000, 200)
    found["along"] = rendered(bpy, folder, "along", (24, 8), 64)[0::4]
    cloud.hide_render = True
    found["lit"] = lit_planes(bpy, folder)

    exec(compile((folder / "moving.blender.py").read_text(), "moving", "exec"),
         {"__file__": str(folder / "moving.blender.py"), "__name__": "__main__"})
    moving = bpy.data.volumes["moving"]
    found["moving"] = [moving.is_sequence, moving.frame_duration, scene.render.fps / scene.render.fps_base]
    found["volume_bounces"] = scene.cycles.volume_bounces
    found["boxes"] = []
    for frame in range(1, 5):
        scene.frame_set(frame)
        shown = bpy.data.objects["moving"].evaluated_get(bpy.context.evaluated_depsgraph_get())
        shown.data.grids.load()
        found["boxes"].append(Path(shown.data.grids.frame_filepath).name)
    (folder / "found.json").write_text(json.dumps(found))


def bilinear(texels, size, u, v):
    """Of rows from the bottom, u repeats; v runs down."""
    width, height = size
    x, y = u * width - 0.5, (1 - v) * height - 0.5
    i, j = math.floor(x), math.floor(y)

    def at(column, row):
        start = 4 * (min(max(row, 0), height - 1) * width + column % width)
        return texels[start:start + 3]

    low = [a + (b - a) * (x - i) for a, b in zip(at(i, j), at(i + 1, j))]
    high = [a + (b - a) * (x - i) for a, b in zip(at(i, j + 1), at(i + 1, j + 1))]
    return [a + (b - a) * (y - j) for a, b in zip(low, high)]


def optical_depths(voxels, size, axis):
    """Of each line of voxels along an axis, x fastest."""
    strides = (1, size[0], size[0] * size[1])
    rows, columns = [a for a in range(3) if a != axis][::-1]
    return [[EXTINCTION * VOXEL * sum(voxels[i * strides[columns] + j * strides[rows] + k * strides[axis]]
                                      for k in range(size[axis])) for i in range(size[columns])]
            for j in range(size[rows])]


def ratios(found, wanted):
    """Of pixels two voxels from the edge or more: Blender 3.4 has half a voxel less there."""
    return [f / w for fs, ws in zip(found[2:-2], wanted[2:-2]) for f, w in zip(fs[2:-2], ws[2:-2])]


def spread(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((value / mean - 1)**2 for value in values) / len(values))


def check_cloud(failures, name, found, wanted):
    """Optical depths have the scale of those baked, and their pattern, which no turned picture has."""
    right = ratios(found, wanted)
    failures.expect_near(sum(right) / len(right), 0.99, 0.03, f"the optical depths {name}, as a share of those baked")
    failures.expect_near(spread(right), 0, 0.03, f"the spread of optical depths {name}")
    for turned in ([row[::-1] for row in found], found[::-1]):
        failures.expect(spread(ratios(turned, wanted)) > 3 * spread(right), True, f"whether {name} a turned cloud differs")


def check(consumer, volumes, voxels, found):
    failures = consumer.Failures()
    cloud = next(v for v in volumes if v.name == "cloud")
    sky = next(v for v in volumes if v.name == "sky")
    failures.expect(found["grids"], cloud.grids(), "the list of grids")
    failures.expect(found["clip_end"] >= 2000, True, f"whether cameras see {found['clip_end']} m far")
    for axis, (low, high) in enumerate(((0, 600), (0, 400), (100, 300))):
        failures.expect_near(found["low"][axis], low, VOXEL, f"the low end of axis {axis}")
        failures.expect_near(found["high"][axis], high, VOXEL, f"the high end of axis {axis}")
    for probe in sky.asset["probes"]:
        values = bilinear(found["texels"], sky.size, *probe["uv"])
        for value, wanted, tolerance in zip(values, probe["value"], probe["tolerance"]):
            failures.expect_near(value, wanted, tolerance, f"the sky at {probe['uv']}")
    peak = max(found["texels"])
    for i, (value, wanted) in enumerate(zip(found["panorama"], found["texels"])):
        # A pixel is a texel but for the filter's hundredth of a pixel.
        failures.expect_near(value, wanted, 0.02 * wanted + 0.002 * peak, f"pixel {i // 4 % 64}, {i // 256} of the sky")
    sun, irradiance = sky.asset["details"]["sun_direction"], sky.asset["details"]["sun_irradiance"]
    for normal, light in zip(NORMALS, found["lit"]):
        cosine = max(0, sum(n * s for n, s in zip(normal, sun)))
        for value, full in zip(light, irradiance):
            # The sun's disc and its noise blur the edge of the light.
            failures.expect_near(value, full * cosine / math.pi, 0.01 * full, f"light on a plane that faces {normal}")
    failures.expect(found["moving"], [True, 3, 12], "what plays: a sequence, its frames and their rate")
    failures.expect(found["boxes"], [f"moving_000{n}.vdb" for n in (1, 2, 3, 1)], "the files of frames 1 to 4")
    failures.expect(found["volume_bounces"] >= 64, True, "whether Cycles follows light within clouds")
    for name, axis in (("down", 2), ("along", 1)):
        depths = [-math.log(light) for light in found[name]]
        width = cloud.size[0]
        rows = [depths[start:start + width] for start in range(0, len(depths), width)]
        check_cloud(failures, name, rows, optical_depths(voxels, cloud.size, axis))
    failures.exit()


def main():
    import consumer

    blender = consumer.program("blender", "blender")
    volumes = consumer.baked_volumes()
    folder = volumes[0].folder
    with tempfile.TemporaryDirectory() as bare:
        consumer.output_of(*sys.argv[1:4], "--only", "cloud", "--set", 'bake.cloud.formats=["bin"]', "--output", bare)
        asset = json.loads((Path(bare) / "manifest.json").read_text())["assets"][0]
        voxels = consumer.Volume(Path(bare), asset).voxels()[0]
    print(consumer.output_of(blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__,
                             "--", str(folder)))
    check(consumer, volumes, voxels, json.loads((folder / "found.json").read_text()))


try:
    import bpy
    import mathutils
except ImportError:
    main()
else:
    run(bpy, Path(sys.argv[sys.argv.index("--") + 1]))

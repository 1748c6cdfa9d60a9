"""The sky that the target pbrt writes is where pbrt-v4 looks for it, and so is its sun.

The place of a texel is computed by the formula of pbrt's own EqualAreaSquareToSphere, with z up, x straight ahead and y
to the left. The panorama of the same sky, by longitude and latitude, says what is seen there.
COMMAND FOLDER bakes the sky without a target.
"""

import json
import math
import re
import sys
import tempfile
from pathlib import Path

import consumer
from exr_file import ExrFile

SUN_ELEVATION, SUN_AZIMUTH = 20, 35  # of targets.toml, in degrees to the right of ahead


def baked(*settings):
    """Channels, width, height, and the text beside them."""
    *command, output = sys.argv[1:]
    words = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        consumer.output_of(*command, *words, output, folder)
        image, text = ExrFile(Path(folder) / "sky.exr"), Path(folder) / "sky.pbrt"
        [asset] = json.loads((Path(folder) / "manifest.json").read_text())["assets"]
        return image.planes(), image.width, image.height, text.read_text() if text.exists() else "", asset


def square_to_sphere(x, y):
    """Matt Pharr and others, pbrt-v4, util/math.cpp: a place in the unit square, y downwards, to a unit vector."""
    u, v = 2 * x - 1, 2 * y - 1
    distance = 1 - (abs(u) + abs(v))
    r = 1 - abs(distance)
    phi = ((abs(v) - abs(u)) / r + 1 if r else 1) * math.pi / 4
    level = r * math.sqrt(2 - r * r)
    return (math.copysign(math.cos(phi), u) * level, math.copysign(math.sin(phi), v) * level,
            math.copysign(1 - r * r, distance))


def panorama_at(plane, width, height, azimuth, elevation):
    column, row = (0.5 + azimuth / 360) * width - 0.5, (0.5 - elevation / 180) * height - 0.5
    left, top = math.floor(column), math.floor(row)
    texel = lambda i, j: plane[min(max(j, 0), height - 1) * width + i % width]
    mixed = lambda j: texel(left, j) + (texel(left + 1, j) - texel(left, j)) * (column - left)
    return mixed(top) + (mixed(top + 1) - mixed(top)) * (row - top)


def check_texels(failures, square, width, height, panorama):
    planes, columns, rows, *_ = panorama
    compared = 0
    for i in range(width * height):
        x, y, z = square_to_sphere((i % width + 0.5) / width, (i // width + 0.5) / height)
        azimuth, elevation = math.degrees(math.atan2(-y, x)), math.degrees(math.asin(z))
        from_sun = math.hypot((azimuth - SUN_AZIMUTH) * math.cos(math.radians(elevation)), elevation - SUN_ELEVATION)
        if abs(elevation) < 3 or from_sun < 12:
            continue  # the light of neighbours differs there
        compared += elevation > 0  # single scattering sees no ground
        for channel in "RGB":
            wanted = panorama_at(planes[channel], columns, rows, azimuth, elevation)
            failures.expect_near(square[channel][i], wanted, 0.01 * wanted, f"{channel} at {azimuth:.1f}, {elevation:.1f} degrees")
    failures.expect(compared > 0.4 * width * height, True, "whether most texels of the sky were compared")


def check_text(failures, text):
    failures.expect(re.search(r'LightSource "infinite" "string filename" "([^"]+)"', text).group(1), "sky.exr", "the image")
    scale = [float(n) for n in re.search(r"Scale (\S+) (\S+) (\S+)\n", text).groups()]
    sun = [float(n) * s for n, s in zip(re.search(r'"point3 from" \[ (.*?) \]', text).group(1).split(), scale)]
    failures.expect_near(math.degrees(math.atan2(-sun[1], sun[0])), SUN_AZIMUTH, 1e-4, "the azimuth of pbrt's sun")
    failures.expect_near(math.degrees(math.asin(sun[2])), SUN_ELEVATION, 1e-4, "the elevation of pbrt's sun")
    color = [float(n) for n in re.search(r'"rgb L" \[ (.*?) \]', text).group(1).split()]
    return [c * float(re.search(r'"float scale" (\S+)', text).group(1)) for c in color]


def main():
    failures = consumer.Failures()
    square, width, height, text, asset = baked('target="pbrt"', "bake.sky.size=[32, 32]")
    panorama = baked("bake.sky.size=[720, 360]", "bake.sky.lights=true")
    check_texels(failures, square, width, height, panorama)
    light = [float(n) for n in panorama[4]["details"]["sun_irradiance"]]
    for found, wanted in zip(check_text(failures, text), light):
        failures.expect_near(found / wanted, 1, 1e-5, "the light of pbrt's sun")
    failures.exit()


main()

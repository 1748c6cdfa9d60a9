"""POV-Ray draws the Radiance picture of a sky as it is: a camera in its middle that sees all directions finds the probes.

POV-Ray's manual, "Map Type": type 1 wraps an image around a sphere to be seen from outside, from +x on, so that the
sphere is mirrored to be seen from within, and turned to have the middle of the picture at +z.
"""

import re
import struct

import consumer

WIDTH, HEIGHT = 1024, 512
SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1.0 }}
camera {{ spherical location <0, 0, 0> look_at <0, 0, 1> angle 360 180 right x*2 up y }}
sphere {{
    <0, 0, 0>, 1
    pigment {{ image_map {{ hdr "{sky}" map_type 1 interpolate 2 }} scale <-1, 1, 1> rotate -90*y }}
    finish {{ emission 1 ambient 0 diffuse 0 }}
    scale 1000
    hollow
}}
"""


def pixels(path):
    """The values of a PPM file of 16 bits, row 0 first."""
    data = path.read_bytes()
    head = re.match(rb"P6\s(?:#[^\n]*\n)*(\d+) (\d+)\s(?:#[^\n]*\n)*65535\n", data)
    assert [int(n) for n in head.groups()] == [WIDTH, HEIGHT], head
    values = struct.unpack_from(f">{3 * WIDTH * HEIGHT}H", data, head.end())
    return [value / 65535 for value in values]


def main():
    povray = consumer.program("povray", "povray")
    failures = consumer.Failures()
    [sky] = consumer.baked_volumes()
    scene, picture = sky.folder / "sky.pov", sky.folder / "sky.ppm"
    scene.write_text(SCENE.format(sky=sky.path("hdr")))
    consumer.output_of(povray, f"+I{scene}", f"+O{picture}", "+FP16", "File_Gamma=1.0", f"+W{WIDTH}", f"+H{HEIGHT}", "-D", "-A")
    values = pixels(picture)
    seen = 0
    for i, probe in enumerate(sky.asset["probes"]):
        u, v = probe["uv"]
        if abs(v - 0.5) < 1.5 / sky.size[1] or not 2 / sky.size[0] < u < 1 - 2 / sky.size[0] or v < 1 / sky.size[1]:
            continue  # a pixel is no point, and light changes most at the horizon; POV-Ray's sphere has a seam and poles
        first = 3 * (int(v * HEIGHT) * WIDTH + int(u * WIDTH))
        seen += 1
        for c, value in enumerate(probe["value"]):
            failures.expect_near(values[first + c], value, 0.02 * value + 1e-4, f"probe {i} in POV-Ray, channel {c}")
    failures.expect(seen >= 10, True, f"whether {seen} probes are many")
    failures.exit()


main()

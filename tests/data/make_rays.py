#!/usr/bin/env python3
"""Writes rays_up.csv, rays_within.csv and rays_down.csv, the rays that skipping is measured with.

Each has 3000 rays through a tile of 600 units along x, y and height: origin x, y, z, then the
direction x, y, z of length 1. Random numbers are members n = 1, 2 ... of Roberts' sequence in five
dimensions, fraction(1/2 + n / g^i), i = 1 ... 5, with g the real root of g^6 = g + 1.
    up      from z = 0, the cosine of the zenith angle uniform in [cos 60 deg, 1]
    within  from heights 0 to 150, directions uniform on the sphere
    down    from z = 600, as up, mirrored
The files are kept: mathematical libraries differ in the last digits.
"""
import math
import pathlib

ROOT = 1.1347241384015194
TILE = 600.0
LAYER = 150.0
COUNT = 3000


def members(n):
    return [math.modf(0.5 + n / ROOT**i)[0] for i in range(1, 6)]


def direction(cosine, turn):
    sine = math.sqrt(max(0.0, 1 - cosine * cosine))
    return [sine * math.cos(2 * math.pi * turn), sine * math.sin(2 * math.pi * turn), cosine]


def steep(share):
    least = math.cos(math.radians(60))
    return least + (1 - least) * share


def write(name, ray):
    lines = ["origin_x,origin_y,origin_z,direction_x,direction_y,direction_z"]
    for n in range(1, COUNT + 1):
        lines.append(",".join(f"{value:.9g}" for value in ray(*members(n))))
    path = pathlib.Path(__file__).parent / f"rays_{name}.csv"
    path.write_text("\n".join(lines) + "\n")


write("up", lambda a, b, c, d, e: [TILE * a, TILE * b, 0.0] + direction(steep(c), d))
write(
    "within",
    lambda a, b, c, d, e: [TILE * a, TILE * b, LAYER * e] + direction(2 * c - 1, d),
)
write("down", lambda a, b, c, d, e: [TILE * a, TILE * b, TILE] + direction(-steep(c), d))

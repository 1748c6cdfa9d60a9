#!/usr/bin/python3
"""Writes the volumes of this folder: /usr/bin/python3 make_volumes.py

Voxel (x, y, z) of each holds a number of its own. pyopenvdb (Debian package python3-openvdb) writes the
VDB file, and zlib the pictures.
"""

import os
import struct
import zlib

import pyopenvdb as vdb

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, data):
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(data)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, values):
    """A grey picture of 16 bits."""
    rows = b"".join(b"\0" + struct.pack(f">{width}H", *values[y * width:(y + 1) * width])
                    for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9))
            + chunk(b"IEND", b""))


def value(x, y, z):
    return (x + 4 * y + 12 * z) / 32


def main():
    size = (4, 3, 2)
    every = [(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]
    write("numbers.raw", b"".join(struct.pack("<f", value(*at)) for at in every))
    for z in range(size[2]):
        numbers = [round(65535 * value(*at)) for at in every if at[2] == z]
        write(f"slice_{z + 1}.png", png(size[0], size[1], numbers))
    grid = vdb.FloatGrid()
    grid.name = "density"
    grid.gridClass = vdb.GridClass.FOG_VOLUME
    grid.transform = vdb.createLinearTransform(voxelSize=10)
    voxels = grid.getAccessor()
    for x, y, z in every:
        voxels.setValueOn((x - 1, y, z + 5), value(x, y, z))
    vdb.write(os.path.join(FOLDER, "python.vdb"), grids=[grid])


if __name__ == "__main__":
    main()

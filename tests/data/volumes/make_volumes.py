#!/usr/bin/python3
"""Writes the volumes of this folder: /usr/bin/python3 make_volumes.py

Voxel (x, y, z) of each holds a number of its own. pyopenvdb (Debian package python3-openvdb) writes the
VDB file.
"""

import os
import struct

import pyopenvdb as vdb

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, data):
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(data)


def value(x, y, z):
    return (x + 4 * y + 12 * z) / 32


def main():
    size = (4, 3, 2)
    every = [(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]
    write("numbers.raw", b"".join(struct.pack("<f", value(*at)) for at in every))
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

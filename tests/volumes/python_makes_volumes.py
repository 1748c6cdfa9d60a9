#!/usr/bin/python3
"""skybake reads volumes that OpenVDB's own Python module has written.

    python_makes_volumes.py SKYBAKE
"""

import array
import pathlib
import subprocess
import sys
import tempfile

try:
    import pyopenvdb as vdb
except ImportError:
    print("skipped: pyopenvdb is not installed (Debian package python3-openvdb)")
    sys.exit(77)

RECIPE = """
[volumes.v]
file = "v.vdb"
grid = "{grid}"
up_axis = "{up}"
[clouds.c]
volume = "v"
[bake.c]
asset = "cloud_volume"
cloud = "c"
size = [{size}]
formats = ["bin"]
pixel_type = "float"
"""


def smoke(background):
    """Voxels, tiles and a transform as a simulation leaves them."""
    grid = vdb.FloatGrid(background)
    grid.name = "density"
    grid.transform = vdb.createLinearTransform(voxelSize=0.25)
    voxels = grid.getAccessor()
    for i in range(3000):
        at = (i * 7 % 53 - 11, i * 13 % 37 + 100, i * 29 % 41 - 60)
        voxels.setValueOn(at, (i * 31 % 101) / 128)
    grid.fill((-11, 100, -60), (4, 115, -45), 0.5)
    return grid


def wrong_voxels(skybake, grid, up, folder):
    vdb.write(str(folder / "v.vdb"), grids=[grid])
    low, high = grid.evalActiveVoxelBoundingBox()
    size = [b - a + 1 for a, b in zip(low, high)]
    turned = size if up == "z" else [size[0], size[2], size[1]]
    recipe = folder / "r.toml"
    recipe.write_text(RECIPE.format(grid=grid.name, up=up, size=", ".join(map(str, turned))))
    subprocess.run([skybake, "bake", recipe, "-o", folder / "out", "-q"], check=True)
    found = array.array("f", (folder / "out" / "c.bin").read_bytes())
    voxels = grid.getConstAccessor()
    wrong = 0
    at = 0
    for z in range(turned[2]):
        for y in range(turned[1]):
            for x in range(turned[0]):
                index = (x, y, z) if up == "z" else (x, z, size[2] - 1 - y)
                wanted = voxels.getValue(tuple(low[i] + index[i] for i in range(3)))
                wrong += found[at] != max(wanted, 0.0)
                at += 1
    return wrong, at


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        for background in (0.0, 0.0625):
            for up in ("z", "y"):
                grid = smoke(background)
                wrong, count = wrong_voxels(sys.argv[1], grid, up, pathlib.Path(name))
                print(f"background {background}, {up} up: {wrong} of {count} voxels are wrong")
                failures += wrong
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()

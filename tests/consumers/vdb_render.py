"""vdb_render, OpenVDB's own ray tracer, renders the volumes: it refuses voxels that are not cubes."""

import subprocess

import consumer

WIDTH, HEIGHT = 16, 12
VOXEL_M = {"cloud": 20, "cells": 80}


def pixels(path):
    data = path.read_bytes() if path.exists() else b""
    return data[-3 * WIDTH * HEIGHT :]


def main():
    vdb_render = consumer.program("vdb_render", "libopenvdb-tools")
    failures = consumer.Failures()
    for volume in consumer.baked_volumes():
        for axis, count in zip("uvw", volume.size):
            mapping = volume.asset["mapping"][axis]
            length = mapping["last"] - mapping["first"]
            failures.expect(length, count * VOXEL_M[volume.name], f"{volume.name}: the length along {axis}")
        picture = volume.folder / "picture.ppm"
        command = [vdb_render, volume.path("vdb"), picture, "-name", volume.grids()[0], "-cpus", "1"]
        command += ["-res", f"{WIDTH}x{HEIGHT}", "-samples", "1", "-step", "1,3"]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        failures.expect((result.returncode, result.stdout), (0, ""), f"{volume.name}: vdb_render")
        lit = sum(value > 0 for value in pixels(picture))
        failures.expect(lit > WIDTH * HEIGHT, True, f"{volume.name}: whether {lit} values are many")
        picture.unlink(missing_ok=True)
    failures.exit()


main()

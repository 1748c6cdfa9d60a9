"""OpenVDB's own Python module finds the voxels where they should be."""

import json

import consumer

try:
    import pyopenvdb as vdb
except ImportError:
    consumer.skip("pyopenvdb is not installed (Debian package python3-openvdb)")


def trilinear(voxel, size, uvw, repeats):
    """The value at texture coordinates: voxel i is at (i + 1/2) / size."""
    value = 0.0
    base, weight = [], []
    for axis in range(3):
        position = uvw[axis] * size[axis] - 0.5
        base.append(int(position // 1))
        weight.append(position - base[-1])
    for corner in range(8):
        at, product = [], 1.0
        for axis in range(3):
            upper = corner >> axis & 1
            i = base[axis] + upper
            at.append(i % size[axis] if repeats[axis] else min(max(i, 0), size[axis] - 1))
            product *= weight[axis] if upper else 1 - weight[axis]
        value += product * voxel(tuple(at))
    return value


def repeating_axes(mapping):
    return {"tile": [True] * 3, "layer": [True, True, False]}.get(mapping, [False] * 3)


def check_grid(failures, volume, channels, grid, values):
    """`values` are numbers, or vectors of three channels."""
    what = f"{volume.name}, {grid.name}"
    is_vector = len(channels) > 1
    zero = (0.0,) * 3 if is_vector else 0.0
    failures.expect(grid.gridClass, "unknown" if is_vector else "fog volume", f"{what}: the class")
    failures.expect(grid.background, zero, f"{what}: the background")
    failures.expect(grid.saveFloatAsHalf, True, f"{what}: whether it holds halves")
    failures.expect(grid["skybake/size"], tuple(volume.size), f"{what}: the size")
    failures.expect(grid["file_voxel_count"], grid.activeVoxelCount(), f"{what}: the count")

    accessor = grid.getConstAccessor()
    width, height, depth = volume.size
    differing, misjudged, index = 0, 0, 0
    for z in range(depth):
        for y in range(height):
            for x in range(width):
                value, is_active = accessor.probeValue((x, y, z))
                differing += value != values[index]
                misjudged += is_active != (values[index] != zero)
                index += 1
    failures.expect(differing, 0, f"{what}: the number of voxels of another value")
    failures.expect(misjudged, 0, f"{what}: the number of voxels wrongly active or inactive")
    failures.expect(grid.activeVoxelCount(), sum(v != zero for v in values), f"{what}: active voxels")

    repeats = repeating_axes(volume.asset["mapping"]["name"])
    for probe in volume.asset["probes"]:
        for i, channel in enumerate(channels):
            def component(voxel):
                return accessor.getValue(voxel)[i] if is_vector else accessor.getValue(voxel)

            value = trilinear(component, volume.size, probe["uvw"], repeats)
            failures.expect_near(
                value, probe["value"][channel], 1e-6, f"{what}: at {probe['uvw']}"
            )

    first = grid.transform.indexToWorld((0, 0, 0))
    next_ = grid.transform.indexToWorld((1, 1, 1))
    edges = grid.transform.voxelSize()
    for axis in range(3):
        failures.expect_near(next_[axis] - first[axis], edges[axis], 1e-9, f"{what}: an edge")
        # The lower corner of the volumes is the origin.
        failures.expect_near(first[axis], edges[axis] / 2, 1e-9, f"{what}: the first centre")


def main():
    failures = consumer.Failures()
    for volume in consumer.baked_volumes():
        grids, metadata = vdb.readAll(volume.path("vdb"))
        entry = json.loads(metadata["skybake/asset"])
        failures.expect(entry["content_hash"], volume.asset["content_hash"], "the hash")
        names = [grid.name for grid in grids]
        failures.expect(sorted(names), sorted(volume.vdb_grids()), f"{volume.name}: the grids")
        voxels = volume.voxels()
        for name, channels in volume.vdb_grids().items():
            values = voxels[channels[0]]
            if len(channels) > 1:
                values = list(zip(*(voxels[channel] for channel in channels)))
            check_grid(failures, volume, channels, grids[names.index(name)], values)
    failures.exit()


main()

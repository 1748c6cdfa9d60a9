"""vdb_print, which comes with OpenVDB, lists what the manifest says."""

import json
import re

import consumer


def field(text, name):
    found = re.search(rf"^\s*{re.escape(name)}:\s*(.*?)\s*$", text, re.MULTILINE)
    return found.group(1) if found else None


def main():
    vdb_print = consumer.program("vdb_print", "libopenvdb-tools")
    failures = consumer.Failures()
    for volume in consumer.baked_volumes():
        text = consumer.output_of(vdb_print, "-l", volume.path("vdb"))
        head, *grids = re.split(r"^Name: ", text, flags=re.MULTILINE)
        entry = json.loads(field(head, "skybake/asset") or "{}")
        failures.expect(entry.get("content_hash"), volume.asset["content_hash"], "the hash")
        # By name, whatever their order in the file.
        found = {grid.splitlines()[0]: grid for grid in grids}
        failures.expect(
            sorted(found), sorted(volume.vdb_grids()), f"the list of grids of {volume.name}"
        )
        voxels = volume.voxels()
        for name, channels in volume.vdb_grids().items():
            grid = found.get(name, "")
            active = sum(any(values) for values in zip(*(voxels[channel] for channel in channels)))
            is_vector = len(channels) > 1
            for name, wanted in {
                "Type": "Tree_vec3s_5_4_3" if is_vector else "Tree_float_5_4_3",
                "Background value": "[0, 0, 0]" if is_vector else "0",
                "Number of active voxels": f"{active:,}",
                "Number of active tiles": "0",
                "class": None if is_vector else "fog volume",
                "file_voxel_count": str(active),
                "is_saved_as_half_float": "true",
                "skybake/size": str(volume.size),
                "units": "metres",
            }.items():
                failures.expect(field(grid, name), wanted, f"{volume.name}: {name}")
    failures.exit()


main()

"""Validates manifests against their JSON Schema, and that the schema refuses what is wrong.

usage: validate_manifest.py SKYBAKE COMMAND...   SKYBAKE prints the schema, COMMAND FOLDER writes FOLDER/manifest.json
"""

import copy
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(SKIPPED)


def set_at(document, path, value):
    changed = copy.deepcopy(document)
    node = changed
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = value
    return changed


def main():
    schema = json.loads(subprocess.run([sys.argv[1], "schema", "manifest"], check=True,
                                       capture_output=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)

    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(sys.argv[2:] + [folder], check=True, stdout=subprocess.DEVNULL)
        manifest = json.loads((Path(folder) / "manifest.json").read_text(encoding="utf-8"))

    errors = [f"{error.json_path}: {error.message}" for error in validator.iter_errors(manifest)]
    wrong = {
        "a path that leaves the folder": (("assets", 0, "files", 0, "path"), "../a.exr"),
        "an absolute path": (("assets", 0, "files", 0, "path"), "/a.exr"),
        "a format": (("assets", 0, "files", 0, "format"), "tiff"),
        "a pixel type": (("assets", 0, "files", 0, "pixel_type"), "double"),
        "a hash": (("assets", 0, "files", 0, "xxh3"), "xyz"),
        "a size": (("assets", 0, "size"), [16]),
        "too few probes": (("assets", 0, "probes"), []),
        "uv out of range": (("assets", 0, "probes", 0, "uv"), [0, 1.5]),
        "another tool": (("tool", "name"), "other"),
        "an earlier format": (("format",), 1),
        "a manifest without a hash": (("hash",), None),
        "an entry without a hash": (("assets", 0, "hash"), ""),
        "conventions of all assets": (("conventions",), manifest["assets"][0]["conventions"]),
        "an unknown convention": (("assets", 0, "conventions", "texel_size"), 1),
        "an unknown unit": (("assets", 0, "conventions", "length_unit"), "mile"),
        "one irradiance for all colours": (("assets", 0, "conventions", "solar_irradiance"), 1.0),
        "a wavelength of 0": (("assets", 0, "conventions", "wavelengths_nm", 0), 0),
        "another wrap": (("assets", 0, "mapping", "u", "wrap"), "mirror"),
        "another filter": (("assets", 0, "mapping", "v", "filter"), "cubic"),
        "an axis without end points": (("assets", 0, "mapping", "u", "end_points"), None),
        "constants in an object": (("assets", 0, "mapping", "u", "constants", "a"), {"b": 1}),
        "a list of words in details": (("assets", 0, "details", "nodes"), ["12"]),
        "a lookup that fetches nothing": (("assets", 0, "lookup_cost", "fetches"), 0),
        "a table in another format": (("assets", 0, "files", 0, "format"), "vdb"),
        "a table with the probes of a volume": (("assets", 0, "probes"), manifest["assets"][2]["probes"]),
        "a volume with the probes of a table": (("assets", 2, "probes"), manifest["assets"][0]["probes"]),
        "a size of four": (("assets", 2, "size"), [1, 2, 3, 4]),
        "a size of two for a volume": (("assets", 2, "size"), [12, 10]),
        "a layout": (("assets", 2, "files", 0, "layout", "kind"), "heap"),
        "a layout of bare voxels": (("assets", 2, "files", 2, "layout"), manifest["assets"][2]["files"][0]["layout"]),
        "grids of an image": (("assets", 2, "files", 0, "grids"), ["R", "G", "B"]),
        "a VDB file without grids": (("assets", 2, "files", 4, "grids"), []),
        "a grid without a name": (("assets", 2, "files", 4, "grids", 1), ""),
        "a negative count": (("assets", 2, "statistics", 0, "histogram", "counts", 0), -1),
        "a negative seam error": (("assets", 2, "seam_error"), -1),
        "a mip without a size": (("assets", 2, "mips", 0), {}),
        "an unknown fault": (("assets", 0, "catches"), ["turned"]),
        "a fault named twice": (("assets", 2, "catches"), ["zeros", "zeros"]),
        "a volume's probe without a place": (("assets", 2, "probes", 0, "at"), {}),
        "a blend of more than all": (("assets", 2, "probes", 3, "blend", "share"), 1.5),
    }
    for name, (path, value) in wrong.items():
        if validator.is_valid(set_at(manifest, path, value)):
            errors.append(f"the schema accepts {name}")
    print("\n".join(errors) or f"{len(manifest['assets'])} assets, valid")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())

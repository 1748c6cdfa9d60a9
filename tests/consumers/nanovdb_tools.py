"""nanovdb_validate finds nothing wrong with NanoVDB files, and nanovdb_print lists what the manifest
says."""

import consumer


def main():
    validate = consumer.program("nanovdb_validate", "libnanovdb-tools")
    printer = consumer.program("nanovdb_print", "libnanovdb-tools")
    failures = consumer.Failures()
    types = set()
    for volume in consumer.baked_volumes():
        files = [f for f in volume.asset["files"] if f["format"] == "nvdb"]
        for file in files:
            path = str(volume.folder / file["path"])
            said = consumer.output_of(validate, "-v", path)
            failures.expect("invalid" in said.lower() or "fail" in said.lower(), False, said)
            text = consumer.output_of(printer, path)
            rows = [line.split() for line in text.splitlines()]
            for name in file["grids"]:
                row = next((row for row in rows if f'"{name}"' in row or name in row), [])
                failures.expect("float" in row, True, f"{file['path']}: {row}")
                failures.expect("32.4.2" in row, True, f"{file['path']}: the version of {row}")
            types.add(file["pixel_type"])
    failures.expect(types, {"float", "half"}, "the set of types that were read")
    failures.exit()


main()

"""numpy.load reads npy files, and vol and TGA files hold the same texels, by their documents."""

import consumer

try:
    import numpy
except ImportError:
    consumer.skip("numpy is not installed (Debian package python3-numpy)")

TYPES = {"float": "<f4", "half": "<f2", "unorm8": "|u1", "unorm16": "<u2"}


def main():
    failures = consumer.Failures()
    formats = set()
    for volume in consumer.baked_volumes():
        levels = {(f["format"], f["level"]): f for f in volume.asset["files"]}
        for (form, level), file in levels.items():
            if form not in ("npy", "vol", "tga"):
                continue
            bare = levels["bin", level]
            texels = numpy.fromfile(volume.folder / bare["path"], TYPES[bare["pixel_type"]])
            size = [max(1, edge >> level) for edge in volume.size]
            shape = (size[2], size[1], size[0], len(volume.channels))
            path = volume.folder / file["path"]
            if form == "npy":
                found = numpy.load(path, mmap_mode="r", allow_pickle=False)
                failures.expect(found.dtype.str, TYPES[file["pixel_type"]], f"{path}: type")
            elif form == "vol":
                head = numpy.fromfile(path, "<i4", 6)
                failures.expect(
                    (head[0], *head[2:5]), (int.from_bytes(b"VOL\3", "little"), *size), f"{path}"
                )
                found = numpy.fromfile(path, "<f4", offset=48).reshape(shape)
            else:
                found = numpy.fromfile(path, "|u1", texels.size, offset=18).reshape(shape)
            failures.expect(found.shape, shape, f"{path}: shape")
            same = numpy.array_equal(found.reshape(-1), texels.astype(found.dtype))
            failures.expect(same, True, f"{path}: whether all texels are there")
            formats.add(form)
    failures.expect(formats, {"npy", "vol", "tga"}, "the set of formats that were read")
    failures.exit()


main()

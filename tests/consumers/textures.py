"""ffmpeg decodes PNG, TGA and DDS textures to the texels that stand bare in the files beside them.

Of DDS textures ffmpeg reads those of four channels; up to release 5.1 it exchanges red and blue.
"""

import subprocess

import consumer

SAMPLES = {
    ("unorm8", 1): "gray",
    ("unorm8", 3): "rgb24",
    ("unorm8", 4): "rgba",
    ("unorm16", 1): "gray16le",
    ("unorm16", 3): "rgb48le",
    ("unorm16", 4): "rgba64le",
}


def decoded(ffmpeg, path, samples):
    command = [ffmpeg, "-v", "error", "-i", path, "-frames:v", "1", "-f", "rawvideo",
               "-pix_fmt", samples, "-"]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return result.stdout, result.stderr.decode()


def image_of(texels, size, channels, width, layout):
    """The bytes of the image that the texels of a volume should be, `width` bytes a sample."""
    columns, rows = layout["columns"], layout["rows"]
    depth = size[2] if len(size) == 3 else 1
    row = size[0] * channels * width
    lines = [bytearray(row * columns) for _ in range(size[1] * rows)]
    for z in range(depth):
        for y in range(size[1]):
            start = (z * size[1] + y) * row
            line = lines[z // columns * size[1] + y]
            line[z % columns * row : (z % columns + 1) * row] = texels[start : start + row]
    if layout.get("flipped"):
        lines.reverse()
    return b"".join(lines)


def main():
    ffmpeg = consumer.program("ffmpeg", "ffmpeg")
    failures = consumer.Failures()
    formats = set()
    for asset in consumer.baked_volumes():
        channels = len(asset.channels)
        bare = asset.file("bin")
        samples = SAMPLES[bare["pixel_type"], channels]
        width = 1 if bare["pixel_type"] == "unorm8" else 2
        texels = (asset.folder / bare["path"]).read_bytes()
        for file in asset.asset["files"]:
            if file["format"] == "bin" or file["level"] > 0:
                continue
            layout = file.get("layout", {"columns": 1, "rows": 1})
            path = str(asset.folder / file["path"])
            wanted = image_of(texels, asset.size, channels, width, layout)
            found, errors = decoded(ffmpeg, path, samples)
            failures.expect(errors, "", f"{file['path']}: what ffmpeg says")
            if file["format"] == "dds" and found != wanted:
                found = b"".join(
                    bytes((found[i + 2], found[i + 1], found[i], found[i + 3]))
                    for i in range(0, len(found) - 3, 4)
                )
            failures.expect(found == wanted, True, f"{file['path']}: whether all texels are there")
            formats.add(file["format"])
    failures.expect(formats, {"png", "dds", "tga"}, "the set of formats that were read")
    failures.exit()


main()

"""ffmpeg decodes the EXR files to the values that are in them.

Release 5.1 reads the first 255 bytes of an attribute that it does not know, goes on with the rest as
if it were the next attribute, and returns black pictures without an error.
"""

import struct
import subprocess

import consumer
from exr_file import ExrFile

LONGEST_NAME = 31
TOO_LONG = 250
# By its channels: ffmpeg's name of the layout, and the order of its planes.
LAYOUTS = {
    "Y": ("grayf32le", "Y"),
    "BGR": ("gbrpf32le", "GBR"),
    "ABGR": ("gbrapf32le", "GBRA"),
}


def planes_of_ffmpeg(ffmpeg, path, layout, names, count):
    command = [ffmpeg, "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", layout, "-"]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if result.returncode != 0 or result.stderr or len(result.stdout) != 4 * count * len(names):
        return None, result.stderr.decode()
    values = struct.unpack(f"<{count * len(names)}f", result.stdout)
    return {name: values[i * count : (i + 1) * count] for i, name in enumerate(names)}, ""


def check_attributes(failures, name, image):
    for attribute, (_, value) in image.attributes.items():
        what = f"{name}: {attribute}"
        failures.expect(len(attribute) <= LONGEST_NAME, True, f"{what}: whether its name is short")
        failures.expect(len(value) < TOO_LONG, True, f"{what}: whether {len(value)} bytes are few")
        value.decode("utf-8") if attribute.startswith("skybake/") else None


def main():
    ffmpeg = consumer.program("ffmpeg", "ffmpeg")
    failures = consumer.Failures()
    files = [
        (volume, volume.folder / file["path"])
        for volume in consumer.baked_volumes()
        for file in volume.asset["files"]
    ]
    decoded = {path.stem: ExrFile(path) for _, path in files}
    long_texts = 0
    for name, image in decoded.items():
        check_attributes(failures, name, image)
        long_texts += "skybake/asset.1" in image.attributes
        channels = "".join(channel for channel, _, _ in image.channels)
        layout, order = LAYOUTS[channels]
        reference = image if image.can_decode() else decoded[name.removesuffix("_piz")]
        wanted = reference.planes()
        failures.expect(any(any(plane) for plane in wanted.values()), True, f"{name}: any value")
        path = next(path for _, path in files if path.stem == name)
        found, errors = planes_of_ffmpeg(ffmpeg, path, layout, order, image.width * image.height)
        failures.expect(errors, "", f"{name}: what ffmpeg says")
        for channel in channels:
            failures.expect(
                found is not None and list(found[channel]) == wanted[channel],
                True,
                f"{name}: whether all values of {channel} are those of the file",
            )
    failures.expect(long_texts > 0, True, "whether any text was long enough to be split")
    failures.exit()


main()

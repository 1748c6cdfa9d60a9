"""What the tests of programs of others share.

Each test is run as `TEST.py COMMAND...`; COMMAND FOLDER bakes volumes, in all formats, and their
manifest.json into FOLDER. A program that is missing skips the test.
"""

import array
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def program(name, package):
    found = shutil.which(name)
    if not found:
        skip(f"{name} is not installed (Debian package {package})")
    return found


def output_of(*command):
    """What the command prints; the test fails where the command does."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{result.stdout}")
    return result.stdout


class Failures:
    """Collects what is wrong, so that a run tells all of it."""

    def __init__(self):
        self.checks = 0
        self.messages = []

    def expect(self, found, wanted, what):
        self.checks += 1
        if found != wanted:
            self.messages.append(f"{what} is {found}, not {wanted}")

    def expect_near(self, found, wanted, tolerance, what):
        self.checks += 1
        if not abs(found - wanted) <= tolerance:
            self.messages.append(f"{what} is {found}, not {wanted}")

    def exit(self):
        print("\n".join(self.messages) or f"{self.checks} checks")
        sys.exit(1 if self.messages else 0)


class Volume:
    """An asset of a manifest and its files."""

    def __init__(self, folder, asset):
        self.folder = folder
        self.asset = asset
        self.name = asset["name"]
        self.size = asset["size"]
        self.channels = asset["channels"]

    def file(self, form):
        return next(f for f in self.asset["files"] if f["format"] == form and f["level"] == 0)

    def path(self, form):
        return str(self.folder / self.file(form)["path"])

    def grids(self):
        return self.file("vdb")["grids"]

    def vdb_grids(self):
        """The grids of the VDB file with the channels of each: `v` has `v.x`, `v.y` and `v.z`."""
        grids = {}
        for channel, name in enumerate(self.grids()):
            grids.setdefault(name.removesuffix("." + name[-1]), []).append(channel)
        return grids

    def statistics(self):
        return self.asset["statistics"]

    def voxels(self):
        """The values of each channel, x fastest, then y, then z, from the file of bare voxels."""
        halves = array.array("H", Path(self.path("bin")).read_bytes())
        if sys.byteorder == "big":
            halves.byteswap()
        values = [value_of_half(half) for half in halves]
        count = len(self.channels)
        return [values[channel::count] for channel in range(count)]


def value_of_half(bits):
    sign = -1.0 if bits & 0x8000 else 1.0
    exponent, mantissa = bits >> 10 & 31, bits & 1023
    if exponent == 0:
        return sign * mantissa * 2.0**-24
    return sign * (1024 + mantissa) * 2.0 ** (exponent - 25)


def baked_volumes():
    """The volumes that the test's command bakes; each has files in all formats, of halves."""
    folder = tempfile.TemporaryDirectory()
    output_of(*sys.argv[1:], folder.name)
    manifest = json.loads((Path(folder.name) / "manifest.json").read_text(encoding="utf-8"))
    volumes = [Volume(Path(folder.name), asset) for asset in manifest["assets"]]
    if not volumes:
        sys.exit("nothing was baked")
    volumes[0].keep = folder  # it vanishes with the volumes
    return volumes

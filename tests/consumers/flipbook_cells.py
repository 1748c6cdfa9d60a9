"""OpenImageIO cuts the cells of a flipbook out as Unreal's SubUV and Unity's texture sheets count them.

Cell k is column k mod columns of row k / columns, from the top left, and equals the numbered file of frame k + 1 and
no other.
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import consumer


def pixels(oiiotool, path):
    text = consumer.output_of(oiiotool, "--dumpdata", str(path))
    return re.findall(r"^\s*Pixel \(\d+, \d+\): *(.*)$", text, re.MULTILINE)


def main():
    oiiotool = consumer.program("oiiotool", "openimageio-tools")
    failures = consumer.Failures()
    assets = consumer.baked_volumes()
    folder = assets[0].folder
    frames = [pixels(oiiotool, folder / f"front_{n:04}.png") for n in range(1, 7)]
    failures.expect([len(frame) for frame in frames], 6 * [16 * 12], "the pixels of the frames")
    for cell in range(6):
        left, top = 16 * (cell % 3), 12 * (cell // 3)
        cut = folder / f"cell_{cell}.png"
        consumer.output_of(oiiotool, str(folder / "book.png"), "--cut", f"16x12+{left}+{top}", "-o", str(cut))
        found = pixels(oiiotool, cut)
        equal = [n + 1 for n, frame in enumerate(frames) if frame == found]
        failures.expect(equal, [cell + 1], f"the frames that cell {cell} equals")
    failures.exit()


main()

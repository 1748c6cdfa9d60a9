"""Reads OpenEXR files as their specification says, with Python alone.

Scanlines in increasing order, uncompressed or deflated; of files in other compressions the header.
"""

import struct
import zlib

ROWS_OF_CHUNK = {0: 1, 2: 1, 3: 16}  # none, zips, zip
TYPES = {1: ("e", 2), 2: ("f", 4)}  # half, float


def name_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


class ExrFile:
    def __init__(self, path):
        self.data = path.read_bytes()
        magic, version = struct.unpack_from("<ii", self.data)
        if magic != 20000630 or version != 2:
            raise ValueError(f"{path}: magic number {magic}, version {version}")
        self.attributes = {}  # name: (type, value)
        self.end = self.read_header()
        self.compression = self.attributes["compression"][1][0]
        left, top, right, bottom = struct.unpack("<4i", self.attributes["dataWindow"][1])
        self.width, self.height, self.top = right - left + 1, bottom - top + 1, top
        self.channels = self.read_channels()  # (name, format, bytes), sorted by name as in the file

    def read_header(self):
        at = 8
        while self.data[at] != 0:
            name, at = name_at(self.data, at)
            kind, at = name_at(self.data, at)
            (size,) = struct.unpack_from("<i", self.data, at)
            self.attributes[name] = (kind, self.data[at + 4 : at + 4 + size])
            at += 4 + size
        return at + 1

    def read_channels(self):
        data, at, channels = self.attributes["channels"][1], 0, []
        while data[at] != 0:
            name, at = name_at(data, at)
            channels.append((name, *TYPES[struct.unpack_from("<i", data, at)[0]]))
            at += 16
        return channels

    def can_decode(self):
        return self.compression in ROWS_OF_CHUNK

    def planes(self):
        """The values of each channel by its name, row by row."""
        rows = ROWS_OF_CHUNK[self.compression]
        count = (self.height + rows - 1) // rows
        offsets = struct.unpack_from(f"<{count}Q", self.data, self.end)
        planes = {name: [] for name, _, _ in self.channels}
        for i, at in enumerate(offsets):
            y, size = struct.unpack_from("<ii", self.data, at)
            if y != self.top + i * rows:
                raise ValueError(f"chunk {i} begins at row {y}")
            chunk_rows = min(rows, self.height - i * rows)
            self.add_rows(self.unpacked(at + 8, size, chunk_rows), chunk_rows, planes)
        return planes

    def unpacked(self, at, size, rows):
        wanted = self.width * rows * sum(length for _, _, length in self.channels)
        data = self.data[at : at + size]
        if size == wanted:
            return data  # stored as it is where packing saves nothing
        deltas = zlib.decompress(data)
        total, halves = 0, bytearray()
        for i, delta in enumerate(deltas):
            total = (total + delta - (128 if i else 0)) & 255
            halves.append(total)
        middle = (len(halves) + 1) // 2
        result = bytearray(len(halves))
        result[0::2], result[1::2] = halves[:middle], halves[middle:]
        if len(result) != wanted:
            raise ValueError(f"{len(result)} bytes in a chunk of {wanted}")
        return bytes(result)

    def add_rows(self, data, rows, planes):
        at = 0
        for _ in range(rows):
            for name, letter, length in self.channels:
                planes[name] += struct.unpack_from(f"<{self.width}{letter}", data, at)
                at += self.width * length

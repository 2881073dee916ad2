# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads and writes stacks of 8- and 16-bit frames with the standard library alone, for compare_methods.py."""

import ast
import math
from pathlib import Path
from typing import NamedTuple

LAST_LINE = b"ElementDataFile = LOCAL\n"  # last line of the header of a MetaImage; the pixels follow
METAIMAGE_TYPES = {"MET_UCHAR": "|u1", "MET_USHORT": "<u2"}
NPY_MAGIC = b"\x93NUMPY\x01\x00"
NPY_ALIGNMENT = 64  # the header of an .npy file ends at a multiple of it [bytes]


class Stack(NamedTuple):
    """Frames (t, y, x), one after the other and row by row. kind: type of a sample, as NumPy writes it."""

    frames: int
    height: int
    width: int
    kind: str
    samples: memoryview

    @property
    def sample_bytes(self):
        return int(self.kind[-1])

    def row(self, t, y):
        length = self.width * self.sample_bytes
        start = (t * self.height + y) * length
        return self.samples[start : start + length]

    def first(self, count):
        """Returns the first frames of the stack."""
        length = count * self.height * self.width * self.sample_bytes
        return self._replace(frames=count, samples=self.samples[:length])

    def composite(self):
        """Returns one image in which as many frames as possible stand in a square, one beside the other."""
        side = math.isqrt(self.frames)
        places = ((line, y) for line in range(side) for y in range(self.height))
        rows = (self.row(line * side + t, y) for line, y in places for t in range(side))
        return Stack(1, self.height * side, self.width * side, self.kind, memoryview(b"".join(rows)))

    def plane(self, x, y):
        """Returns one of the four planes of a mosaic of 2 x 2 filters: the pixels of column x and row y, 0 or 1."""
        code = {1: "B", 2: "H"}[self.sample_bytes]
        rows = (self.row(t, line).cast(code)[x::2] for t in range(self.frames) for line in range(y, self.height, 2))
        samples = memoryview(b"".join(row.tobytes() for row in rows))
        return Stack(self.frames, (self.height + 1 - y) // 2, (self.width + 1 - x) // 2, self.kind, samples)


def metaimage_parts(content):
    """Returns the header of a MetaImage with local pixels, by the names of its lines, and where the pixels begin."""
    start = content.index(LAST_LINE) + len(LAST_LINE)
    return dict(line.split(" = ", 1) for line in content[:start].decode("ascii").splitlines()), start


def read_metaimage(name):
    """Returns the stack of a MetaImage file as simulate-sensor-noise writes it: 3-D, not compressed."""
    content = Path(name).read_bytes()
    header, start = metaimage_parts(content)
    width, height, frames = map(int, header["DimSize"].split())
    return Stack(frames, height, width, METAIMAGE_TYPES[header["ElementType"]], memoryview(content)[start:])


def read_npy(name):
    """Returns the stack of an .npy file (version 1) of uint8 or uint16, (t, y, x).

    Raises ValueError for any other file."""
    content = Path(name).read_bytes()
    start = len(NPY_MAGIC) + 2
    end = start + int.from_bytes(content[start - 2 : start], "little")
    header = ast.literal_eval(content[start:end].decode()) if content.startswith(NPY_MAGIC) else {}
    if header.get("descr") not in METAIMAGE_TYPES.values() or header["fortran_order"] or len(header["shape"]) != 3:
        raise ValueError(
            f"{name}: has {header or 'no header'}; expected frames (t, y, x) of uint8 or uint16 in C order"
        )
    return Stack(*header["shape"], header["descr"], memoryview(content)[end:])


def write_npy(name, stack):
    """Writes a stack to an .npy file. Returns its name."""
    shape = (stack.frames, stack.height, stack.width)
    header = repr({"descr": stack.kind, "fortran_order": False, "shape": shape})
    start = len(NPY_MAGIC) + 2
    padded = -(-(start + len(header) + 1) // NPY_ALIGNMENT) * NPY_ALIGNMENT
    text = header.ljust(padded - start - 1) + "\n"
    with Path(name).open("wb") as file:
        file.write(NPY_MAGIC + len(text).to_bytes(2, "little") + text.encode())
        file.write(stack.samples)
    return name

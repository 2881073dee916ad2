# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads and writes bursts of frames as arrays: uncompressed MetaImage stacks, and DNG files of one mosaic."""

import struct
from pathlib import Path

import numpy as np
from compare_frames import metaimage_parts

# Element types of MetaImage, by NumPy's names.
METAIMAGE_TYPES = {
    "uint8": "MET_UCHAR",
    "uint16": "MET_USHORT",
    "int16": "MET_SHORT",
    "float32": "MET_FLOAT",
    "float64": "MET_DOUBLE",
}

# Types of TIFF 6.0, and struct's characters for their numbers. A rational number is a pair of numbers.
BYTE, ASCII, SHORT, LONG, RATIONAL, SRATIONAL = 1, 2, 3, 4, 5, 10
FORMATS = {BYTE: "B", ASCII: "B", SHORT: "H", LONG: "I", RATIONAL: "I", SRATIONAL: "i"}
PAIRS = (RATIONAL, SRATIONAL)
EXIF = 34665  # tag of the directory with exposure time and ISO speed


def read_frames(name):
    """Returns the frames (t, y, x) of a stack that simulate-sensor-noise wrote, and the bytes in front of them."""
    content = Path(name).read_bytes()
    header, start = metaimage_parts(content)
    if header["ElementType"] != "MET_USHORT" or header["CompressedData"] != "False":
        raise ValueError(f"{name}: expected uncompressed MET_USHORT, found {header['ElementType']}")
    shape = [int(size) for size in header["DimSize"].split()][::-1]
    return np.frombuffer(content, "<u2", offset=start).reshape(shape).copy(), content[:start]


def write_frames(name, frames, header):
    """Writes frames behind the header that read_frames() returned."""
    Path(name).write_bytes(header + frames.astype("<u2").tobytes())


def write_stack(name, frames):
    """Writes frames (t, y, x) with a pixel type of METAIMAGE_TYPES as an uncompressed MetaImage."""
    size = " ".join(map(str, frames.shape[::-1]))
    words = f"ObjectType = Image\nNDims = 3\nDimSize = {size}\nElementType = {METAIMAGE_TYPES[frames.dtype.name]}\n"
    words += "BinaryData = True\nBinaryDataByteOrderMSB = False\nElementDataFile = LOCAL\n"
    Path(name).write_bytes(
        words.encode() + np.ascontiguousarray(frames.astype(frames.dtype.newbyteorder("<"))).tobytes()
    )


def write_dng(name, grey_values, black, white, cfa=(0, 1, 1, 2), model=b"Model", neutral=None, exif=()):
    """Writes a mosaic as an uncompressed DNG file of 16 bits.

    black, white: levels [DN]. cfa: colours of the pixels of 2 x 2 (0 red, 1 green, 2 blue). neutral: numerators and
    denominators of AsShotNeutral. exif: tags of the directory EXIF, each with type and numbers.
    """
    height, width = grey_values.shape
    tags = {
        254: (LONG, [0]),
        256: (LONG, [width]),
        257: (LONG, [height]),
        258: (SHORT, [16]),
        259: (SHORT, [1]),
        262: (SHORT, [32803]),
        271: (ASCII, b"Maker\0"),
        272: (ASCII, model + b"\0"),
        273: (LONG, [8]),
        274: (SHORT, [1]),
        277: (SHORT, [1]),
        278: (LONG, [height]),
        279: (LONG, [2 * grey_values.size]),
        33421: (SHORT, [2, 2]),
        33422: (BYTE, list(cfa)),
        50706: (BYTE, [1, 4, 0, 0]),
        50708: (ASCII, b"Maker " + model + b"\0"),
        50714: (LONG, [black]),
        50717: (LONG, [white]),
        50721: (SRATIONAL, [1, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 1, 1]),
        50778: (SHORT, [21]),
    }
    if neutral is not None:
        tags[50728] = (RATIONAL, neutral)
    start = 8 + 2 * grey_values.size
    after = b""
    if exif:
        tags[EXIF] = (LONG, [0])
        end = start + len(_directory(tags, start))
        tags[EXIF] = (LONG, [end])
        after = _directory({tag: (kind, values) for tag, kind, values in exif}, end)
    head = b"II*\0" + struct.pack("<I", start)
    Path(name).write_bytes(head + grey_values.astype("<u2").tobytes() + _directory(tags, start) + after)


def _directory(tags, start):
    """Returns a TIFF directory at the position `start`, followed by its values."""
    entries, extra = b"", b""
    for tag, (kind, values) in sorted(tags.items()):
        data = struct.pack(f"<{len(values)}{FORMATS[kind]}", *values)
        count = len(values) // (2 if kind in PAIRS else 1)
        if len(data) > 4:
            at = start + 6 + 12 * len(tags) + len(extra)
            extra += data + b"\0" * (len(data) % 2)
            data = struct.pack("<I", at)
        entries += struct.pack("<HHI", tag, kind, count) + data.ljust(4, b"\0")
    return struct.pack("<H", len(tags)) + entries + b"\0\0\0\0" + extra

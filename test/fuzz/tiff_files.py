# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Undamaged TIFF files of small 16-bit frames, and raw files of a camera, which are TIFF files (DNG)."""

import struct
import zlib

import frame_parts
from frame_parts import Case, File, parts_of
from pixel_codings import grey_values_of, highest_first, lossless_jpeg, lzw, pack_bits, swapped

# Name of a compression: its TIFF code, its function, whether a checksum protects the pixels.
COMPRESSIONS = {
    "none": (1, bytes, "raw"),
    "lzw": (5, lzw, "raw"),
    "deflate": (8, zlib.compress, "checked"),
    "packbits": (32773, pack_bits, "raw"),
}


def _tiles(frame: bytes, columns: int, rows: int) -> list[bytes]:
    """Returns the tiles of a frame, from left to right, then downwards. Zeros fill them up at the edges."""
    lines = [frame[k : k + 2 * frame_parts.WIDTH] for k in range(0, len(frame), 2 * frame_parts.WIDTH)]
    return [
        b"".join(line[x : x + 2 * columns].ljust(2 * columns, b"\0") for line in lines[y : y + rows]).ljust(
            2 * columns * rows, b"\0"
        )
        for y in range(0, frame_parts.HEIGHT, rows)
        for x in range(0, 2 * frame_parts.WIDTH, 2 * columns)
    ]


def tiff(
    name: str,
    frames: list[bytes],
    compression: str,
    order: str = "<",
    rows: int = frame_parts.HEIGHT,
    big: bool = False,
    columns: int = 0,
) -> File:
    """Makes a TIFF file. Each page has its pixels before its directory, in strips of `rows` rows, or in tiles of
    `columns` columns and `rows` rows."""
    code, pack, kind = COMPRESSIONS[compression]
    offset, count = ("Q", "Q") if big else ("I", "H")
    made = File(name, b"")
    first = struct.pack(order + "2sHHHQ", b"II" if order == "<" else b"MM", 43, 8, 0, 0) if big else None
    made.data = first or struct.pack(order + "2sHI", b"II" if order == "<" else b"MM", 42, 0)
    link = 8 if big else 4  # where the offset of the next directory goes
    for frame in map(swapped, frames) if order == ">" else frames:
        step = 2 * frame_parts.WIDTH * rows
        pieces = [frame[k : k + step] for k in range(0, len(frame), step)]
        strips = [pack(piece) for piece in (_tiles(frame, columns, rows) if columns else pieces)]
        offsets = []
        for strip in strips:
            offsets.append(len(made.data))
            getattr(made, kind).append((len(made.data), len(made.data) + len(strip)))
            made.data += strip
        tables = {}
        places, sizes = (324, 325) if columns else (273, 279)
        for tag, values in ((places, offsets), (sizes, [len(strip) for strip in strips])):
            tables[tag] = values
            if len(values) > 1:
                tables[tag] = [len(made.data)]
                made.data += struct.pack(order + f"{len(values)}I", *values)
        made.data += b"\0" * (len(made.data) % 2)
        entries = [
            (256, 3, 1, frame_parts.WIDTH),
            (257, 3, 1, frame_parts.HEIGHT),
            (258, 3, 1, 16),
            (259, 3, 1, code),
            (262, 3, 1, 1),
        ]
        entries += [(277, 3, 1, 1)]
        entries += [(322, 3, 1, columns), (323, 3, 1, rows)] if columns else [(278, 3, 1, rows)]
        entries += [(tag, 4, len(strips), values[0]) for tag, values in tables.items()]
        entries.sort()
        directory = len(made.data)
        made.data = (
            made.data[:link] + struct.pack(order + offset, directory) + made.data[link + struct.calcsize(offset) :]
        )
        made.data += struct.pack(order + count, len(entries))
        for tag, kind_of_value, values, value in entries:
            short = kind_of_value == 3
            made.data += struct.pack(order + "HH" + offset, tag, kind_of_value, values)
            room = 8 if big else 4
            made.data += struct.pack(order + ("H" if short else "I"), value).ljust(room, b"\0")
        link = len(made.data)
        made.data += struct.pack(order + offset, 0)
    return made


def described(frames: list[bytes], axes: str = "") -> File:
    """Makes a stack as ImageJ writes it above 4 GiB: one page, followed by the images that its description counts.
    `axes` replaces the number of slices in the description."""
    text = f"ImageJ=1.53t\nimages={len(frames)}\n{axes or f'slices={len(frames)}'}\n\0".encode()
    step = 2 * frame_parts.WIDTH * frame_parts.HEIGHT
    entries = [(256, 4, 1, frame_parts.WIDTH), (257, 4, 1, frame_parts.HEIGHT), (258, 3, 1, 16), (262, 3, 1, 1)]
    begin = 8 + 2 + 12 * (len(entries) + 5) + 4
    entries += [
        (270, 2, len(text), begin),
        (273, 4, 1, begin + len(text)),
        (277, 3, 1, 1),
        (278, 4, 1, frame_parts.HEIGHT),
    ]
    entries += [(279, 4, 1, step)]
    directory = struct.pack(">2sHIH", b"MM", 42, 8, len(entries))
    for tag, kind, values, value in entries:
        directory += struct.pack(">HHI", tag, kind, values) + struct.pack(">H" if kind == 3 else ">I", value).ljust(
            4, b"\0"
        )
    header = directory + struct.pack(">I", 0) + text
    return parts_of("s.tif", ("header", header), *(("raw", swapped(frame)) for frame in frames))


def tiffs(frames: list[bytes]) -> list[Case]:
    stacks = [("tiff " + compression, dict(compression=compression)) for compression in COMPRESSIONS]
    stacks += [
        ("tiff big-endian", dict(compression="none", order=">")),
        ("tiff strips", dict(compression="none", rows=5)),
        ("tiff deflate strips", dict(compression="deflate", rows=5)),
        ("bigtiff", dict(compression="none", big=True)),
        ("tiff tiles", dict(compression="none", columns=32, rows=16)),
        ("tiff deflate tiles", dict(compression="deflate", columns=32, rows=16)),
        ("tiff lzw tiles", dict(compression="lzw", columns=16, rows=48, order=">")),
        ("bigtiff tiles", dict(compression="deflate", columns=16, rows=16, big=True)),
    ]
    names = [f"f{t}.tif" for t in range(len(frames))]
    return [Case(name, [tiff("s.tif", frames, **how)], ["s.tif"]) for name, how in stacks] + [
        Case("tiff imagej", [described(frames)], ["s.tif"]),
        Case("tiff list", [tiff(name, [frame], "none") for name, frame in zip(names, frames, strict=True)], names),
    ]


def dng(name: str, frame: bytes, bits: int, jpeg: bool = False) -> File:
    """Makes a DNG file of a monochrome sensor, which has one report. Its only strip lies before the directory."""
    grey_values = grey_values_of([frame], bits)
    if jpeg:
        pixels = lossless_jpeg(grey_values, bits)
    elif bits == 16:
        pixels = frame
    else:
        pixels = b"".join(
            highest_first(grey_values[y : y + frame_parts.WIDTH], bits)
            for y in range(0, len(grey_values), frame_parts.WIDTH)
        )
    texts = b"Maker\0Model 1\0"
    made = parts_of(name, ("header", b""), ("raw", pixels))
    made.raw = [(8, 8 + len(pixels))]
    end = 8 + len(pixels) + len(texts)
    made.data = struct.pack("<2sHI", b"II", 42, end) + pixels + texts
    entries = [(254, 4, 1, 0), (256, 4, 1, frame_parts.WIDTH), (257, 4, 1, frame_parts.HEIGHT), (258, 3, 1, bits)]
    entries += [(259, 3, 1, 7 if jpeg else 1)]
    entries += [(262, 3, 1, 34892), (271, 2, 6, 8 + len(pixels)), (272, 2, 8, 14 + len(pixels)), (273, 4, 1, 8)]
    entries += [(277, 3, 1, 1), (278, 4, 1, frame_parts.HEIGHT), (279, 4, 1, len(pixels))]
    entries += [(50706, 1, 4, 0x401), (50714, 4, 1, 0), (50717, 4, 1, (1 << bits) - 1)]
    made.data += struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *entry) for entry in entries)
    made.data += struct.pack("<I", 0)
    return made


def dngs(frames: list[bytes]) -> list[Case]:
    """Returns raw files of a camera: 16 bits, packed, JPEG without loss."""
    names = [f"f{t}.dng" for t in range(len(frames))]
    return [
        Case(
            f"dng {bits}{' jpeg' * jpeg}",
            [dng(name, frame, bits, jpeg) for name, frame in zip(names, frames, strict=True)],
            names,
        )
        for bits, jpeg in ((16, False), (14, False), (12, False), (12, True))
    ]

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Damages that once crashed a tool, stopped it, or were accepted. Each has to be refused."""

import os
import struct
import zlib
from collections.abc import Callable

from frame_files import all_cases, png_chunk
from frame_parts import HEIGHT, WIDTH, Case, File

Change = Callable[[bytes], bytes]


def _replace(old: bytes, new: bytes) -> Change:
    def change(data: bytes) -> bytes:
        assert data.count(old) >= 1, old
        return data.replace(old, new, 1)

    return change


def _entry(data: bytes, tag: int, page: int = 0) -> int:
    """Returns the position of the entry of a tag in a little-endian TIFF."""
    (at,) = struct.unpack_from("<I", data, 4)
    for _ in range(page):
        (count,) = struct.unpack_from("<H", data, at)
        (at,) = struct.unpack_from("<I", data, at + 2 + 12 * count)
    (count,) = struct.unpack_from("<H", data, at)
    for entry in range(at + 2, at + 2 + 12 * count, 12):
        if struct.unpack_from("<H", data, entry) == (tag,):
            return entry
    raise AssertionError(tag)


def _tag(tag: int, value: int, page: int = 0) -> Change:
    def change(data: bytes) -> bytes:
        at = _entry(data, tag, page) + 8
        return data[:at] + struct.pack("<I", value) + data[at + 4 :]

    return change


def _same_strip(data: bytes) -> bytes:
    """Makes the second page show the pixels of the first page."""
    (offset,) = struct.unpack_from("<I", data, _entry(data, 273) + 8)
    return _tag(273, offset, page=1)(data)


def _rename_tag(tag: int, name: int) -> Change:
    def change(data: bytes) -> bytes:
        at = _entry(data, tag)
        return data[:at] + struct.pack("<H", name) + data[at + 2 :]

    return change


def _loop(data: bytes) -> bytes:
    """Makes the first page follow the last page."""
    return data[:-4] + data[4:8]


def _flip(at: int) -> Change:
    def change(data: bytes) -> bytes:
        k = at % len(data)
        return data[:k] + bytes([data[k] ^ 0x10]) + data[k + 1 :]

    return change


def _png_without(kind: bytes) -> Change:
    def change(data: bytes) -> bytes:
        at = data.index(kind) - 4
        (length,) = struct.unpack_from(">I", data, at)
        return data[:at] + data[at + 12 + length :]

    return change


def _png_header(width: int, height: int, depth: int = 16, colour: int = 0) -> Change:
    return lambda data: (
        data[:8] + png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)) + data[33:]
    )


def _at(place: int, number: int) -> Change:
    return lambda data: data[:place] + struct.pack("<I", number) + data[place + 4 :]


# Format, what is wrong, how the first file is changed.
FOUND: list[tuple[str, str, Change]] = [
    ("mha", "bytes are left over", lambda data: data + b"\0\0"),
    ("mha", "cut off", lambda data: data[:-1]),
    ("mha", "no pixels", lambda data: data[: data.index(b"LOCAL") + 6]),
    ("mha", "ten dimensions", _replace(b"NDims = 3", b"NDims = 10")),
    ("mha", "no dimensions", _replace(b"NDims = 3", b"NDims = -1")),
    ("mha", "a long comment", _replace(b"BinaryData =", b"Comment = " + b"x" * 5000 + b"\nBinaryData =")),
    ("mha", "a header size inside the header", _replace(b"BinaryData =", b"HeaderSize = 20\nBinaryData =")),
    ("mha", "pixels as text", _replace(b"BinaryData = True", b"BinaryData = False")),
    ("mha", "a size that wraps", _replace(f"{WIDTH} {HEIGHT} 8".encode(), b"4294967296 4294967296 8")),
    ("mha", "more than a machine has", _replace(f"{WIDTH} {HEIGHT} 8".encode(), b"999999 999999 9999")),
    ("mha", "three channels", _replace(b"ElementType", b"ElementNumberOfChannels = 3\nElementType")),
    ("mha", "a pattern of files", _replace(b"LOCAL", b"%03d.raw 1 8 1")),
    ("mha", "itself as data file", _replace(b"LOCAL", b"s.mha")),
    ("mha zlib", "a flipped bit", _flip(-100)),
    ("mha zlib", "no size of its stream", _replace(b"CompressedDataSize", b"CompressedDataSoze")),
    ("mhd", "a device as data file", _replace(b"s.raw", b"/dev/zero")),
    ("nrrd", "a line of 5,000 characters", _replace(b"# frames", b"# " + b"y" * 5000)),
    ("nrrd", "text instead of pixels", _replace(b"encoding: raw", b"encoding: ascii")),
    ("nrrd", "itself as data file", _replace(b"\n\n", b"\ndata file: s.nrrd\n\n")),
    ("nrrd", "a frame too few", lambda data: data[: -2 * WIDTH * HEIGHT]),
    ("nrrd gzip", "a flipped bit", _flip(-2000)),
    ("nrrd gzip", "a flipped bit of its checksum", _flip(-8)),
    ("nrrd gzip", "its checksum is missing", lambda data: data[:-8]),
    ("tiff none", "pages in a circle", _loop),
    ("tiff none", "two pages share their pixels", _same_strip),
    ("tiff none", "a strip beyond the end", _tag(273, 25000)),
    ("tiff none", "a strip of 2 bytes", _tag(279, 2)),
    ("tiff none", "a strip of no bytes", _tag(279, 0)),
    ("tiff none", "no counts of bytes", _rename_tag(279, 65000)),
    ("tiff none", "a tag of tiles", _rename_tag(278, 322)),
    ("tiff tiles", "a tile of no columns", _tag(322, 0)),
    ("tiff tiles", "tiles wider than the frame", _tag(322, 64)),
    ("tiff tiles", "tiles that share their pixels", lambda data: _tag(324, 8)(_tag(325, 8)(data))),
    ("tiff tiles", "a tag of strips", _rename_tag(324, 273)),
    ("tiff deflate tiles", "a flipped bit", _flip(700)),
    ("tiff none", "16 samples a pixel", _tag(277, 16)),
    ("tiff none", "24 bits", _tag(258, 24)),
    ("tiff none", "a width of 4 billion", lambda data: _tag(256, 0xFFFF)(data)),
    ("tiff none", "a palette", _tag(262, 3)),
    ("tiff none", "JPEG", _tag(259, 7)),
    ("tiff deflate", "a flipped bit", _flip(700)),
    ("tiff deflate", "a flipped bit of a checksum", lambda data: _flip(8 + len(zlib.compress(b"")) + 2000)(data)),
    ("tiff list", "a page cut off", lambda data: data[:-30]),
    ("ser", "colours", _at(18, 100)),
    ("ser", "a frame too many", _at(38, 9)),
    ("ser", "a width of 4 billion", _at(26, 0xFFFFFFFF)),
    ("ser", "sizes whose product wraps", lambda data: _at(26, 2**31 - 1)(_at(30, 2**31 - 1)(data))),
    ("ser", "32 bits", _at(34, 32)),
    ("ser", "cut off", lambda data: data[:-1]),
    ("ser bayer", "half of the times", lambda data: data[:-32]),
    ("mraw 12", "a frame too many", _replace(b">8<", b">9<")),
    ("mraw 12", "a frame too few", _replace(b">8<", b">7<")),
    ("mraw 12", "11 bits", _replace(b"<bit>12", b"<bit>11")),
    ("mraw 12", "two widths", _replace(b"<width>", b"<width>7</width><width>")),
    ("mraw 12", "an element that stays open", _replace(b"</colorInfo>", b"")),
    ("raw", "a byte too many", lambda data: data + b"a"),
    ("raw packed", "cut off", lambda data: data[:-1]),
    ("dng 16", "no directory", _at(4, 0)),
    ("png list", "a checksum", _flip(-1)),
    ("png list", "no pixels", _png_without(b"IDAT")),
    ("png list", "no end", lambda data: data[:-12]),
    ("png list", "a flipped bit", _flip(500)),
    ("png list", "colours", _png_header(WIDTH, HEIGHT, 8, 2)),
    ("png list", "a palette without colours", _png_header(WIDTH, HEIGHT, 8, 3)),
    ("png list", "a height of no pixels", _png_header(WIDTH, 0)),
    ("png list", "more rows than pixels", _png_header(WIDTH, HEIGHT + 1)),
]


def known_cases(frames: list[bytes]) -> list[tuple[str, Case]]:
    """Returns descriptions of the damages, each with its files."""
    formats = {case.name: case for case in all_cases(frames)}
    made = []
    for name, what, change in FOUND:
        case = formats[name]
        first, *rest = case.files
        changed = change(first.data)
        assert changed != first.data, (name, what)
        made.append((f"{name}: {what}", Case(name, [File(first.name, changed), *rest], case.frames, case.raw)))
    return made


def misplaced(folder: str) -> list[tuple[str, str]]:
    """Makes paths that are no file of frames: a folder, a pipe without a writer, a device, a missing file."""
    os.makedirs(folder)
    pipe = os.path.join(folder, "pipe.tif")
    os.mkfifo(pipe)
    device = os.path.join(folder, "device.mha")
    os.symlink("/dev/zero", device)
    empty = os.path.join(folder, "empty.png")
    open(empty, "wb").close()
    circle = os.path.join(folder, "circle.nrrd")
    os.symlink("circle.nrrd", circle)
    return [
        ("a folder", folder),
        ("a pipe", pipe),
        ("a device", device),
        ("no bytes", empty),
        ("a circle of links", circle),
    ]

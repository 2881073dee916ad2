#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes the files that a reader of the documents would have, from a simulated stack.

    python3 -m reader_files STACK.mha KIND TARGET

KIND is one of the functions below. TARGET is a file, or a pattern with one number such as frames/frame_{:03}.tif for
one file a frame. The files are made by fuzz/frame_files.py, with the standard library alone.
"""

import pathlib
import re
import struct
import sys
from collections.abc import Callable

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))

import frame_files
import frame_parts
import pixel_codings
import tiff_files

ROW_BYTES = 16  # rows of a Raspberry Pi's raw stream end at a multiple of so many bytes


def read_stack(name: str) -> list[bytes]:
    """Reads an uncompressed MetaImage of 16-bit pixels. Its size becomes the size of the files to be made."""
    header, pixels = pathlib.Path(name).read_bytes().split(b"LOCAL\n", 1)
    size = re.search(rb"DimSize = (\d+) (\d+) (\d+)", header)
    if size is None:
        sys.exit(f"{name} has no DimSize of three numbers")
    frame_parts.WIDTH, frame_parts.HEIGHT, frames = map(int, size.groups())
    length = 2 * frame_parts.WIDTH * frame_parts.HEIGHT
    return [pixels[length * t : length * (t + 1)] for t in range(frames)]


def write(name: str | pathlib.Path, data: bytes) -> None:
    """Writes a file, and makes its folder first."""
    path = pathlib.Path(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def tif(frames: list[bytes], target: str) -> None:
    """Writes uncompressed TIFF, one frame a file, or one stack if the target has no number."""
    rows = frame_parts.HEIGHT
    groups = [[frame] for frame in frames] if "{" in target else [frames]
    for number, group in enumerate(groups):
        write(target.format(number), tiff_files.tiff("s.tif", group, "none", rows=rows).data)


def hyperstack(frames: list[bytes], target: str) -> None:
    """Writes a hyperstack of ImageJ with 2 channels and 3 planes, which are alike."""
    axes = f"channels=2\nslices=3\nframes={len(frames)}\nhyperstack=true"
    write(target, tiff_files.described([frame for frame in frames for _ in range(6)], axes).data)


def first_case(frames: list[bytes], target: str, make: Callable[[list[bytes]], list], name: str) -> None:
    """Writes the case of frame_files that has this name: its header beside it takes the target's name, too."""
    case = next(case for case in make(frames) if case.name == name)
    for file in case.files:
        write(pathlib.Path(target).with_suffix(pathlib.Path(file.name).suffix), file.data)


def ser(frames: list[bytes], target: str) -> None:
    """Writes a SER recording of 16 bits."""
    first_case(frames, target, frame_files.sers, "ser")


def ser_bayer(frames: list[bytes], target: str) -> None:
    """Writes a SER recording of a colour camera, pattern RGGB."""
    first_case(frames, target, frame_files.sers, "ser bayer")


def fits(frames: list[bytes], target: str) -> None:
    """Writes FITS files, one frame each, or one of three axes."""
    for number, group in enumerate([[frame] for frame in frames] if "{" in target else [frames]):
        first_case(group, target.format(number), frame_files.fitses, "fits")


def mraw(frames: list[bytes], target: str) -> None:
    """Writes a Photron recording of 12 bits, .mraw and .cihx."""
    first_case(frames, target, frame_files.mraws, "mraw 12")


def dng(frames: list[bytes], target: str) -> None:
    """Writes raw files of a camera, one frame a file, 14 bits."""
    for number, frame in enumerate(frames):
        write(target.format(number), tiff_files.dng("s.dng", frame, 14).data)


def dng_levels(frames: list[bytes], target: str) -> None:
    """Writes a raw file of a camera, 14 bits, of a black level of 100 DN and a white level of 4095 DN."""
    data = tiff_files.dng("s.dng", frames[0], 14).data
    for tag, old, level in ((50714, 0, 100), (50717, 16383, 4095)):
        entry = struct.pack("<HHII", tag, 4, 1, old)
        data = data.replace(entry, struct.pack("<HHII", tag, 4, 1, level))
    write(target, data)


def png(frames: list[bytes], target: str) -> None:
    """Writes PNG files of 16 bits, one frame a file."""
    for number, frame in enumerate(frames):
        first_case([frame], target.format(number), frame_files.pngs, "png list")


def raw(frames: list[bytes], target: str) -> None:
    """Writes 16-bit pixels without a header, one frame a file or all in one."""
    for number, group in enumerate([[frame] for frame in frames] if "{" in target else [frames]):
        write(target.format(number), b"".join(group))


def raw_gap(frames: list[bytes], target: str) -> None:
    """Writes 16-bit pixels without a header, 800 other bytes behind each frame."""
    write(target, b"".join(frame + bytes(800) for frame in frames))


def mono12p(frames: list[bytes], target: str) -> None:
    """Writes 12 packed bits, the lowest first, one frame a file."""
    for number, frame in enumerate(frames):
        write(target.format(number), pixel_codings.lowest_first(pixel_codings.grey_values_of([frame], 12), 12))


def raspberry(frames: list[bytes], target: str) -> None:
    """Writes a stream of 12-bit frames as MIPI CSI-2 packs them, whose rows end at a multiple of ROW_BYTES."""
    made = bytearray()
    for frame in frames:
        grey_values = pixel_codings.grey_values_of([frame], 12)
        for start in range(0, len(grey_values), frame_parts.WIDTH):
            row = bytearray()
            for first, second in zip(*[iter(grey_values[start : start + frame_parts.WIDTH])] * 2, strict=True):
                row += bytes((first >> 4, second >> 4, (second & 15) << 4 | first & 15))
            made += row + bytes(-len(row) % ROW_BYTES)
    write(target, bytes(made))


KINDS = (tif, hyperstack, ser, ser_bayer, fits, mraw, dng, dng_levels, png, raw, raw_gap, mono12p, raspberry)


def main() -> None:
    stack, kind, target = sys.argv[1:]
    makers = {make.__name__.replace("_", "-"): make for make in KINDS}
    makers[kind](read_stack(stack), target)


if __name__ == "__main__":
    main()

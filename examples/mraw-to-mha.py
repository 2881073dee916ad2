#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Unpacks raw frames of a Photron camera (.mraw, 12 bits a pixel) into a MetaImage stack (.mha, unsigned short).

    mraw-to-mha.py ball_12bit.mraw ball.mha --size 384x384
    estimate-sensor-noise ball.mha

The .mraw file has no header: the size is in the .cihx file beside it. Two pixels are packed in three bytes, the high
bits first; rows from top to bottom, frames one after the other. Needs Python 3 and nothing else.
"""

import argparse
import array
import os
import re
import sys
import tempfile


def frame_size(text):
    """Width and height of "WxH"."""
    match = re.fullmatch(r"([1-9][0-9]{0,4})x([1-9][0-9]{0,4})", text)
    if not match:
        raise argparse.ArgumentTypeError(f'"{text}" is no size; expected WIDTHxHEIGHT in pixels, for example 384x384')
    width, height = int(match[1]), int(match[2])
    if width * height % 2:
        raise argparse.ArgumentTypeError(f"{text} is an odd number of pixels, but two are packed together")
    return width, height


def number_of_frames(text):
    """A number above 0."""
    if not re.fullmatch(r"[1-9][0-9]*", text):
        raise argparse.ArgumentTypeError(f'"{text}" is no number of frames; expected 1 or more')
    return int(text)


def unpacked(packed):
    """The pixels of whole triples of bytes: p0 = b0 << 4 | b1 >> 4, p1 = (b1 & 15) << 8 | b2."""
    pixels = array.array("H", bytes(len(packed) // 3 * 4))
    pixels[0::2] = array.array("H", [a << 4 | b >> 4 for a, b in zip(packed[0::3], packed[1::3], strict=True)])
    pixels[1::2] = array.array("H", [(b & 15) << 8 | c for b, c in zip(packed[1::3], packed[2::3], strict=True)])
    return pixels


def convert(source, target, size, frames):
    """Writes the target whole or not at all; raises OSError or ValueError."""
    width, height = size
    frame_bytes = width * height * 3 // 2
    found, rest = divmod(os.path.getsize(source), frame_bytes)
    if rest or found == 0:
        raise ValueError(
            f"{source} has {os.path.getsize(source)} bytes; "
            f"expected a multiple of {frame_bytes}, those of a frame of {width}x{height} pixels at 12 bits"
        )
    if frames is not None and frames > found:
        raise ValueError(f"{source} has {found} frames; expected at least the {frames} that --frames asks for")
    frames = frames or found
    if not target.endswith(".mha"):
        raise ValueError(f"the output is {target}; expected a name that ends in .mha")
    header = (
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
        f"DimSize = {width} {height} {frames}\nElementType = MET_USHORT\nElementDataFile = LOCAL\n"
    )
    folder = os.path.dirname(target) or "."
    if not os.path.isdir(folder):
        raise ValueError(f"cannot write {target}: there is no folder {folder}")
    with open(source, "rb") as packed, tempfile.TemporaryDirectory(dir=folder, prefix=".mraw-to-mha-") as pending:
        stack_name = os.path.join(pending, "stack.mha")
        with open(stack_name, "wb") as stack:
            stack.write(header.encode("ascii"))
            for _ in range(frames):
                pixels = unpacked(packed.read(frame_bytes))
                if sys.byteorder == "big":
                    pixels.byteswap()
                pixels.tofile(stack)
        os.replace(stack_name, target)


def main():
    """Exit code 0: done, 2: wrong use or unreadable input."""
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n", maxsplit=1)[0],
        epilog="The size stands in the .cihx file beside the .mraw file.",
    )
    parser.add_argument("input", metavar="INPUT.mraw")
    parser.add_argument("output", metavar="OUTPUT.mha")
    parser.add_argument("--size", metavar="WxH", type=frame_size, required=True, help="width and height in pixels")
    parser.add_argument("--frames", metavar="N", type=number_of_frames, help="only the first N frames; else all")
    options = parser.parse_args()
    try:
        convert(options.input, options.output, options.size, options.frames)
    except OSError as error:
        print(f"{parser.prog}: {error.filename or options.output}: {error.strerror}", file=sys.stderr)
        return 2
    except ValueError as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())

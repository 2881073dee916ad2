# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Codings of 16-bit pixels, made with the standard library alone: bits, bytes, compressions."""

import struct
import zlib

import frame_parts


def gzip_stream(data: bytes) -> bytes:
    packer = zlib.compressobj(6, zlib.DEFLATED, 31)
    return packer.compress(data) + packer.flush()


def lzw(data: bytes) -> bytes:
    """Returns LZW without a dictionary: a code that clears it comes before codes would need a tenth bit."""
    bits = []
    for start in range(0, len(data), 250):
        bits += [256, *data[start : start + 250]]
    bits.append(257)
    number = 0
    for code in bits:
        number = number << 9 | code
    spare = -9 * len(bits) % 8
    return (number << spare).to_bytes((9 * len(bits) + spare) // 8, "big")


def pack_bits(data: bytes) -> bytes:
    """Returns a literal run of bytes for each row, because no run may go beyond its row."""
    rows = (data[k : k + 2 * frame_parts.WIDTH] for k in range(0, len(data), 2 * frame_parts.WIDTH))
    return b"".join(bytes([len(row) - 1]) + row for row in rows)


def swapped(frame: bytes) -> bytes:
    """Returns the same 16-bit pixels in the other byte order."""
    return b"".join(frame[k + 1 : k + 2] + frame[k : k + 1] for k in range(0, len(frame), 2))


def grey_values_of(frames: list[bytes], bits: int) -> list[int]:
    """Returns the pixels with `bits` bits. Higher bits are cut off."""
    pixels = b"".join(frames)
    return [grey_value & (1 << bits) - 1 for grey_value in struct.unpack(f"<{len(pixels) // 2}H", pixels)]


def highest_first(grey_values: list[int], bits: int) -> bytes:
    """Returns a stream of bits, the highest first, in pieces of eight grey values."""
    made = b""
    for start in range(0, len(grey_values), 8):
        number = 0
        for grey_value in grey_values[start : start + 8]:
            number = number << bits | grey_value
        made += number.to_bytes(bits, "big")
    return made


def lowest_first(grey_values: list[int], bits: int) -> bytes:
    made = b""
    for start in range(0, len(grey_values), 8):
        number = sum(grey_value << bits * k for k, grey_value in enumerate(grey_values[start : start + 8]))
        made += number.to_bytes(bits, "little")
    return made


def lossless_jpeg(grey_values: list[int], bits: int) -> bytes:
    """Returns JPEG without loss (ITU-T T.81, Annex H): each grey value by its left neighbour, lengths of differences as
    codes of 5 bits."""

    def segment(marker: int, content: bytes) -> bytes:
        return struct.pack(">BBH", 0xFF, marker, len(content) + 2) + content

    number = "".join(_difference(grey_values, i, bits) for i in range(len(grey_values)))
    number += "1" * (-len(number) % 8)
    pixels = int(number, 2).to_bytes(len(number) // 8, "big").replace(b"\xff", b"\xff\0")
    table = bytes([0] * 5 + [17] + [0] * 11) + bytes(range(17))
    size = struct.pack(">BHHBBBB", bits, frame_parts.HEIGHT, frame_parts.WIDTH, 1, 0, 0x11, 0)
    scan = segment(0xDA, bytes([1, 0, 0, 1, 0, 0]))
    return b"\xff\xd8" + segment(0xC4, table) + segment(0xC3, size) + scan + pixels + b"\xff\xd9"


def _difference(grey_values: list[int], i: int, bits: int) -> str:
    first = 1 << bits - 1 if i < frame_parts.WIDTH else grey_values[i - frame_parts.WIDTH]
    value = grey_values[i] - (grey_values[i - 1] if i % frame_parts.WIDTH else first)
    length = abs(value).bit_length()
    low = value if value >= 0 else value + (1 << length) - 1
    return f"{length:05b}" + (f"{low:0{length}b}" if length else "")

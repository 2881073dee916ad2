# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Seeded damages of a file: of its bytes, its text, its structure, and its place in the file system."""

import os
import re
import struct
import zlib
from random import Random

# Values that break arithmetic, and offsets at which these small files have something.
FIELDS = [0, 1, 2, 3, 4, 8, 10, 16, 42, 255, 256, 348, 1000, 3080, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1]
NUMBERS = ["", "0", "-1", "1", "2", "3", "4", "5", "17", "255", "65536", "99999", "2147483648", "4294967297"]
NUMBERS += ["9223372036854775807", "18446744073709551617", "1e308", "nan", "0x10", "1.5", "-2147483648"]
WORDS = [b"LIST", b"LOCAL", b"s.mhd", b"s.nhdr", b"%03d.raw 1 3 1", b"/dev/zero", b"..", b"True", b"MET_FLOAT", b"gzip"]
WORDS += [b"ascii", b"hex", b"bzip2", b"MET_USHORT_ARRAY", b"double", b"block", b"skip"]


def flip_bits(data: bytearray, random: Random) -> None:
    for _ in range(random.choice([1, 1, 1, 2, 8, 64])):
        at = random.randrange(len(data) if random.random() < 0.5 else min(len(data), 600))
        data[at] ^= 1 << random.randrange(8)


def set_bytes(data: bytearray, random: Random) -> None:
    start = random.randrange(len(data))
    for at in range(start, min(len(data), start + random.choice([1, 4, 40]))):
        data[at] = random.choice([0, 1, 0x20, 0x7F, 0x80, 0xFF])


def set_field(data: bytearray, random: Random) -> None:
    """Changes a number, often near the beginning or the end, where header fields are. The directory of a TIFF often is
    at the end."""
    form = random.choice("<>") + random.choice("HIIQ")
    size = struct.calcsize(form)
    if len(data) < size:
        return
    last = len(data) - size
    at = random.choice(
        [random.randint(0, last), random.randint(0, min(last, 400)), random.randint(max(0, last - 160), last)]
    )
    struct.pack_into(form, data, at, random.choice([*FIELDS, len(data), len(data) - 2]) % 256**size)


def truncate(data: bytearray, random: Random) -> None:
    del data[random.choice([0, 1, len(data) // 2, len(data) - 1, random.randrange(len(data))]) :]


def append(data: bytearray, random: Random) -> None:
    data += random.choice([b"\0", b"\n", bytes(data[:100]), bytes(data), random.randbytes(1000)])


def cut(data: bytearray, random: Random) -> None:
    start = random.randrange(len(data))
    del data[start : start + random.choice([1, 2, 12, 500])]


def double(data: bytearray, random: Random) -> None:
    start = random.randrange(len(data))
    data[start:start] = data[start : start + random.choice([1, 2, 12, 500])]


def change_number(data: bytearray, random: Random) -> None:
    found = list(re.finditer(rb"\d+", bytes(data[:500])))
    if found:
        one = random.choice(found)
        data[one.start() : one.end()] = random.choice(NUMBERS).encode()


def change_word(data: bytearray, random: Random) -> None:
    found = list(re.finditer(rb"[A-Za-z.]{3,}", bytes(data[:500])))
    if found:
        one = random.choice(found)
        data[one.start() : one.end()] = random.choice(WORDS)


def change_line(data: bytearray, random: Random) -> None:
    end = data.find(b"\n\n", 0, 600)
    lines = bytes(data[: end if end >= 0 else 300]).split(b"\n")
    at = random.randrange(len(lines))
    long = random.choice([255, 300, 1100, 70000])
    line = random.choice(
        [
            b"",
            lines[at] + b"\n" + lines[at],
            b"Comment = " + b"x" * long,
            b"# " + b"y" * long,
            lines[at] + b" " * long,
            b"A:=" + b"z" * long,
        ]
    )
    data[: len(b"\n".join(lines))] = b"\n".join([*lines[:at], line, *lines[at + 1 :]])


def change_chunk(data: bytearray, random: Random) -> None:
    """Changes a chunk of a PNG and corrects its checksum, so that the checksum does not reveal the damage."""
    chunks = []
    at = 8
    while at + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        chunks.append((at, min(length, len(data) - at - 12)))
        at += length + 12
    if data[:4] != b"\x89PNG" or not chunks:
        flip_bits(data, random)
        return
    at, length = random.choice(chunks)
    kind = random.choice([bytes(data[at + 4 : at + 8])] * 4 + [b"IDAT", b"PLTE", b"sBIT", b"tRNS", b"IEND", b"zzzz"])
    inside = bytearray(data[at + 8 : at + 8 + length])
    if kind == b"sBIT":
        inside = bytearray([random.choice([0, 1, 10, 12, 16, 17])])
    elif inside:
        random.choice([flip_bits, set_bytes, cut, double])(inside, random)
    made = struct.pack(">I", len(inside)) + kind + inside + struct.pack(">I", zlib.crc32(kind + inside))
    if random.random() < 0.3:
        made += bytes(data[at : at + 12 + length])
    data[at : at + 12 + length] = made


BYTES = [flip_bits, flip_bits, set_bytes, set_field, set_field, truncate, append, cut, double]
TEXT = [change_number, change_number, change_word, change_line]


def mutate(data: bytes, random: Random) -> tuple[str, bytes]:
    """Returns the name of a change, and the changed bytes."""
    changes = list(BYTES)
    if data[:8].isascii():
        changes += 2 * TEXT
    if data[:4] == b"\x89PNG":
        changes += 4 * [change_chunk]
    change = random.choice(changes)
    made = bytearray(data)
    for _ in range(random.choice([1, 1, 1, 2, 4])):
        if made:
            change(made, random)
    return change.__name__.replace("_", " "), bytes(made)


def misplace(path: str, random: Random) -> str:
    """Puts something else in the place of a file; returns what."""
    what = random.choice(["missing", "folder", "pipe", "loop", "device", "unreadable"])
    os.remove(path)
    if what == "folder":
        os.mkdir(path)
    elif what == "pipe":
        os.mkfifo(path)
    elif what == "loop":
        os.symlink(os.path.basename(path), path)
    elif what == "device":
        os.symlink(random.choice(["/dev/zero", "/dev/null", "/dev/tty"]), path)
    elif what == "unreadable":
        with open(path, "wb"):
            os.chmod(path, 0)
    return what

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Undamaged files of small 16-bit frames, in the formats that a user may have, made with the standard library alone."""

import struct
import zlib

import frame_parts
from frame_parts import Case, File, parts_of, whole
from pixel_codings import grey_values_of, gzip_stream, highest_first, lowest_first, swapped
from tiff_files import dngs, tiffs


def _meta_header(frames: int, data_file: str, extra: str = "") -> bytes:
    width, height = frame_parts.WIDTH, frame_parts.HEIGHT
    return (
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        f"{extra}ElementSpacing = 1 1 1\nDimSize = {width} {height} {frames}\nElementType = MET_USHORT\n"
        f"ElementDataFile = {data_file}\n"
    ).encode()


def meta_images(frames: list[bytes]) -> list[Case]:
    pixels = b"".join(frames)
    packed = zlib.compress(pixels)
    count = len(frames)
    compressed = f"CompressedData = True\nCompressedDataSize = {len(packed)}\n"
    names = [f"frame {t}.raw" for t in range(count)]
    listed = _meta_header(count, "LIST") + "".join(name + "\n" for name in names).encode()
    return [
        Case("mha", [parts_of("s.mha", ("header", _meta_header(count, "LOCAL")), ("raw", pixels))], ["s.mha"]),
        Case(
            "mha zlib",
            [parts_of("s.mha", ("header", _meta_header(count, "LOCAL", compressed)), ("checked", packed))],
            ["s.mha"],
        ),
        Case("mhd", [File("s.mhd", _meta_header(count, "s.raw")), whole("s.raw", pixels)], ["s.mhd"]),
        Case(
            "mhd zlib",
            [File("s.mhd", _meta_header(count, "s.zraw", compressed)), parts_of("s.zraw", ("checked", packed))],
            ["s.mhd"],
        ),
        Case("mhd list", [File("s.mhd", listed), *map(whole, names, frames)], ["s.mhd"]),
    ]


def _nrrd_header(frames: int, encoding: str, extra: str = "") -> bytes:
    width, height = frame_parts.WIDTH, frame_parts.HEIGHT
    return (
        f"NRRD0004\n# frames of a camera\ntype: unsigned short\ndimension: 3\nsizes: {width} {height} {frames}\n"
        f"endian: little\nencoding: {encoding}\n{extra}"
    ).encode()


def nrrds(frames: list[bytes]) -> list[Case]:
    pixels = b"".join(frames)
    packed = gzip_stream(pixels)
    count = len(frames)
    return [
        Case("nrrd", [parts_of("s.nrrd", ("header", _nrrd_header(count, "raw") + b"\n"), ("raw", pixels))], ["s.nrrd"]),
        Case(
            "nrrd gzip",
            # the ten bytes before the stream hold a time and the like
            [
                parts_of(
                    "s.nrrd", ("header", _nrrd_header(count, "gzip") + b"\n" + packed[:10]), ("checked", packed[10:])
                )
            ],
            ["s.nrrd"],
        ),
        Case(
            "nhdr",
            [File("s.nhdr", _nrrd_header(count, "raw", "data file: s.raw\n")), whole("s.raw", pixels)],
            ["s.nhdr"],
        ),
        Case(
            "nhdr gzip",
            [
                File("s.nhdr", _nrrd_header(count, "gzip", "data file: s.raw.gz\n")),
                parts_of("s.raw.gz", ("header", packed[:10]), ("checked", packed[10:])),
            ],
            ["s.nhdr"],
        ),
    ]


def png_chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _png(name: str, frame: bytes) -> File:
    rows = b""
    for y in range(frame_parts.HEIGHT):
        row = frame[2 * frame_parts.WIDTH * y : 2 * frame_parts.WIDTH * (y + 1)]
        rows += b"\0" + b"".join(row[k + 1 : k + 2] + row[k : k + 1] for k in range(0, len(row), 2))
    header = b"\x89PNG\r\n\x1a\n" + png_chunk(
        b"IHDR", struct.pack(">IIBBBBB", frame_parts.WIDTH, frame_parts.HEIGHT, 16, 0, 0, 0, 0)
    )
    return parts_of(
        name,
        ("header", header),
        ("checked", png_chunk(b"IDAT", zlib.compress(rows))),
        ("header", png_chunk(b"IEND", b"")),
    )


def pngs(frames: list[bytes]) -> list[Case]:
    names = [f"f{t}.png" for t in range(len(frames))]
    return [Case("png list", list(map(_png, names, frames)), names)]


def sers(frames: list[bytes]) -> list[Case]:
    def header(color: int, depth: int) -> bytes:
        fields = struct.pack(
            "<14s7i", b"LUCAM-RECORDER", 0, color, 0, frame_parts.WIDTH, frame_parts.HEIGHT, depth, len(frames)
        )
        return fields + b"observer".ljust(40) + b"camera".ljust(40) + b"telescope".ljust(40) + b"\0" * 16

    pixels = b"".join(frames)
    times = struct.pack(f"<{len(frames)}Q", *range(1, len(frames) + 1))
    eight = bytes(value >> 4 & 255 for value in grey_values_of(frames, 12))
    return [
        Case("ser", [parts_of("s.ser", ("header", header(0, 16)), ("raw", pixels))], ["s.ser"]),
        Case(
            "ser bayer",
            [parts_of("s.ser", ("header", header(8, 16)), ("raw", pixels), ("header", times))],
            ["s.ser"],
        ),
        Case("ser 8", [parts_of("s.ser", ("header", header(0, 8)), ("raw", eight))], ["s.ser"]),
    ]


def _fits_unit(cards: list[tuple[str, str]], data: bytes) -> list[tuple[str, bytes]]:
    """Returns header and data of a unit, both filled up to whole blocks."""
    text = "".join(f"{key:8}= {value:>20}".ljust(80) for key, value in cards) + "END"
    filled = bytes(-len(data) % 2880)
    return [("header", text.ljust(-(-len(text) // 2880) * 2880).encode()), ("raw", data), ("header", filled)]


def fitses(frames: list[bytes]) -> list[Case]:
    sizes = [
        ("NAXIS", "3"),
        ("NAXIS1", f"{frame_parts.WIDTH}"),
        ("NAXIS2", f"{frame_parts.HEIGHT}"),
        ("NAXIS3", f"{len(frames)}"),
    ]
    grey_values = grey_values_of(frames, 16)
    unsigned = struct.pack(f">{len(grey_values)}H", *(value ^ 32768 for value in grey_values))
    wide = struct.pack(f">{len(grey_values)}i", *grey_values)
    first = [("SIMPLE", "T"), ("BITPIX", "16"), *sizes, ("BZERO", "32768"), ("BSCALE", "1")]
    empty = [("SIMPLE", "T"), ("BITPIX", "8"), ("NAXIS", "0")]
    extension = [("XTENSION", "'IMAGE   '"), ("BITPIX", "32"), *sizes, ("PCOUNT", "0"), ("GCOUNT", "1")]
    return [
        Case("fits", [parts_of("s.fits", *_fits_unit(first, unsigned))], ["s.fits"]),
        Case("fits 32", [parts_of("s.fits", *_fits_unit(empty, b""), *_fits_unit(extension, wide))], ["s.fits"]),
    ]


def npys(frames: list[bytes]) -> list[Case]:
    width, height = frame_parts.WIDTH, frame_parts.HEIGHT
    text = f"{{'descr': '<u2', 'fortran_order': False, 'shape': ({len(frames)}, {height}, {width}), }}"
    header = b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + text.ljust(117).encode() + b"\n"
    return [Case("npy", [parts_of("s.npy", ("header", header), ("raw", b"".join(frames)))], ["s.npy"])]


def pgms(frames: list[bytes]) -> list[Case]:
    header = ("header", f"P5\n{frame_parts.WIDTH} {frame_parts.HEIGHT}\n65535\n".encode())
    parts = [part for frame in frames for part in (header, ("raw", swapped(frame)))]
    return [Case("pgm", [parts_of("s.pgm", *parts)], ["s.pgm"])]


def mraws(frames: list[bytes]) -> list[Case]:
    def header(bits: int) -> File:
        text = (
            f'<?xml version="1.0"?>\n<cih>\n<deviceInfo><deviceName>camera</deviceName></deviceInfo>\n'
            f"<frameInfo><totalFrame>{len(frames)}</totalFrame></frameInfo>\n<imageDataInfo>\n"
            f"<resolution><width>{frame_parts.WIDTH}</width><height>{frame_parts.HEIGHT}</height></resolution>\n"
            f"<colorInfo><type>Raw</type><bit>{bits}</bit></colorInfo>\n"
            f"<effectiveBit><depth>{bits}</depth><side>Lower</side></effectiveBit>\n</imageDataInfo>\n</cih>\n"
        )
        return File("s.cihx", text.encode())

    packed = highest_first(grey_values_of(frames, 12), 12)
    return [
        Case("mraw 12", [header(12), whole("s.mraw", packed)], ["s.mraw"]),
        Case("mraw 16", [header(16), whole("s.mraw", b"".join(frames))], ["s.cihx"]),
    ]


def raws(frames: list[bytes]) -> list[Case]:
    """Returns files without a header. The tools can only check whether the frames are whole."""
    size = f"{frame_parts.WIDTH}x{frame_parts.HEIGHT}"
    pixels = b"".join(frames)
    packed = lowest_first(grey_values_of(frames, 12), 12)
    return [
        Case("raw", [parts_of("s.raw", ("header", b"skip"), ("raw", pixels))], ["s.raw"], f"{size}:uint16le:4"),
        Case("raw packed", [whole("s.raw", packed)], ["s.raw"], f"{size}:Mono12p"),
    ]


def others(frames: list[bytes]) -> list[Case]:
    """Formats without a check of their own."""
    width, height = frame_parts.WIDTH, frame_parts.HEIGHT
    pixels = b"".join(frames)
    count = len(frames)
    big_endian = b"".join(pixels[k + 1 : k + 2] + pixels[k : k + 1] for k in range(0, len(pixels), 2))
    vtk = "# vtk DataFile Version 3.0\nframes\n{}\nDATASET STRUCTURED_POINTS\n" + (
        f"DIMENSIONS {width} {height} {count}\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA {len(pixels) // 2}\n"
        "SCALARS scalars unsigned_short 1\nLOOKUP_TABLE default\n"
    )
    text = " ".join(map(str, struct.unpack(f"<{len(pixels) // 2}H", pixels))).encode() + b"\n"
    sizes = struct.pack("<8h", 3, width, height, count, 1, 1, 1, 1)
    nifti = struct.pack("<i36x", 348) + sizes + struct.pack("<14xhhh", 512, 16, 0) + struct.pack("<8f", *[1.0] * 8)
    nifti += struct.pack("<f", 352.0) + struct.pack("<f", 1.0)
    nifti = nifti.ljust(344, b"\0") + b"n+1\0" + b"\0\0\0\0"
    return [
        Case("vtk", [parts_of("s.vtk", ("header", vtk.format("BINARY").encode()), ("raw", big_endian))], ["s.vtk"]),
        Case("vtk text", [parts_of("s.vtk", ("header", vtk.format("ASCII").encode()), ("raw", text))], ["s.vtk"]),
        Case("nifti", [parts_of("s.nii", ("header", nifti), ("raw", pixels))], ["s.nii"]),
        Case("nifti gzip", [parts_of("s.nii.gz", ("checked", gzip_stream(nifti + pixels)))], ["s.nii.gz"]),
    ]


def all_cases(frames: list[bytes]) -> list[Case]:
    """Makes files of every format from the same frames: bytes of little-endian unsigned 16-bit pixels."""
    made: list[Case] = []
    for make in (meta_images, nrrds, tiffs, pngs, sers, fitses, npys, pgms, mraws, raws, dngs, others):
        made += make(frames)
    return made

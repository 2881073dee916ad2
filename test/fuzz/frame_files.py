# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Undamaged files of small 16-bit frames, in the formats that a user may have, made with the standard library alone."""

import struct
import zlib
from dataclasses import dataclass, field

WIDTH = 48  # pixels
HEIGHT = 32  # pixels


@dataclass
class File:
    """A file, and which of its bytes are pixels: `raw` if nothing tells that they changed, `checked` if a checksum
    does. All others are header."""

    name: str
    data: bytes
    raw: list[tuple[int, int]] = field(default_factory=list)
    checked: list[tuple[int, int]] = field(default_factory=list)


@dataclass
class Case:
    """Files, and those of them that are handed over, in time order; `raw`: how frames without a header lie."""

    name: str
    files: list[File]
    frames: list[str]
    raw: str = ""


def _whole(name: str, data: bytes) -> File:
    return File(name, data, raw=[(0, len(data))])


def _parts(name: str, *parts: tuple[str, bytes]) -> File:
    """A file of parts, each "header", "raw" or "checked"."""
    made = File(name, b"")
    for kind, data in parts:
        if kind != "header":
            getattr(made, kind).append((len(made.data), len(made.data) + len(data)))
        made.data += data
    return made


def _meta_header(frames: int, data_file: str, extra: str = "") -> bytes:
    return (
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        f"{extra}ElementSpacing = 1 1 1\nDimSize = {WIDTH} {HEIGHT} {frames}\nElementType = MET_USHORT\n"
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
        Case("mha", [_parts("s.mha", ("header", _meta_header(count, "LOCAL")), ("raw", pixels))], ["s.mha"]),
        Case(
            "mha zlib",
            [_parts("s.mha", ("header", _meta_header(count, "LOCAL", compressed)), ("checked", packed))],
            ["s.mha"],
        ),
        Case("mhd", [File("s.mhd", _meta_header(count, "s.raw")), _whole("s.raw", pixels)], ["s.mhd"]),
        Case(
            "mhd zlib",
            [File("s.mhd", _meta_header(count, "s.zraw", compressed)), _parts("s.zraw", ("checked", packed))],
            ["s.mhd"],
        ),
        Case("mhd list", [File("s.mhd", listed), *map(_whole, names, frames)], ["s.mhd"]),
    ]


def _nrrd_header(frames: int, encoding: str, extra: str = "") -> bytes:
    return (
        f"NRRD0004\n# frames of a camera\ntype: unsigned short\ndimension: 3\nsizes: {WIDTH} {HEIGHT} {frames}\n"
        f"endian: little\nencoding: {encoding}\n{extra}"
    ).encode()


def _gzip(data: bytes) -> bytes:
    packer = zlib.compressobj(6, zlib.DEFLATED, 31)
    return packer.compress(data) + packer.flush()


def nrrds(frames: list[bytes]) -> list[Case]:
    pixels = b"".join(frames)
    packed = _gzip(pixels)
    count = len(frames)
    return [
        Case("nrrd", [_parts("s.nrrd", ("header", _nrrd_header(count, "raw") + b"\n"), ("raw", pixels))], ["s.nrrd"]),
        Case(
            "nrrd gzip",
            # the ten bytes before the stream hold a time and the like
            [_parts("s.nrrd", ("header", _nrrd_header(count, "gzip") + b"\n" + packed[:10]), ("checked", packed[10:]))],
            ["s.nrrd"],
        ),
        Case(
            "nhdr",
            [File("s.nhdr", _nrrd_header(count, "raw", "data file: s.raw\n")), _whole("s.raw", pixels)],
            ["s.nhdr"],
        ),
        Case(
            "nhdr gzip",
            [
                File("s.nhdr", _nrrd_header(count, "gzip", "data file: s.raw.gz\n")),
                _parts("s.raw.gz", ("header", packed[:10]), ("checked", packed[10:])),
            ],
            ["s.nhdr"],
        ),
    ]


def _lzw(data: bytes) -> bytes:
    """Without a dictionary: a code that clears it comes before codes would need a tenth bit."""
    bits = []
    for start in range(0, len(data), 250):
        bits += [256, *data[start : start + 250]]
    bits.append(257)
    number = 0
    for code in bits:
        number = number << 9 | code
    spare = -9 * len(bits) % 8
    return (number << spare).to_bytes((9 * len(bits) + spare) // 8, "big")


def _pack_bits(data: bytes) -> bytes:
    """A run of bytes as they are for each row: none may go beyond its row."""
    rows = (data[k : k + 2 * WIDTH] for k in range(0, len(data), 2 * WIDTH))
    return b"".join(bytes([len(row) - 1]) + row for row in rows)


# Name of a compression: its TIFF code, its function, whether a checksum protects the pixels.
_TIFF = {
    "none": (1, bytes, "raw"),
    "lzw": (5, _lzw, "raw"),
    "deflate": (8, zlib.compress, "checked"),
    "packbits": (32773, _pack_bits, "raw"),
}


def _swapped(frame: bytes) -> bytes:
    """The same 16-bit pixels in the other byte order."""
    return b"".join(frame[k + 1 : k + 2] + frame[k : k + 1] for k in range(0, len(frame), 2))


def _tiles(frame: bytes, columns: int, rows: int) -> list[bytes]:
    """Returns the tiles of a frame, from left to right, then downwards. Zeros fill them up at the edges."""
    lines = [frame[k : k + 2 * WIDTH] for k in range(0, len(frame), 2 * WIDTH)]
    return [
        b"".join(line[x : x + 2 * columns].ljust(2 * columns, b"\0") for line in lines[y : y + rows]).ljust(
            2 * columns * rows, b"\0"
        )
        for y in range(0, HEIGHT, rows)
        for x in range(0, 2 * WIDTH, 2 * columns)
    ]


def _tiff(
    name: str,
    frames: list[bytes],
    compression: str,
    order: str = "<",
    rows: int = HEIGHT,
    big: bool = False,
    columns: int = 0,
) -> File:
    """Pages with their pixels before their directory; strips of `rows` rows, or tiles of `columns` columns and `rows`
    rows."""
    code, pack, kind = _TIFF[compression]
    offset, count = ("Q", "Q") if big else ("I", "H")
    made = File(name, b"")
    first = struct.pack(order + "2sHHHQ", b"II" if order == "<" else b"MM", 43, 8, 0, 0) if big else None
    made.data = first or struct.pack(order + "2sHI", b"II" if order == "<" else b"MM", 42, 0)
    link = 8 if big else 4  # where the offset of the next directory goes
    for frame in map(_swapped, frames) if order == ">" else frames:
        step = 2 * WIDTH * rows
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
        entries = [(256, 3, 1, WIDTH), (257, 3, 1, HEIGHT), (258, 3, 1, 16), (259, 3, 1, code), (262, 3, 1, 1)]
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


def _described(frames: list[bytes], axes: str = "") -> File:
    """ImageJ's stack above 4 GiB: one page, behind which the images lie that its description counts. `axes`: other
    lines of that description than the number of slices."""
    text = f"ImageJ=1.53t\nimages={len(frames)}\n{axes or f'slices={len(frames)}'}\n\0".encode()
    step = 2 * WIDTH * HEIGHT
    entries = [(256, 4, 1, WIDTH), (257, 4, 1, HEIGHT), (258, 3, 1, 16), (262, 3, 1, 1)]
    begin = 8 + 2 + 12 * (len(entries) + 5) + 4
    entries += [(270, 2, len(text), begin), (273, 4, 1, begin + len(text)), (277, 3, 1, 1), (278, 4, 1, HEIGHT)]
    entries += [(279, 4, 1, step)]
    directory = struct.pack(">2sHIH", b"MM", 42, 8, len(entries))
    for tag, kind, values, value in entries:
        directory += struct.pack(">HHI", tag, kind, values) + struct.pack(">H" if kind == 3 else ">I", value).ljust(
            4, b"\0"
        )
    header = directory + struct.pack(">I", 0) + text
    return _parts("s.tif", ("header", header), *(("raw", _swapped(frame)) for frame in frames))


def tiffs(frames: list[bytes]) -> list[Case]:
    stacks = [("tiff " + compression, dict(compression=compression)) for compression in _TIFF]
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
    return [Case(name, [_tiff("s.tif", frames, **how)], ["s.tif"]) for name, how in stacks] + [
        Case("tiff imagej", [_described(frames)], ["s.tif"]),
        Case("tiff list", [_tiff(name, [frame], "none") for name, frame in zip(names, frames, strict=True)], names),
    ]


def png_chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _png(name: str, frame: bytes) -> File:
    rows = b""
    for y in range(HEIGHT):
        row = frame[2 * WIDTH * y : 2 * WIDTH * (y + 1)]
        rows += b"\0" + b"".join(row[k + 1 : k + 2] + row[k : k + 1] for k in range(0, len(row), 2))
    header = b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0))
    return _parts(
        name,
        ("header", header),
        ("checked", png_chunk(b"IDAT", zlib.compress(rows))),
        ("header", png_chunk(b"IEND", b"")),
    )


def pngs(frames: list[bytes]) -> list[Case]:
    names = [f"f{t}.png" for t in range(len(frames))]
    return [Case("png list", list(map(_png, names, frames)), names)]


def _codes(frames: list[bytes], bits: int) -> list[int]:
    """The pixels, of so many bits: higher ones are cut off."""
    pixels = b"".join(frames)
    return [code & (1 << bits) - 1 for code in struct.unpack(f"<{len(pixels) // 2}H", pixels)]


def _highest_first(codes: list[int], bits: int) -> bytes:
    """A stream of bits, in pieces of eight codes."""
    made = b""
    for start in range(0, len(codes), 8):
        number = 0
        for code in codes[start : start + 8]:
            number = number << bits | code
        made += number.to_bytes(bits, "big")
    return made


def _lowest_first(codes: list[int], bits: int) -> bytes:
    made = b""
    for start in range(0, len(codes), 8):
        number = sum(code << bits * k for k, code in enumerate(codes[start : start + 8]))
        made += number.to_bytes(bits, "little")
    return made


def sers(frames: list[bytes]) -> list[Case]:
    def header(color: int, depth: int) -> bytes:
        fields = struct.pack("<14s7i", b"LUCAM-RECORDER", 0, color, 0, WIDTH, HEIGHT, depth, len(frames))
        return fields + b"observer".ljust(40) + b"camera".ljust(40) + b"telescope".ljust(40) + b"\0" * 16

    pixels = b"".join(frames)
    times = struct.pack(f"<{len(frames)}Q", *range(1, len(frames) + 1))
    eight = bytes(code >> 4 & 255 for code in _codes(frames, 12))
    return [
        Case("ser", [_parts("s.ser", ("header", header(0, 16)), ("raw", pixels))], ["s.ser"]),
        Case(
            "ser bayer",
            [_parts("s.ser", ("header", header(8, 16)), ("raw", pixels), ("header", times))],
            ["s.ser"],
        ),
        Case("ser 8", [_parts("s.ser", ("header", header(0, 8)), ("raw", eight))], ["s.ser"]),
    ]


def _fits_unit(cards: list[tuple[str, str]], data: bytes) -> list[tuple[str, bytes]]:
    """The parts of a unit, both filled up to whole blocks."""
    text = "".join(f"{key:8}= {value:>20}".ljust(80) for key, value in cards) + "END"
    filled = bytes(-len(data) % 2880)
    return [("header", text.ljust(-(-len(text) // 2880) * 2880).encode()), ("raw", data), ("header", filled)]


def fitses(frames: list[bytes]) -> list[Case]:
    sizes = [("NAXIS", "3"), ("NAXIS1", f"{WIDTH}"), ("NAXIS2", f"{HEIGHT}"), ("NAXIS3", f"{len(frames)}")]
    codes = _codes(frames, 16)
    unsigned = struct.pack(f">{len(codes)}H", *(code ^ 32768 for code in codes))
    wide = struct.pack(f">{len(codes)}i", *codes)
    first = [("SIMPLE", "T"), ("BITPIX", "16"), *sizes, ("BZERO", "32768"), ("BSCALE", "1")]
    empty = [("SIMPLE", "T"), ("BITPIX", "8"), ("NAXIS", "0")]
    extension = [("XTENSION", "'IMAGE   '"), ("BITPIX", "32"), *sizes, ("PCOUNT", "0"), ("GCOUNT", "1")]
    return [
        Case("fits", [_parts("s.fits", *_fits_unit(first, unsigned))], ["s.fits"]),
        Case("fits 32", [_parts("s.fits", *_fits_unit(empty, b""), *_fits_unit(extension, wide))], ["s.fits"]),
    ]


def npys(frames: list[bytes]) -> list[Case]:
    text = f"{{'descr': '<u2', 'fortran_order': False, 'shape': ({len(frames)}, {HEIGHT}, {WIDTH}), }}"
    header = b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + text.ljust(117).encode() + b"\n"
    return [Case("npy", [_parts("s.npy", ("header", header), ("raw", b"".join(frames)))], ["s.npy"])]


def pgms(frames: list[bytes]) -> list[Case]:
    header = ("header", f"P5\n{WIDTH} {HEIGHT}\n65535\n".encode())
    parts = [part for frame in frames for part in (header, ("raw", _swapped(frame)))]
    return [Case("pgm", [_parts("s.pgm", *parts)], ["s.pgm"])]


def mraws(frames: list[bytes]) -> list[Case]:
    def header(bits: int) -> File:
        text = (
            f'<?xml version="1.0"?>\n<cih>\n<deviceInfo><deviceName>camera</deviceName></deviceInfo>\n'
            f"<frameInfo><totalFrame>{len(frames)}</totalFrame></frameInfo>\n<imageDataInfo>\n"
            f"<resolution><width>{WIDTH}</width><height>{HEIGHT}</height></resolution>\n"
            f"<colorInfo><type>Raw</type><bit>{bits}</bit></colorInfo>\n"
            f"<effectiveBit><depth>{bits}</depth><side>Lower</side></effectiveBit>\n</imageDataInfo>\n</cih>\n"
        )
        return File("s.cihx", text.encode())

    packed = _highest_first(_codes(frames, 12), 12)
    return [
        Case("mraw 12", [header(12), _whole("s.mraw", packed)], ["s.mraw"]),
        Case("mraw 16", [header(16), _whole("s.mraw", b"".join(frames))], ["s.cihx"]),
    ]


def raws(frames: list[bytes]) -> list[Case]:
    """Without a header: all that can be told is whether the frames are whole."""
    size = f"{WIDTH}x{HEIGHT}"
    pixels = b"".join(frames)
    packed = _lowest_first(_codes(frames, 12), 12)
    return [
        Case("raw", [_parts("s.raw", ("header", b"skip"), ("raw", pixels))], ["s.raw"], f"{size}:uint16le:4"),
        Case("raw packed", [_whole("s.raw", packed)], ["s.raw"], f"{size}:Mono12p"),
    ]


def _lossless_jpeg(codes: list[int], bits: int) -> bytes:
    """ITU-T T.81, Annex H: each code by its left neighbour, lengths of differences as codes of 5 bits."""

    def segment(marker: int, content: bytes) -> bytes:
        return struct.pack(">BBH", 0xFF, marker, len(content) + 2) + content

    number = "".join(_difference(codes, i, bits) for i in range(len(codes)))
    number += "1" * (-len(number) % 8)
    pixels = int(number, 2).to_bytes(len(number) // 8, "big").replace(b"\xff", b"\xff\0")
    table = bytes([0] * 5 + [17] + [0] * 11) + bytes(range(17))
    size = struct.pack(">BHHBBBB", bits, HEIGHT, WIDTH, 1, 0, 0x11, 0)
    scan = segment(0xDA, bytes([1, 0, 0, 1, 0, 0]))
    return b"\xff\xd8" + segment(0xC4, table) + segment(0xC3, size) + scan + pixels + b"\xff\xd9"


def _difference(codes: list[int], i: int, bits: int) -> str:
    first = 1 << bits - 1 if i < WIDTH else codes[i - WIDTH]
    value = codes[i] - (codes[i - 1] if i % WIDTH else first)
    length = abs(value).bit_length()
    low = value if value >= 0 else value + (1 << length) - 1
    return f"{length:05b}" + (f"{low:0{length}b}" if length else "")


def _dng(name: str, frame: bytes, bits: int, jpeg: bool = False) -> File:
    """One strip before the directory, of a monochrome sensor, which has one report."""
    codes = _codes([frame], bits)
    if jpeg:
        pixels = _lossless_jpeg(codes, bits)
    elif bits == 16:
        pixels = frame
    else:
        pixels = b"".join(_highest_first(codes[y : y + WIDTH], bits) for y in range(0, len(codes), WIDTH))
    texts = b"Maker\0Model 1\0"
    made = _parts(name, ("header", b""), ("raw", pixels))
    made.raw = [(8, 8 + len(pixels))]
    end = 8 + len(pixels) + len(texts)
    made.data = struct.pack("<2sHI", b"II", 42, end) + pixels + texts
    entries = [(254, 4, 1, 0), (256, 4, 1, WIDTH), (257, 4, 1, HEIGHT), (258, 3, 1, bits)]
    entries += [(259, 3, 1, 7 if jpeg else 1)]
    entries += [(262, 3, 1, 34892), (271, 2, 6, 8 + len(pixels)), (272, 2, 8, 14 + len(pixels)), (273, 4, 1, 8)]
    entries += [(277, 3, 1, 1), (278, 4, 1, HEIGHT), (279, 4, 1, len(pixels))]
    entries += [(50706, 1, 4, 0x401), (50714, 4, 1, 0), (50717, 4, 1, (1 << bits) - 1)]
    made.data += struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *entry) for entry in entries)
    made.data += struct.pack("<I", 0)
    return made


def dngs(frames: list[bytes]) -> list[Case]:
    """Raw files of a camera: 16 bits, packed, JPEG without loss."""
    names = [f"f{t}.dng" for t in range(len(frames))]
    return [
        Case(
            f"dng {bits}{' jpeg' * jpeg}",
            [_dng(name, frame, bits, jpeg) for name, frame in zip(names, frames, strict=True)],
            names,
        )
        for bits, jpeg in ((16, False), (14, False), (12, False), (12, True))
    ]


def others(frames: list[bytes]) -> list[Case]:
    """Formats without a check of their own."""
    pixels = b"".join(frames)
    count = len(frames)
    big_endian = b"".join(pixels[k + 1 : k + 2] + pixels[k : k + 1] for k in range(0, len(pixels), 2))
    vtk = "# vtk DataFile Version 3.0\nframes\n{}\nDATASET STRUCTURED_POINTS\n" + (
        f"DIMENSIONS {WIDTH} {HEIGHT} {count}\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA {len(pixels) // 2}\n"
        "SCALARS scalars unsigned_short 1\nLOOKUP_TABLE default\n"
    )
    text = " ".join(map(str, struct.unpack(f"<{len(pixels) // 2}H", pixels))).encode() + b"\n"
    sizes = struct.pack("<8h", 3, WIDTH, HEIGHT, count, 1, 1, 1, 1)
    nifti = struct.pack("<i36x", 348) + sizes + struct.pack("<14xhhh", 512, 16, 0) + struct.pack("<8f", *[1.0] * 8)
    nifti += struct.pack("<f", 352.0) + struct.pack("<f", 1.0)
    nifti = nifti.ljust(344, b"\0") + b"n+1\0" + b"\0\0\0\0"
    return [
        Case("vtk", [_parts("s.vtk", ("header", vtk.format("BINARY").encode()), ("raw", big_endian))], ["s.vtk"]),
        Case("vtk text", [_parts("s.vtk", ("header", vtk.format("ASCII").encode()), ("raw", text))], ["s.vtk"]),
        Case("nifti", [_parts("s.nii", ("header", nifti), ("raw", pixels))], ["s.nii"]),
        Case("nifti gzip", [_parts("s.nii.gz", ("checked", _gzip(nifti + pixels)))], ["s.nii.gz"]),
    ]


def all_cases(frames: list[bytes]) -> list[Case]:
    """Every format, of the same frames: bytes of little-endian unsigned 16-bit pixels."""
    made: list[Case] = []
    for make in (meta_images, nrrds, tiffs, pngs, sers, fitses, npys, pgms, mraws, raws, dngs, others):
        made += make(frames)
    return made

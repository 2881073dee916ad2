# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests files of every format that Python reads by file name, written byte by byte."""

import struct

import itk
import numpy as np
import pytest

HEADER_BYTES = 2880  # block size of FITS: the header is a multiple of it [byte]


def write_tiff(name, frames, description="", leave_out=(), orientation=None):
    """Writes pages of grey values without compression. Tags in `leave_out` are left out."""
    data, at_next = bytearray(b"II*\0\0\0\0\0"), 4
    for number, frame in enumerate(frames):
        pixels = frame.astype(frame.dtype.newbyteorder("<")).tobytes()
        place = len(data)
        data += pixels
        words = description.encode() + b"\0" if number == 0 and description else b""
        text = len(data)
        data += words + b"\0" * ((len(data) + len(words)) % 2)
        rows, columns = frame.shape
        entries = [
            (256, 4, 1, columns),
            (257, 4, 1, rows),
            (258, 3, 1, 8 * frame.itemsize),
            (259, 3, 1, 1),
            (262, 3, 1, 1),
        ]
        entries += [(270, 2, len(words), text)] if words else []
        entries += [(273, 4, 1, place)]
        entries += [(274, 3, 1, orientation)] if orientation else []
        entries += [(277, 3, 1, 1), (278, 4, 1, rows), (279, 4, 1, len(pixels)), (339, 3, 1, 1)]
        entries = [entry for entry in entries if entry[0] not in leave_out]
        struct.pack_into("<I", data, at_next, len(data))
        data += struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *entry) for entry in entries)
        at_next = len(data)
        data += b"\0\0\0\0"
    name.write_bytes(data)


def write_fits(name, frames):
    """Writes unsigned 16-bit numbers as FITS stores them: signed numbers and BZERO."""
    frames_count, rows, columns = frames.shape
    cards = [
        *("SIMPLE  =                    T", "BITPIX  =                   16", "NAXIS   =                    3"),
        *(f"NAXIS1  = {columns:20}", f"NAXIS2  = {rows:20}", f"NAXIS3  = {frames_count:20}"),
        *("BZERO   =                32768", "BSCALE  =                    1", "END"),
    ]
    header = "".join(card.ljust(80) for card in cards).ljust(HEADER_BYTES).encode()
    pixels = (frames.astype(np.int32) - 32768).astype(">i2").tobytes()
    name.write_bytes(header + pixels + b"\0" * (-len(pixels) % HEADER_BYTES))


def write_pgm(name, frame):
    rows, columns = frame.shape
    name.write_bytes(f"P5\n{columns} {rows}\n65535\n".encode() + frame.astype(">u2").tobytes())


def write_ser(name, frames, count):
    """Writes a recording whose header states `count` frames."""
    _, rows, columns = frames.shape
    header = struct.pack("<14s7i", b"LUCAM-RECORDER", 0, 0, 0, columns, rows, 16, count)
    name.write_bytes(header.ljust(178, b"\0") + frames.astype("<u2").tobytes())


@pytest.fixture
def expected(burst):
    return itk.estimate_sensor_noise(burst)


def test_fits(burst, expected, tmp_path):
    write_fits(tmp_path / "cube.fits", burst)
    assert itk.estimate_sensor_noise(tmp_path / "cube.fits") == expected


def test_npy(burst, expected, tmp_path):
    np.save(tmp_path / "stack.npy", burst)
    assert itk.estimate_sensor_noise(tmp_path / "stack.npy") == expected
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(tmp_path / "stack.npy"), burst)


def test_pgm(burst, expected, tmp_path):
    for number, frame in enumerate(burst):
        write_pgm(tmp_path / f"frame_{number}.pgm", frame)
    assert itk.estimate_sensor_noise(tmp_path)["gain"] == expected["gain"]


def test_tiff_of_32_bits(burst, tmp_path):
    write_tiff(tmp_path / "sum.tif", burst.astype(np.uint32))
    assert itk.estimate_sensor_noise(tmp_path / "sum.tif") == itk.estimate_sensor_noise(burst.astype(np.float64))


def test_tiff_without_a_tag_that_has_a_default(burst, expected, tmp_path):
    """ImageJ before 2022 wrote no tag Compression."""
    write_tiff(tmp_path / "imagej.tif", burst, leave_out=(259,))
    assert itk.estimate_sensor_noise(tmp_path / "imagej.tif") == expected


def test_tiff_is_read_as_it_is_stored(burst, expected, tmp_path):
    """Turning the frame, as viewers do, would make rows of the sensor columns."""
    write_tiff(tmp_path / "turned.tif", burst, orientation=6)
    with pytest.warns(UserWarning, match="turned.tif: its Orientation is 6, .* It is measured as it is stored"):
        assert itk.estimate_sensor_noise(tmp_path / "turned.tif") == expected


@pytest.mark.parametrize("tile", [(16, 16), (64, 48), (256, 256)])
@pytest.mark.parametrize(
    ("compression", "predictor"), [(None, None), ("zlib", None), ("zlib", 2), ("lzw", None), ("lzw", 2)]
)
def test_tiff_of_tiles(burst, expected, tmp_path, tile, compression, predictor):
    """Tiles that tifffile, another writer, makes are read."""
    tifffile = pytest.importorskip("tifffile")
    if compression is not None:
        pytest.importorskip("imagecodecs")  # tifffile compresses with it
    options = {"photometric": "minisblack", "tile": tile, "compression": compression, "predictor": predictor}
    for number, more in enumerate(({}, {"byteorder": ">"}, {"bigtiff": True})):
        tifffile.imwrite(tmp_path / f"{number}.tif", burst, **options, **more)
        assert itk.estimate_sensor_noise(tmp_path / f"{number}.tif") == expected
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(tmp_path / "0.tif"), burst)


def test_recording_that_was_not_closed(burst, expected, tmp_path):
    write_ser(tmp_path / "capture.ser", burst, count=0)
    with pytest.warns(UserWarning, match="capture.ser.* says 0 frames, but holds 60 .*the recording was not closed"):
        report = itk.estimate_sensor_noise(tmp_path / "capture.ser")
    assert report["gain"] == expected["gain"]


def test_hyperstack_is_refused_with_the_way_of_python(burst, expected, tmp_path):
    both = np.stack([burst, burst[::-1]], axis=1).reshape(-1, *burst.shape[1:])
    words = f"ImageJ=1.53t\nimages={len(both)}\nchannels=2\nframes={len(burst)}\nhyperstack=true\n"
    write_tiff(tmp_path / "hyper.tif", both, words)
    for call in (itk.estimate_sensor_noise, itk.sensor_noise_frame_list_source):
        with pytest.raises(ValueError) as error:
            call(tmp_path / "hyper.tif")
        text = str(error.value)
        assert text.startswith(
            f"{tmp_path}/hyper.tif: has 2 channels and 60 times; expected frames that differ in time"
        )
        assert "--" not in text and text.endswith("tifffile.imread(name)[:, 0]")
    # The error message recommends this conversion of an array (T, C, Y, X).
    assert itk.estimate_sensor_noise(both.reshape(len(burst), 2, *burst.shape[1:])[:, 0]) == expected

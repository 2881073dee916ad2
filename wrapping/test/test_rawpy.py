# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests raw files of cameras through rawpy: unchanged grey values, and the camera settings of the file."""

import os
import struct
import sys
from pathlib import Path

import itk
import itk_sensornoise
import pytest

pytest.importorskip("rawpy")
sys.path.append(str(Path(__file__).resolve().parents[2] / "examples" / "python"))
from frame_stacks import LONG, RATIONAL, SHORT
from frame_stacks import write_dng as write_dng_of


def write_dng(name, grey_values, cfa=(0, 1, 1, 2), black=100, white=4095, exposure=(1, 50)):
    """Writes a DNG of a camera that records an exposure [s], by default of 1/50 s, at ISO 400."""
    exif = [(33434, RATIONAL, list(exposure)), (34855, SHORT, [400])]
    write_dng_of(name, grey_values, black, white, cfa, b"Model 5", exif=exif)


@pytest.fixture
def names(burst, tmp_path):
    names = [tmp_path / f"a{number}.dng" for number in range(12)]
    for name, grey_values in zip(names, burst, strict=False):
        write_dng(name, grey_values)
    return names


def test_grey_values_equal_the_file(burst, names):
    mono = {"bayer": "none"}  # the files wrongly say RGGB
    expected = itk.estimate_sensor_noise(burst[:12], **mono)

    def measured(frames, **options):
        report = itk.estimate_sensor_noise(frames, **options, **mono).to_dict()
        assert report.pop("camera")["bayer_pattern"] == "RGGB"
        return report

    assert measured(names) == expected
    assert measured(f"{names[0].parent}/*.dng") == expected
    assert measured(names, frame_range=(2, 9)) == itk.estimate_sensor_noise(burst[:12], frame_range=(2, 9), **mono)
    assert itk.estimate_sensor_noise(names)["bayer"] == {"pattern": "RGGB", "source": "file"}


@pytest.mark.parametrize("pattern", ["RGGB", "GRBG", "GBRG", "BGGR"])
def test_metadata_are_what_the_file_says(burst, tmp_path, pattern):
    write_dng(tmp_path / "a.dng", burst[0], cfa=["RGB".index(letter) for letter in pattern], black=128, white=4000)
    assert itk_sensornoise.raw_metadata(tmp_path / "a.dng") == {
        "bayer": pattern,
        "black_level": 128.0,
        "black_levels": [128.0] * 4,
        "white_level": 4000.0,
        "iso_speed": 400.0,
        "exposure_seconds": 0.02,  # LibRaw has 0.01999999955
        "camera": "Maker Model 5",
    }


@pytest.mark.parametrize(
    ("exposure", "seconds"), [((1, 100), 0.01), ((1, 8000), 0.000125), ((1, 60), 0.016666668), ((30, 1), 30.0)]
)
def test_exposures_are_the_shortest_decimals_of_single_precision(burst, tmp_path, exposure, seconds):
    write_dng(tmp_path / "a.dng", burst[0], exposure=exposure)
    assert itk_sensornoise.raw_metadata(tmp_path / "a.dng")["exposure_seconds"] == seconds


def refused(names):
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(names)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_what_is_no_raw_file_is_refused_by_name(names, burst):
    write_dng(names[3], burst[0][:, :-2])
    assert refused(names).startswith(f"{names[3]}: 126 x 96 pixels of type uint16, but {names[0]} has 128 x 96")
    names[3].write_bytes(b"no raw file")
    assert refused(names).startswith(f"{names[3]}: rawpy cannot read it (")
    names[3].unlink()
    assert refused(names) == f"{names[3]}: does not exist"


def test_truncated_raw_file_is_refused(names):
    names[3].write_bytes(names[3].read_bytes()[:3000])
    assert refused(names).startswith(f"{names[3]}: ")


def test_missing_grey_values_are_reported(names):
    whole = names[3].read_bytes()
    names[3].write_bytes(whole.replace(struct.pack("<HHIH", 259, SHORT, 1, 1), struct.pack("<HHIH", 259, SHORT, 1, 7)))
    assert names[3].read_bytes() != whole
    assert refused(names).startswith(f"{names[3]}, strip or tile 0: damaged: ")


def test_more_pixels_than_bytes_hold_are_refused(names):
    declared = (
        names[3].read_bytes().replace(struct.pack("<HHII", 257, LONG, 1, 96), struct.pack("<HHII", 257, LONG, 1, 40000))
    )
    names[3].write_bytes(declared)
    assert refused(names) == (
        f"{names[3]}: truncated or damaged: declares 128 x 40000 pixels, more than its bytes can hold"
    )


def test_what_is_no_regular_file_is_refused(names):
    names[3].unlink()
    os.mkfifo(names[3])
    assert refused(names) == f"{names[3]}: is no regular file"

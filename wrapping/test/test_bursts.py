# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests bursts as cameras write them: SER, MRAW, multi-page TIFF, and frames without a header."""

import os
import struct

import itk
import numpy as np
import pytest

W, H, T = 64, 48, 24


@pytest.fixture(scope="module")
def frames() -> np.ndarray:
    random = np.random.default_rng(1)
    y, x = np.mgrid[0:H, 0:W]
    illumination = 1 + 0.05 * random.standard_normal((T, 1, 1))
    return np.minimum(random.poisson((300 + 20 * x + 10 * y) * illumination), 4095).astype("<u2")


@pytest.fixture(scope="module")
def folder(frames, tmp_path_factory):
    made = tmp_path_factory.mktemp("bursts")
    itk.imwrite(itk.image_from_array(frames), os.fspath(made / "a.mha"))
    itk.imwrite(itk.image_from_array(frames), os.fspath(made / "a.tif"))
    header = struct.pack("<14s7i", b"LUCAM-RECORDER", 0, 9, 0, W, H, 12, T) + b" " * 40 + b"name".ljust(40)
    (made / "a.ser").write_bytes(header + b" " * 40 + b"\0" * 16 + frames.tobytes())
    (made / "a.mraw").write_bytes(frames.tobytes())
    (made / "a.cihx").write_text(
        f"<cih><frameInfo><totalFrame>{T}</totalFrame></frameInfo><imageDataInfo><resolution><width>{W}</width>"
        f"<height>{H}</height></resolution><colorInfo><bit>16</bit></colorInfo></imageDataInfo></cih>"
    )
    (made / "a.raw").write_bytes(b"skip" + frames.tobytes())
    return made


@pytest.mark.parametrize(
    ("name", "options"),
    [("a.tif", {}), ("a.ser", {}), ("a.mraw", {}), ("a.cihx", {}), ("a.raw", {"raw": f"{W}x{H}:uint16le:4"})],
)
def test_the_report_is_that_of_the_metaimage(folder, name, options):
    expected = itk.estimate_sensor_noise(folder / "a.mha", bit_depth=12)
    assert expected["gain"]["value"] == pytest.approx(1.0, abs=0.1)
    # the header of a.ser wrongly says that it is a mosaic
    report = itk.estimate_sensor_noise(folder / name, bit_depth=12, bayer="none", **options).to_dict()
    report.pop("camera", None)
    assert report == dict(expected)


def test_what_the_file_says_counts_as_given(folder, frames):
    reports = itk.estimate_sensor_noise(folder / "a.ser", bit_depth=12)
    assert reports["bayer"]["source"] == "file"
    assert reports.channel("R")["camera"]["bayer_pattern"] == reports["bayer"]["pattern"]
    image = itk.image_from_array(frames)
    image["SensorNoise.WhiteLevel"] = 4000.0
    given = itk.estimate_sensor_noise(folder / "a.mha", clip=(0, 4000), bit_depth=12)
    said = itk.estimate_sensor_noise(image, bit_depth=12)
    assert said["clip_high"] == given["clip_high"] == 4000
    assert said["gain"] == given["gain"]
    assert said["camera"]["white_level"] == 4000
    assert itk.estimate_sensor_noise(image, bit_depth=12, clip=(0, 4095))["clip_high"] == 4095


def test_raw_is_of_dark_frames_too(folder):
    raw = f"{W}x{H}:uint16le:4"
    report = itk.estimate_sensor_noise([folder / "a.raw"], dark=folder / "a.raw", raw=raw)
    assert report["settings"]["dark_frames"] == T


@pytest.mark.parametrize("name", ["a.ser", "a.mraw", "a.tif"])
def test_imread_reads_them_in_parts(folder, frames, name):
    assert (itk.array_from_image(itk.imread(os.fspath(folder / name))) == frames).all()
    reader = itk.ImageFileReader[itk.Image[itk.US, 3]].New(FileName=os.fspath(folder / name))
    reader.UpdateOutputInformation()
    assert reader.GetImageIO().GetNameOfClass() == "SensorNoiseImageIO"
    region = reader.GetOutput().GetLargestPossibleRegion()
    region.SetIndex(2, 3)
    region.SetSize(2, 2)
    reader.GetOutput().SetRequestedRegion(region)
    reader.GetOutput().Update()
    assert (itk.array_from_image(reader.GetOutput(), update=False) == frames[3:5]).all()


def test_what_the_file_says_of_the_camera_is_in_the_dictionary(folder):
    image = itk.sensor_noise_frame_list_source(folder / "a.ser")
    assert image["SensorNoise.BayerPattern"] == "GRBG"
    assert image["SensorNoise.BitDepth"] == 12
    assert image["SensorNoise.Camera"] == "name"


@pytest.mark.parametrize(
    ("frames_of", "raw", "said"),
    [
        ("a.raw", f"{W}x{H}:uint16le", "expected a whole number of frames"),
        ("a.raw", "64", "is no layout of raw frames"),
        ("a.raw", 3, "raw is 3; expected a layout"),
        (None, "64x48:uint8", "expected names of files"),
    ],
)
def test_what_does_not_fit_is_refused(folder, frames, frames_of, raw, said):
    with pytest.raises(ValueError, match=said):
        itk.estimate_sensor_noise(frames if frames_of is None else folder / frames_of, raw=raw)

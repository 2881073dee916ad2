# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the single-image method in both styles of ITK, against the tool."""

import json
import os
import subprocess
from pathlib import Path

import itk
import itk_sensornoise as sn
import numpy as np
import pytest
from conftest import ITK_TYPES

GAIN, OFFSET, READ_NOISE = 0.5, 20.0, 2.0


@pytest.fixture(scope="module")
def frames():
    """Returns three frames (3, 192, 256) of flat fields of 16 levels, whose digital numbers fit every pixel type."""
    random = np.random.default_rng(5)
    electrons = np.repeat(np.repeat(np.linspace(20, 320, 16).reshape(4, 4), 48, axis=0), 64, axis=1)
    signal = GAIN * random.poisson(electrons, (3, *electrons.shape))
    return np.clip(np.rint(OFFSET + signal + random.normal(0, READ_NOISE, signal.shape)), 0, 255)


@pytest.mark.parametrize("count", [1, 3])
def test_gain_and_intercept_are_those_of_the_simulation(frames, count):
    report = itk.single_image_noise_estimator(frames[:count])
    assert report.gain.status == "identified"
    assert abs(report.gain.value - GAIN) < 4 * report.gain.standard_error < 0.2 * GAIN
    intercept = READ_NOISE**2 - GAIN * OFFSET
    assert abs(report.intercept.value - intercept) < 4 * report.intercept.standard_error
    assert report.offset.status == report.read_noise.status == "not-identifiable"
    assert len(report["single_image"]["frames"]) == count
    assert "line-only" in [warning["code"] for warning in report["warnings"]]


def test_a_frame_is_a_stack_of_one(frames):
    assert itk.single_image_noise_estimator(frames[0]) == itk.single_image_noise_estimator(frames[:1])


def test_class_style(frames, pixel):
    image = itk.image_view_from_array(frames.astype(pixel))
    found = itk.SingleImageNoiseEstimator[itk.Image[ITK_TYPES[pixel], 3]].New(image, bit_depth=8)
    found.Update()
    expected = itk.single_image_noise_estimator(image, bit_depth=8)
    assert json.loads(found.GetReportAsJson()) == expected and "single-image" in found.GetReportAsText()
    assert not found.HasChannelReports()


def test_each_plane_of_a_mosaic_is_measured(frames):
    reports = itk.single_image_noise_estimator(frames, bayer_pattern="RGGB")
    assert [report["channel"] for report in reports["channels"]] == ["R", "G1", "G2", "B"]


def test_a_mask_leaves_pixels_out(frames):
    mask = np.ones(frames.shape[1:], dtype=np.uint8)
    mask[:, :128] = 0
    report = itk.single_image_noise_estimator(frames, mask=mask)
    assert report["pixels"]["valid"] + report["pixels"]["clipped"] == mask.sum() >= report["pixels"]["used"]
    with pytest.raises(ValueError, match="shape"):
        itk.single_image_noise_estimator(frames, mask=mask[:, :9])


def test_unknown_parameters_are_refused(frames):
    with pytest.raises(TypeError, match="bit_deep is not a parameter of single_image_noise_estimator"):
        itk.single_image_noise_estimator(frames, bit_deep=8)


@pytest.mark.skipif("SENSORNOISE_BIN" not in os.environ, reason="SENSORNOISE_BIN names no folder of the tools")
def test_the_tool_gives_the_same_record(frames, tmp_path):
    name = tmp_path / "frames.mha"
    itk.imwrite(itk.image_view_from_array(frames.astype(np.uint8)), str(name))
    program = Path(os.environ["SENSORNOISE_BIN"]) / "estimate-sensor-noise"
    command = [program, name, "--method", "single-image", "--json", "-", "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    record = json.loads(done.stdout)
    expected = itk.single_image_noise_estimator(str(name))
    assert record["gain"] == expected["gain"] and record["single_image"] == expected["single_image"]


def test_one_call_is_the_functional_style_with_regions_and_hashes(frames):
    report = itk.estimate_sensor_noise(frames, method="single-image", bit_depth=8)
    assert report == itk.single_image_noise_estimator(frames, bit_depth=8)
    assert itk.estimate_sensor_noise(frames[0], method="single-image") == itk.single_image_noise_estimator(frames[0])
    cut = itk.estimate_sensor_noise(
        frames, method="single-image", roi=np.s_[:, 64:], frame_range=(1, 3), hash=True, threads=1
    )
    by_hand = itk.single_image_noise_estimator(np.ascontiguousarray(frames[1:3, :, 64:]))
    assert cut.gain.value == by_hand.gain.value
    assert [cut["settings"][f"roi_{name}"] for name in ("x", "y", "width", "height")] == [64, 0, 192, 192]
    assert (cut["settings"]["frame_range_first"], cut["settings"]["frame_range_end"]) == (1, 3)
    assert cut["input"]["of"] == "pixels" and len(cut["input"]["sha256"]) == 64


def test_the_pattern_of_a_mosaic_is_that_of_the_region(frames):
    cut = itk.estimate_sensor_noise(frames, method="single-image", bayer="RGGB", roi=(1, 0, 254, 192))
    assert cut["bayer"]["pattern"] == "GRBG"


@pytest.mark.parametrize(
    ("options", "found"),
    [
        ({"offset": 20.0}, "offset was given and the method is 'single-image', which measures slope and intercept"),
        ({"maps": True}, "maps were given and the method is 'single-image', which has no maps over time"),
        ({"level_range": (10, 20)}, "level_range was given and the method is 'single-image', which fits all levels"),
        ({"exposures": [1, 2, 3]}, "exposures were given and the method is 'single-image', which does not measure"),
        ({"mask": np.ones((3, 3))}, "mask has shape"),
    ],
)
def test_what_the_method_does_not_use_is_refused(frames, options, found):
    with pytest.raises(ValueError, match=found):
        itk.estimate_sensor_noise(frames, method="single-image", **options)


def test_sums_of_a_burst_are_of_the_other_methods():
    with pytest.raises(ValueError, match="method is 'single-image'; expected 'refined' or 'published'"):
        sn.SensorNoiseSums((5, 8, 8), np.uint16, method="single-image")

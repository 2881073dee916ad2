# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests bursts with a Bayer mosaic: one report for each channel."""

import json
import pickle

import itk
import numpy as np
import pytest
from itk_sensornoise import ChannelReports, Report

MOSAIC = {"size": (96, 96), "frames": 24, "bayer": "GRBG", "transmission": (0.6, 1.0, 0.4)}
CORNERS = {"R": (0, 1), "G1": (0, 0), "G2": (1, 1), "B": (1, 0)}  # corner (y, x) of each channel of GRBG


@pytest.fixture(scope="module")
def mosaic():
    return itk.simulate_sensor_noise(**MOSAIC)[0]


@pytest.fixture(scope="module")
def reports(mosaic):
    return itk.estimate_sensor_noise(mosaic, bayer="GRBG", maps=True)


def test_each_channel_is_its_plane(mosaic, reports):
    assert isinstance(reports, ChannelReports)
    for name, (y, x) in CORNERS.items():
        alone = itk.estimate_sensor_noise(np.ascontiguousarray(mosaic[:, y::2, x::2]), bayer="none", maps=True)
        channel = reports.channel(name)
        assert isinstance(channel, Report)
        assert channel["channel"] == name
        assert channel["gain"] == alone["gain"]
        assert channel["flicker"] == alone["flicker"]
        np.testing.assert_array_equal(reports.maps["mean"][y::2, x::2], alone.maps["mean"])


def test_record_is_the_tool_s(tool, mosaic, tmp_path):
    itk.imwrite(itk.image_from_array(mosaic), str(tmp_path / "m.mha"))
    tool("estimate-sensor-noise", tmp_path / "m.mha", "--bayer", "auto", "--json", tmp_path / "m.json")
    record = json.loads((tmp_path / "m.json").read_text())
    here = itk.estimate_sensor_noise(mosaic)
    assert here.keys() == record.keys()
    for ours, theirs in zip(here["channels"], record["channels"], strict=True):
        assert ours["gain"]["value"] == pytest.approx(theirs["gain"]["value"], rel=1e-9)
        assert ours["total_intercept"]["value"] == pytest.approx(theirs["total_intercept"]["value"], rel=1e-7)
    assert record["bayer"] == {"pattern": "GRBG", "source": "levels"}
    assert [channel["channel"] for channel in record["channels"]] == ["R", "G1", "G2", "B"]
    assert [warning["code"] for warning in record["warnings"]] == ["red-or-blue"]


def test_it_prints_and_travels(reports):
    text = str(reports)
    assert "GRBG mosaic (given)" in text
    assert "\nG2 " in text
    assert pickle.loads(pickle.dumps(reports)) == reports
    assert str(pickle.loads(pickle.dumps(reports)).channel("B")) == str(reports.channel("B"))
    assert json.loads(json.dumps(reports)) == json.loads(reports.to_json())
    assert "GRBG mosaic" in repr(reports)
    assert "GRBG mosaic" in reports._repr_html_()
    with pytest.raises(ValueError, match="channel is 'green'"):
        reports.channel("green")
    with pytest.raises(TypeError):
        reports["joint"] = None


def test_mono_mosaic_is_said(mosaic):
    report = itk.estimate_sensor_noise(mosaic, bayer="none")
    assert isinstance(report, Report)
    assert "mosaic" in [warning["code"] for warning in report["warnings"]]


def test_region_keeps_the_colours(mosaic):
    cut = itk.estimate_sensor_noise(mosaic, bayer="GRBG", roi=(3, 5, 64, 64))
    assert cut["bayer"]["pattern"] == "GBRG"
    whole = itk.estimate_sensor_noise(np.ascontiguousarray(mosaic[:, 5:69, 3:67]), bayer=cut["bayer"]["pattern"])
    assert [c["gain"] for c in cut["channels"]] == [c["gain"] for c in whole["channels"]]


def test_metadata_of_an_image_is_heeded(mosaic):
    image = itk.image_from_array(mosaic)
    image["SensorNoise.BayerPattern"] = "GRBG"
    assert itk.estimate_sensor_noise(image)["bayer"] == {"pattern": "GRBG", "source": "file"}
    cut = itk.estimate_sensor_noise(image, roi=(1, 0, 64, 64))
    assert cut["bayer"] == {"pattern": "RGGB", "source": "file"}
    assert itk.estimate_sensor_noise(image, bayer="none")["channel"] == "mono"


def test_one_channel_serves_a_denoiser(mosaic, reports):
    plane = np.ascontiguousarray(mosaic[0, 0::2, 1::2])
    assert itk.generalized_anscombe_image_filter(plane, reports.channel("R")).shape == plane.shape
    with pytest.raises(ValueError, match="several channels"):
        itk.generalized_anscombe_image_filter(plane, reports)


def test_planes_as_a_filter(mosaic):
    plane = itk.bayer_plane_image_filter(itk.image_from_array(mosaic), pattern="GRBG", plane="B")
    np.testing.assert_array_equal(itk.array_from_image(plane), mosaic[:, 1::2, 0::2])


@pytest.mark.parametrize("bayer", ["rggb", "RGBG", None, True])
def test_unknown_patterns_are_refused(mosaic, bayer):
    with pytest.raises(ValueError, match="bayer is"):
        itk.estimate_sensor_noise(mosaic, bayer=bayer)

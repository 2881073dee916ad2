# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the comparison of the noise model of a report with frames."""

import json
import pickle

import itk
import numpy as np
import pytest


def simulated(seed, **options):
    return itk.simulate_sensor_noise(frames=40, size=(128, 96), reference="texture", seed=seed, **options)[0]


@pytest.fixture(scope="module")
def report():
    return itk.estimate_sensor_noise(simulated(1))


def test_other_frames_of_the_camera_fit(report, tmp_path):
    found = itk.check_noise_model(simulated(2, flicker_sd=0.02), report)
    assert found and found["verdict"] == "fits", found
    assert found["sentence"].startswith("variance 1.0") and found["sentence"].endswith("this model can be used")
    assert str(found).endswith(found["sentence"].replace(" +- ", " ± "))
    assert all(band["fits"] for band in found["bands"]) and len(found["bands"]) >= 5
    assert json.loads(found.to_json()) == found == pickle.loads(pickle.dumps(found))
    (tmp_path / "report.json").write_text(report.to_json(), encoding="utf-8")
    assert itk.check_noise_model(simulated(2, flicker_sd=0.02), tmp_path / "report.json") == found


def test_wrong_models_are_seen(report):
    steeper = {
        **report,
        "variance_slope": {**report["variance_slope"], "value": 1.05 * report["variance_slope"]["value"]},
    }
    frames = simulated(2)
    assert itk.check_noise_model(frames, report)
    assert not itk.check_noise_model(frames, steeper)
    assert not itk.check_noise_model(simulated(2, gain=1.2), report)
    scaled = itk.check_noise_model(frames * np.uint16(16), report)
    assert not scaled and scaled["sentence"].endswith("the numbers of these frames 16 DN: it may be of another scale")


def test_published_report_is_held_against_what_the_refined_method_finds(report):
    frames = simulated(1)
    published = itk.estimate_sensor_noise(frames, method="published")
    found, other = itk.check_noise_model(frames, published), itk.check_noise_model(frames, report)
    assert [band["pixels"] for band in found["bands"]] == [band["pixels"] for band in other["bands"]]
    slope, intercept = (published[name]["value"] for name in ("variance_slope", "total_intercept"))
    for band, fits in zip(found["bands"], other["bands"], strict=True):
        level = (band["low"] + band["high"]) / 2
        model = report["variance_slope"]["value"] * level + report["total_intercept"]["value"]
        assert band["variance"] / fits["variance"] == pytest.approx(model / (slope * level + intercept), abs=0.01)


def test_wrong_use_is_refused(report):
    frames = simulated(2)
    with pytest.raises(ValueError, match="the report's total_intercept has no value"):
        itk.check_noise_model(frames, {**report, "total_intercept": {"value": None, "status": "failed"}})
    with pytest.raises(ValueError, match="the report has the schema None"):
        itk.check_noise_model(frames, {})
    with pytest.raises(ValueError, match="bits is not a parameter"):
        itk.check_noise_model(frames, report, bits=12)
    with pytest.raises(ValueError, match='method is .*published.*; expected "refined"'):
        itk.check_noise_model(frames, report, method="published")
    with pytest.raises(ValueError, match="frames has 2 dimensions"):
        itk.check_noise_model(frames[0], report)

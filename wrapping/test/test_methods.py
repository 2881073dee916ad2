# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the two methods, and a known offset: given, or from dark frames."""

import itk
import numpy as np
import pytest


def is_near(quantity, truth):
    assert quantity["status"] == "identified"
    return abs(quantity["value"] - truth) < 4 * quantity["standard_error"]


@pytest.mark.parametrize("method", ["refined", "published"])
def test_a_memory_limit_changes_no_number(burst, method):
    report = itk.estimate_sensor_noise(burst, method=method)
    assert itk.estimate_sensor_noise(burst, method=method, memory_limit=10**8) == report
    with pytest.raises(ValueError, match="the memory limit is 0.1 MB; expected at least"):
        itk.estimate_sensor_noise(burst, method=method, memory_limit=10**5)
    for limit in (0, -1, 1.5, "4G", True):
        with pytest.raises(ValueError, match="memory_limit"):
            itk.estimate_sensor_noise(burst, method=method, memory_limit=limit)


def test_refined_is_the_default_and_has_errors(burst):
    report = itk.estimate_sensor_noise(burst)
    assert report["method"] == "refined"
    assert report == itk.estimate_sensor_noise(burst, method="refined")
    # Camera B: g = 1 DN/e-, mu = 100 DN, sigma = 8 DN.
    for name, truth in (("gain", 1), ("offset", 100), ("read_noise", 8), ("intercept", -36)):
        assert is_near(report[name], truth)
        low, high = report[name]["interval95"]
        assert low < report[name]["value"] < high
    assert "±" in str(report)
    published = itk.estimate_sensor_noise(burst, method="published")
    assert published["method"] == "published"
    assert published["gain"]["standard_error"] is None and "±" not in str(published)
    assert published["pixels"]["used"] < report["pixels"]["used"]


def test_dark_frames_determine_offset_and_read_noise(burst, dark):
    report = itk.estimate_sensor_noise(burst, dark=dark)
    assert is_near(report["offset"], 100) and is_near(report["read_noise"], 8)
    # The offset has the error sigma / sqrt(N T) and an error for drift of the level. The variance of the drift, less
    # sigma^2 / N of noise, has the relative error sqrt(2 / (T - 1)) = 0.43; three of these are 1.3. The read noise has
    # the error sigma / sqrt(2 N (T - 1)).
    assert 0.95 < report["offset"]["standard_error"] / (8 / np.sqrt(dark.size)) < np.sqrt(1 + 1.3)
    assert report["read_noise"]["standard_error"] == pytest.approx(8 / np.sqrt(2 * 128 * 96 * 11), rel=0.1)
    assert report["settings"]["dark_frames"] == 12
    assert report["warnings"] == []


@pytest.mark.parametrize("make", [list, np.asfortranarray, itk.image_view_from_array])
def test_dark_frames_in_any_form(burst, dark, make):
    assert itk.estimate_sensor_noise(burst, dark=make(dark)) == itk.estimate_sensor_noise(burst, dark=dark)


def test_one_dark_frame_determines_the_offset_only(burst, dark):
    report = itk.estimate_sensor_noise(burst, dark=[dark[0]])
    assert is_near(report["offset"], 100)
    assert "dark_variance" not in report["settings"]


def test_a_given_offset_needs_no_flicker():
    steady, _ = itk.simulate_sensor_noise(frames=40, size=(128, 96), flicker_sd=0, seed=5)
    blind = itk.estimate_sensor_noise(steady)
    assert blind["offset"]["status"] == blind["read_noise"]["status"] == "not-identifiable"
    report = itk.estimate_sensor_noise(steady, offset=(100, 0.5))
    assert report["offset"]["value"] == 100 and report["offset"]["standard_error"] == 0.5
    assert is_near(report["read_noise"], 8)
    assert itk.estimate_sensor_noise(steady, offset=100)["settings"]["offset_standard_error"] == 0


def test_dark_frames_of_another_camera_are_noticed(burst):
    other, _ = itk.simulate_sensor_noise(frames=12, size=(128, 96), electrons=1e-9, read_noise=12)
    report = itk.estimate_sensor_noise(burst, dark=other)
    assert [warning["code"] for warning in report["warnings"]] == ["dark-frames-differ"]


def test_an_excess_noise_factor_is_divided_out_of_the_gain(burst):
    plain = itk.estimate_sensor_noise(burst)
    report = itk.estimate_sensor_noise(burst, excess_noise_factor=2)
    assert report["settings"]["excess_noise_factor"] == 2
    assert report["gain"]["value"] == plain["gain"]["value"] / 2
    assert report["read_noise_electrons"]["value"] == 2 * plain["read_noise_electrons"]["value"]
    for name in ("variance_slope", "intercept", "total_intercept", "offset", "read_noise"):
        assert report[name] == plain[name]
    for factor in (0.5, -1, "2", float("nan")):
        with pytest.raises(ValueError, match="excess.noise.factor is .*; expected a number of 1 or more"):
            itk.estimate_sensor_noise(burst, excess_noise_factor=factor)


def test_a_level_range_leaves_out_the_other_levels(burst):
    report = itk.estimate_sensor_noise(burst, level_range=(500, 2500))
    assert (report["settings"]["level_range_low"], report["settings"]["level_range_high"]) == (500, 2500)
    whole = itk.estimate_sensor_noise(burst)
    assert "level_range_low" not in whole["settings"]
    assert 0 < report["pixels"]["used"] < whole["pixels"]["used"]
    assert is_near(report["gain"], 1)


def test_exposures_give_the_linearity():
    exposures = np.repeat([0.1, 0.3, 0.5, 0.7, 0.9], 5)
    stack, _ = itk.simulate_sensor_noise(
        frames=25, size=(128, 96), illumination=exposures, flicker_sd=0.001, vibration_sd=(0, 0), seed=5
    )
    report = itk.estimate_sensor_noise(stack, exposures=exposures)
    assert report["settings"]["exposures"] == exposures.tolist()
    linearity = report["linearity"]
    assert linearity["status"] == "upper-limit" and linearity["linearity_error_percent"]["interval95"][1] < 0.2
    assert is_near(linearity["offset_dn"], 100)
    assert [level["frames"] for level in linearity["levels"]] == [5] * 5
    cut = itk.estimate_sensor_noise(stack, exposures=exposures, frame_range=(1, 25))
    assert [level["frames"] for level in cut["linearity"]["levels"]] == [4, 5, 5, 5, 5]
    assert itk.estimate_sensor_noise(stack)["linearity"]["reason"] == "no exposures were given"


WRONG = {
    "published exposures": (
        {"exposures": [1, 2, 3], "method": "published"},
        "exposures were given and the method is 'published'",
    ),
    "few exposures": ({"exposures": [1, 2, 3]}, "there are 3 exposures, but 60 frames"),
    "two exposures": ({"exposures": [1, 2] * 30}, "the exposures have 2 different values; expected at least 3"),
    "an exposure": ({"exposures": 5}, "exposures is 5; expected one finite number for each frame"),
    "both": ({"offset": 3, "dark": True}, "offset and dark were given; expected one of them"),
    "published offset": ({"offset": 3, "method": "published"}, "offset was given and the method is 'published'"),
    "published dark": ({"dark": True, "method": "published"}, "dark was given and the method is 'published'"),
    "published levels": (
        {"level_range": (500, 2500), "method": "published"},
        "level_range was given and the method is 'published'",
    ),
    "one level": ({"level_range": 500}, "level_range is 500; expected (low, high), two levels with low < high [DN]"),
    "levels turned round": (
        {"level_range": (9, 3)},
        "the range of levels is from 9 to 3 DN; expected the lower level first",
    ),
    "text": ({"offset": "much"}, "offset is 'much'; expected a finite number or (number, standard error) [DN]"),
    "no number": ({"offset": float("nan")}, "offset is nan; expected a finite number"),
    "no frames": ({"dark": []}, "dark is an empty list; expected at least 1 frame"),
    "a frame": ({"dark": np.ones((96, 128), np.uint16)}, "dark has 2 dimensions, shape (96, 128); expected 3"),
    "ragged": ({"dark": [np.ones((96, 128), np.uint16), np.ones((9, 9), np.uint16)]}, "dark[1] has shape (9, 9)"),
    "other type": (
        {"dark": np.ones((6, 96, 128), np.uint8)},
        "dark has 128 x 96 pixels of type uint8; expected 128 x 96 pixels of type uint16, as the frames",
    ),
    "no file": ({"dark": "no-such.mha"}, "no-such.mha: does not exist"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_use_is_refused(burst, dark, case):
    parameters, expected = WRONG[case]
    if parameters.get("dark") is True:
        parameters = {**parameters, "dark": dark}
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(burst, **parameters)
    assert str(error.value).splitlines()[0].startswith(expected)


def test_dark_frames_without_a_black_level_are_what_itk_throws(burst):
    with pytest.raises(ValueError, match="their black level is cut off"):
        itk.estimate_sensor_noise(burst, dark=np.zeros((5, 96, 128), np.uint16))
    with pytest.raises(ValueError, match="^the offset is 100.* expected .* a standard error of 0 or more"):
        itk.estimate_sensor_noise(burst, offset=(100, -1))

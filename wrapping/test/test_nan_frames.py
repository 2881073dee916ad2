# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that frames with NaN in every pixel are named by their indices."""

import warnings

import itk
import numpy as np
import pytest

MEASURE = {
    "estimate": (itk.estimate_sensor_noise, "frames"),
    "correlation": (itk.noise_correlation_estimator, "stack"),
    "statistics": (itk.temporal_statistics_image_filter, "stack"),
}


def with_nan(burst, numbers):
    stack = burst.astype(np.float32)
    stack[numbers] = np.nan
    return stack


@pytest.mark.parametrize("make", [np.asarray, list, lambda stack: itk.image_view_from_array(stack)])
@pytest.mark.parametrize("name", MEASURE)
def test_they_are_named_where_nothing_is_measured(burst, name, make):
    measure, role = MEASURE[name]
    stack = with_nan(burst, np.arange(4, 60))
    with pytest.warns(
        UserWarning,
        match=rf"^{role}: frames 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, ... \(56 in all\) are NaN in every pixel",
    ):
        measure(make(stack))


def test_a_few_are_named_by_the_report(burst):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = itk.estimate_sensor_noise(with_nan(burst, [3, 7]))
    assert [frame["frame"] for frame in report["frames_left_out"]] == [3, 7]
    assert "frame 3: not-finite, frame 7: not-finite" in report["warnings"][0]["message"]


def test_one_of_the_dark_frames_is_named(burst, dark):
    with pytest.warns(UserWarning, match=r"^dark: frame 2 is NaN in every pixel"), pytest.raises(ValueError):
        itk.estimate_sensor_noise(burst.astype(np.float32), dark=with_nan(dark, [2]))


def test_pixels_that_are_nan_are_no_frames(burst):
    stack = burst.astype(np.float32)
    stack[:, 3, 4] = np.nan
    stack[5, 0] = np.nan
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert itk.estimate_sensor_noise(stack)["gain"]["value"]

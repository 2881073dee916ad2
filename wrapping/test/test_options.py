# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Options in the forms that Python has for them: slices for a region, a function for the progress."""

import itk
import numpy as np
import pytest


@pytest.mark.parametrize(
    "slices, rectangle",
    [
        (np.s_[10:60, 20:100], (20, 10, 80, 50)),
        (np.s_[:, 5:], (5, 0, 123, 96)),
        (np.s_[-50:-10, :64], (0, 46, 64, 40)),
        (np.s_[np.int64(10) : np.int64(60), 20:100:1], (20, 10, 80, 50)),
    ],
)
def test_slices_are_a_region(burst, slices, rectangle):
    found = itk.estimate_sensor_noise(burst, roi=slices)
    assert found == itk.estimate_sensor_noise(burst, roi=rectangle)
    rows, columns = slices
    assert found["gain"] == itk.estimate_sensor_noise(np.ascontiguousarray(burst[:, rows, columns]))["gain"]


@pytest.mark.parametrize(
    "slices, kind",
    [
        (np.s_[10:60], TypeError),
        (np.s_[10:60, 3], TypeError),
        (np.s_[0:5, 10:60, 20:100], TypeError),
        (np.s_[10:60:2, 20:100], ValueError),
        (np.s_[60:10, 20:100], ValueError),
        (np.s_[10:97, 20:100], ValueError),
        (np.s_[10:10, 20:100], ValueError),
        (np.s_[1.5:60, 20:100], TypeError),
        ((0, 0, 500, 9), ValueError),
        ("all", TypeError),
    ],
)
def test_other_slices_are_refused(burst, slices, kind):
    with pytest.raises(kind, match="^roi is .*; expected .*inside 128 x 96 pixels"):
        itk.estimate_sensor_noise(burst, roi=slices)


@pytest.mark.parametrize("make", [np.asarray, list])
def test_a_function_is_called_with_the_fraction_that_is_done(burst, make):
    fractions = []
    report = itk.estimate_sensor_noise(make(burst), progress=fractions.append)
    assert report == itk.estimate_sensor_noise(burst)
    assert fractions == sorted(fractions) and len(set(fractions)) == len(fractions) >= 3
    assert 0 < fractions[0] < 1 and fractions[-1] == 1.0


def test_an_error_of_the_function_stops_the_work(burst):
    calls = []

    def stop(fraction):
        calls.append(fraction)
        raise InterruptedError("enough")

    with pytest.raises(InterruptedError, match="^enough$"):
        itk.estimate_sensor_noise(burst, progress=stop)
    assert len(calls) == 1
    assert itk.estimate_sensor_noise(burst)["gain"]["value"]


def test_progress_of_another_type_is_refused(burst):
    with pytest.raises(TypeError, match="^progress is 'yes'; expected True, False or a function of the fraction"):
        itk.estimate_sensor_noise(burst, progress="yes")

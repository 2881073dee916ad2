# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests options in Python's forms: slices for a region, a function for the progress."""

import json
from collections import deque

import itk
import numpy as np
import pytest
from itk_sensornoise.distributed._journal import settings_record


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


def test_slices_are_settings_of_many_bursts():
    settings = {"roi": np.s_[10:60, np.int64(20) : 100], "frame_range": slice(5, 50)}
    record = settings_record(settings, {"roi": None, "frame_range": None})
    assert json.loads(json.dumps(record)) == {"roi": [[10, 60, None], [20, 100, None]], "frame_range": [5, 50, None]}


class Tensor:
    """Tensor of another library, which NumPy can read only through DLPack."""

    def __init__(self, array):
        self.array = array

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


class FarTensor(Tensor):
    def __dlpack__(self, **options):
        raise BufferError("it is on a GPU")


@pytest.mark.parametrize(
    "make", [deque, Tensor, lambda burst: list(map(Tensor, burst)), lambda burst: np.ma.masked_array(burst, mask=False)]
)
def test_frames_of_other_containers_are_frames(burst, make):
    assert itk.estimate_sensor_noise(make(burst)) == itk.estimate_sensor_noise(burst)


def test_a_tensor_elsewhere_is_refused(burst):
    with pytest.raises(ValueError, match="^frames cannot be made an array .it is on a GPU.; expected a tensor in main"):
        itk.estimate_sensor_noise(FarTensor(burst))


def test_masked_pixels_are_refused(burst):
    with pytest.raises(TypeError, match="^frames is a masked array, expected a plain one"):
        itk.estimate_sensor_noise(np.ma.masked_greater(burst, 3000))


def test_a_slice_is_a_range_of_frames(burst):
    expected = itk.estimate_sensor_noise(burst, frame_range=(5, 50))
    assert itk.estimate_sensor_noise(burst, frame_range=slice(5, 50)) == expected
    for wrong in (slice(5, 50, 2), slice(5, None), slice(50, 5)):
        with pytest.raises(ValueError, match="^frame_range is .*; expected .first, end. with 0 <= first < end"):
            itk.estimate_sensor_noise(burst, frame_range=wrong)


@pytest.mark.parametrize("make", [np.asarray, list, lambda numbers: pytest.importorskip("pandas").Series(numbers)])
def test_exposures_are_any_numbers(burst, make):
    numbers = [1.0, 2.0, 3.0, 4.0] * 15
    assert itk.estimate_sensor_noise(burst, exposures=make(numbers))["linearity"]["levels"]

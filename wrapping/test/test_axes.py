# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that (t, y, x) in NumPy is (x, y, t) in ITK, and that the memory order of arrays does not matter."""

import itk
import numpy as np
import pytest


@pytest.fixture
def skew() -> np.ndarray:
    """Returns a stack (7, 5, 4) in which an exchange of any two axes changes the result."""
    t, y, x = np.meshgrid(np.arange(7), np.arange(5), np.arange(4), indexing="ij")
    return (100 * x + 10 * y**2 + t**3).astype(np.uint16)


def test_mean_of_an_asymmetric_stack_lies_where_numpy_has_it(skew):
    mean, variance, _ = itk.temporal_statistics_image_filter(skew)
    assert mean.shape == (5, 4)
    np.testing.assert_allclose(mean, skew.mean(axis=0), rtol=1e-14)
    np.testing.assert_allclose(variance, skew.var(axis=0, ddof=1), rtol=1e-13)


def test_itk_has_x_first(skew):
    found = itk.TemporalStatisticsImageFilter.New(itk.image_view_from_array(skew))
    found.Update()
    assert tuple(found.GetMean().GetLargestPossibleRegion().GetSize()) == (4, 5)
    assert found.GetMean().GetPixel([3, 1]) == pytest.approx(skew[:, 1, 3].mean(), rel=1e-14)


def test_report_has_width_height_and_frames(burst):
    report = itk.estimate_sensor_noise(burst)
    assert (report["frames"], report["height"], report["width"]) == burst.shape
    assert len(report["flicker"]) == len(burst)


def sliced(stack):
    larger = np.zeros((2 * stack.shape[0], stack.shape[1] + 3, stack.shape[2] + 2), stack.dtype)
    larger[::2, 1:-2, 2:] = stack
    return larger[::2, 1:-2, 2:]


def read_only(stack):
    copy = stack.copy()
    copy.flags.writeable = False
    return copy


def reversed_memory(stack):
    return stack[::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1]


LAYOUTS = {
    "Fortran": np.asfortranarray,
    "time last": lambda stack: np.moveaxis(np.moveaxis(stack, 0, 2).copy(), 2, 0),
    "sliced": sliced,
    "reversed": reversed_memory,
    "big-endian": lambda stack: stack.astype(stack.dtype.newbyteorder(">")),
    "read-only": read_only,
    "list": list,
    "tuple of Fortran frames": lambda stack: tuple(map(np.asfortranarray, stack)),
    "list of big-endian frames": lambda stack: list(stack.astype(stack.dtype.newbyteorder(">"))),
    "itk.Image": itk.image_view_from_array,
    "list of itk.Image": lambda stack: [itk.image_from_array(frame) for frame in stack],
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_any_layout_gives_the_same_report(burst, layout):
    laid_out = LAYOUTS[layout](burst)
    before = np.array(laid_out) if isinstance(laid_out, np.ndarray) else None
    assert itk.estimate_sensor_noise(laid_out) == itk.estimate_sensor_noise(burst)
    if before is not None:
        np.testing.assert_array_equal(laid_out, before)


def test_pixel_types_that_hold_the_same_grey_values_agree(stack, grey_values, pixel):
    report = itk.estimate_sensor_noise(stack, rolling_shutter="off", clip=(0, 255), step=1)
    expected = itk.estimate_sensor_noise(grey_values, rolling_shutter="off", clip=(0, 255), step=1)
    assert report["pixels"] == expected["pixels"]
    # With integers the sums are in another order: errors far below 1e-9. Means of floating-point numbers differ in
    # their last bits, so that pixels at the limits of a set may change sides. The limit 1e-4 is a fortieth of the
    # standard error of the gain, about sqrt(2 / 40 / 3000 pixels) = 0.4 %.
    rel = 1e-4 if pixel.startswith("float") else 1e-9
    assert report["gain"]["value"] == pytest.approx(expected["gain"]["value"], rel=rel)

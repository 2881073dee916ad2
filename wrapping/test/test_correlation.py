# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the spatial and temporal noise correlation of white and of filtered flat fields with closed forms."""

import copy
import json
import pickle
import re

import itk
import numpy as np
import pytest
from conftest import ITK_TYPES

# The errors are from a jackknife over 20 tiles. The 99.9 % quantile of Student's t for 19 degrees of freedom is 3.9.
Z = 4


def flat(kernel=(1.0,), frames=30, height=128, width=160):
    """Returns frames (t, y, x) of 100 DN with normal noise. Its standard deviation is 3 DN before a filter along x."""
    noise = np.random.default_rng(4).normal(0, 3, (frames, height, width + len(kernel) - 1))
    return 100 + sum(weight * noise[:, :, k : k + width] for k, weight in enumerate(kernel))


@pytest.fixture(scope="module")
def white():
    return flat()


@pytest.fixture(scope="module")
def smooth():
    return flat((0.25, 0.5, 0.25))


def is_near(found, truth):
    return abs(found.sum_over_lags - truth) < Z * found.standard_error


def test_white_noise_sums_to_one(white):
    found = itk.noise_correlation_estimator(white)
    assert found.kind == "white" and is_near(found, 1)
    # The limit allows for eight neighbours, and by a factor 3 for weights that decrease at the borders of tiles.
    assert found.standard_error < 4 * 3 / np.sqrt(20480 * 28)
    value, error = found.coefficient(1, 0)
    assert abs(value) < Z * error and error < 0.004
    assert found["frames"] == found["frames_used"] == 30 and found["pixels_used"] == 20480
    assert found["noise_correlation"]["row_noise"]["status"] == "upper-limit"


def test_smoothed_noise_sums_to_its_closed_form(smooth):
    """With the weights 1/4, 1/2 and 1/4, the variance is 3/8 of the original variance, lag 1 has 1/4 and lag 2 has 1/16
    of it."""
    found = itk.noise_correlation_estimator(smooth)
    assert found.kind == "filtered" and is_near(found, 8 / 3)
    assert found.standard_error < 0.1
    for lag, truth in (((1, 0), 2 / 3), ((2, 0), 1 / 6), ((-1, 0), 2 / 3), ((0, 1), 0)):
        value, error = found.coefficient(*lag)
        assert abs(value - truth) < Z * error
    for signal_bin in found["lights"]:
        assert abs(signal_bin["variance"] - 0.375 * 9) < Z * signal_bin["variance_standard_error"]
    with pytest.raises(KeyError, match="50 columns, 0 rows"):
        found.coefficient(50, 0)


def test_mixed_frames_are_named():
    noise = np.random.default_rng(4).normal(0, 3, (31, 128, 160))
    found = itk.noise_correlation_estimator(100 + 0.5 * (noise[1:] + noise[:-1]))
    assert found.kind == "temporal"
    value, error = found.coefficient(frames=1)
    assert abs(value - 0.5) < Z * error
    variance = np.mean([signal_bin["variance"] for signal_bin in found["lights"]])
    assert abs(variance * found.sum_over_lags - 9) < Z * variance * found.standard_error


def test_masked_pixels_are_left_out(white, smooth):
    half = np.concatenate([smooth[:, :, :80], white[:, :, 80:]], axis=2)
    assert itk.noise_correlation_estimator(half).kind == "filtered"
    mask = np.arange(160) >= 80
    found = itk.noise_correlation_estimator(half, mask=np.broadcast_to(mask, (128, 160)))
    assert found.kind == "white" and is_near(found, 1)
    assert found["pixels_used"] < 20480


def test_mean_and_mask_of_the_statistics(white):
    stack = np.rint(white).astype(np.uint16)
    mean, _, valid = itk.temporal_statistics_image_filter(stack)
    found = itk.noise_correlation_estimator(stack)
    assert itk.noise_correlation_estimator(stack, mean=mean, mask=valid) == found
    assert itk.noise_correlation_estimator(itk.image_view_from_array(stack), mask=valid) == found
    assert itk.noise_correlation_estimator(list(stack)) == found


def test_series_are_taken_out(white):
    """A spatial pattern with a temporal component of mean 0 correlates neighbouring pixels until it is projected
    out."""
    series = np.where(np.arange(30) % 3 == 0, 2.0, -1.0)
    pattern = 3 * np.random.default_rng(8).normal(size=(32, 40)).repeat(4, axis=0).repeat(4, axis=1)
    stack = white + series[:, None, None] * pattern
    assert itk.noise_correlation_estimator(stack).kind != "white"
    assert itk.noise_correlation_estimator(stack, series=series).kind == "white"
    both = np.column_stack([np.arange(30.0), series])
    assert itk.noise_correlation_estimator(stack, series=both).kind == "white"


def test_frame_means_are_taken_out_unless_they_are_kept(white):
    stack = white + 2 * np.sin(0.5 * np.arange(30))[:, None, None]
    assert itk.noise_correlation_estimator(stack).kind == "white"
    assert itk.noise_correlation_estimator(stack, remove_frame_means=False).kind == "temporal"


def test_class_style(smooth, pixel):
    image = itk.image_view_from_array(np.rint(smooth).astype(pixel))
    found = itk.NoiseCorrelationEstimator[itk.Image[ITK_TYPES[pixel], 3]].New(image, offset=12.0)
    found.Update()
    expected = itk.noise_correlation_estimator(image, offset=12)
    assert json.loads(found.GetResultAsJson()) == expected
    assert found.GetKind() == expected.kind == "filtered"
    assert found.GetSumOverLags() == expected.sum_over_lags
    assert found.GetSumOverLagsStandardError() == expected.standard_error
    found.AddSeries([float(t) for t in range(len(smooth))])
    found.Update()
    assert found.GetNumberOfSeries() == 1 and found.GetSumOverLags() != expected.sum_over_lags


def test_a_sum_that_fails_is_not_a_number_in_class_style():
    """Flicker and vibration of the scene are not taken out here. They correlate pixels as no linear filter does."""
    grey_values, _ = itk.simulate_sensor_noise(
        frames=40, size=(96, 64), dtype="uint8", gain=0.07, offset=12, read_noise=1.2, seed=4
    )
    found = itk.NoiseCorrelationEstimator[itk.Image[itk.UC, 3]].New(itk.image_view_from_array(grey_values), offset=12.0)
    found.Update()
    assert found.GetKind() == "not-linear" and np.isnan(found.GetSumOverLags())
    assert itk.noise_correlation_estimator(grey_values, offset=12).sum_over_lags is None


def test_the_report_has_the_same_record(burst):
    report = itk.estimate_sensor_noise(burst)
    record = report["noise_correlation"]
    assert list(record) == list(itk.noise_correlation_estimator(burst)["noise_correlation"])
    estimator = itk.SensorNoiseEstimator.New(itk.image_view_from_array(burst))
    with pytest.raises(RuntimeError, match="there is no result"):
        estimator.GetNoiseKind()
    estimator.Update()
    assert estimator.GetNoiseKind() == record["kind"] == "white"


def test_it_travels_and_prints(smooth):
    found = itk.noise_correlation_estimator(smooth)
    for other in (pickle.loads(pickle.dumps(found)), copy.copy(found), copy.deepcopy(found)):
        assert other == found and type(other) is type(found) and other.to_json() == found.to_json()
    row = re.search(r"^sum over lags +([0-9.]+) ± ([0-9.]+)$", str(found), re.MULTILINE)
    assert float(row[1]) == pytest.approx(found.sum_over_lags, abs=0.05 * found.standard_error)
    assert float(row[2]) == pytest.approx(found.standard_error, rel=0.05)
    assert re.search(r"variance [0-9.]+ ± [0-9.]+ DN², sum over lags [0-9.]+ ± [0-9.]+$", str(found), re.MULTILINE)
    assert "+-" not in str(found)
    assert re.search(r"^1 columns, 0 rows +\+0\.6", str(found), re.MULTILINE)
    assert repr(found).startswith("<NoiseCorrelation: filtered, sum over lags 2.")


def test_few_pixels_are_not_measured(white):
    found = itk.noise_correlation_estimator(white[:, :20, :40])
    assert found.kind == "not-measured" and found.sum_over_lags is None and found.standard_error is None
    assert "not-measured" in str(found) and "failed" in repr(found)


@pytest.mark.parametrize(
    "parameters, message",
    [
        ({"mask": np.ones((128, 159))}, r"mask has shape \(128, 159\); expected \(128, 160\)"),
        ({"mean": np.ones((127, 160))}, r"mean has shape \(127, 160\); expected \(128, 160\)"),
        ({"series": np.ones(29)}, r"series has shape \(29,\); expected finite numbers, an array \(30,\)"),
        ({"series": [np.nan] * 30}, "series holds a number that is not finite"),
        ({"series": "flicker"}, "series is of type str"),
        ({"offset": np.inf}, "offset is inf"),
        ({"quantisation_step": 0}, "quantisation_step is 0; expected a number above 0"),
    ],
)
def test_wrong_use_is_named(white, parameters, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        itk.noise_correlation_estimator(white, **parameters)

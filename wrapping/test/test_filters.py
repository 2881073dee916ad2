# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests every filter in both styles of ITK, for every pixel type, with closed forms and against each other."""

import json

import itk
import numpy as np
import pytest
from conftest import ITK_TYPES

# Sums of 40 numbers below 256 in double have an error of 40 x 2.2e-16, times 10 for cancellation in the variance.
ROUNDING = 1e-13
# Grey values are summed relative to the middle of their range: the error is half a unit in the last place of 2^15.
MIDDLE = 2.0**15 * 2.0**-53


def stack_type(pixel):
    return itk.Image[ITK_TYPES[pixel], 3]


def image(array):
    return itk.image_view_from_array(array)


def array(output):
    return itk.array_from_image(output)


@pytest.fixture
def statistics(stack):
    """Returns mean, variance and valid mask in functional style: arrays in, arrays out."""
    return itk.temporal_statistics_image_filter(stack)


@pytest.fixture
def mask(statistics, stack):
    mean, variance, valid = statistics
    return itk.vibration_mask_image_filter(
        mean, variance=image(variance), valid_mask=image(valid), number_of_frames=len(stack)
    )


def test_temporal_statistics_are_those_of_numpy(stack, statistics):
    mean, variance, valid = statistics
    numbers = stack.astype(np.float64)
    np.testing.assert_allclose(mean, numbers.mean(axis=0), rtol=ROUNDING, atol=MIDDLE)
    np.testing.assert_allclose(variance, numbers.var(axis=0, ddof=1), rtol=ROUNDING)
    # The ends of the DN range clip. Floating-point numbers that are all whole have the range of the integers.
    is_clipped = ((stack == 0) | (stack == 255)).any(axis=0)
    np.testing.assert_array_equal(valid[~is_clipped], 1)


@pytest.mark.parametrize("is_explicit", [True, False])
def test_temporal_statistics_in_class_style(stack, pixel, statistics, is_explicit):
    template = itk.TemporalStatisticsImageFilter
    found = (template[stack_type(pixel)] if is_explicit else template).New(image(stack))
    found.Update()
    for output, expected in zip((found.GetMean(), found.GetVariance(), found.GetValidMask()), statistics, strict=True):
        np.testing.assert_array_equal(array(output), expected)
    assert found.GetFoundQuantisationStep() == 1
    assert found.GetNumberOfNotFinitePixels() == 0


def test_vibration_mask_in_class_style(stack, statistics, mask):
    mean, variance, valid = map(image, statistics)
    found = itk.VibrationMaskImageFilter.New(mean, Variance=variance, ValidMask=valid, NumberOfFrames=len(stack))
    found.Update()
    np.testing.assert_array_equal(array(found.GetOutput()), mask)
    # The pixels of the mask have 2 T |grad|^2 / variance below the 99 % quantile of chi-square with 2 degrees of
    # freedom, -2 ln 0.01.
    rows, columns = np.gradient(statistics[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = 2 * len(stack) * (rows**2 + columns**2) / statistics[1]
    expected = (ratio < -2 * np.log(0.01)) & (statistics[2] != 0)
    np.testing.assert_array_equal(mask[1:-1, 1:-1], expected[1:-1, 1:-1])


def flicker_inputs(statistics, mask):
    mean, variance, _ = statistics
    return {"mean": image(mean), "variance": image(variance), "mask": image(mask), "rolling_shutter": "off"}


def test_flicker_correction_is_its_formula(stack, statistics, mask):
    corrected = itk.flicker_correction_image_filter(stack, **flicker_inputs(statistics, mask))
    found = itk.FlickerCorrectionImageFilter.New(image(stack), **flicker_inputs(statistics, mask))
    found.Update()
    np.testing.assert_array_equal(array(found.GetOutput()), corrected)
    gamma = np.array(found.GetGamma())
    assert gamma.shape == (len(stack),)
    assert len(found.GetBrightRatio()) == len(found.GetDarkResidual()) == len(stack)
    assert len(found.GetGammaRows()) == 0
    # Equation (3.18), with differences of numbers below 300.
    expected = stack - (1 + gamma[:, None, None]) * (statistics[0] - found.GetRawOffset())
    np.testing.assert_allclose(corrected, expected, atol=300 * ROUNDING)


def test_gamma_by_row_of_a_rolling_shutter():
    stack, _ = itk.simulate_sensor_noise(frames=30, size=(64, 80), reference="bars", rolling_shutter=40.0)
    mean, variance, valid = itk.temporal_statistics_image_filter(stack)
    inputs = {"mean": image(mean), "variance": image(variance), "mask": image(valid)}
    found = itk.FlickerCorrectionImageFilter.New(image(stack), rolling_shutter="fixed", sigma_rows=4, **inputs)
    found.Update()
    assert len(found.GetGammaRows()) == 30 * 80
    assert found.GetFoundSigmaRows() == 4


def test_chain_by_hand_gives_the_numbers_of_the_one_call_way(stack, statistics, mask):
    correction = itk.FlickerCorrectionImageFilter.New(image(stack), **flicker_inputs(statistics, mask))
    correction.Update()
    _, variance, _ = itk.temporal_statistics_image_filter(array(correction.GetOutput()))
    chain = itk.noise_regression_estimator(
        statistics[0], variance, mask, offset=correction.GetOffset(), number_of_frames=len(stack)
    )
    whole = itk.estimate_sensor_noise(stack, method="published", rolling_shutter="off")
    # The limit 1e-9 is a requirement of the design.
    assert chain["gain"]["value"] == pytest.approx(whole["gain"]["value"], rel=1e-9)
    assert chain["intercept"]["value"] == pytest.approx(whole["intercept"]["value"], rel=1e-9)
    assert chain["pixels"]["used"] == whole["pixels"]["used"]


def test_regression_recovers_a_line():
    mean = np.linspace(100, 3000, 96 * 64).reshape(64, 96)
    variance = 1.5 * mean + 20
    ones = np.ones((64, 96), np.uint8)
    report = itk.noise_regression_estimator(mean, variance, ones, offset=100.0)
    assert report["gain"]["value"] == pytest.approx(1.5, rel=1e-12)
    assert report["intercept"]["value"] == pytest.approx(20, rel=1e-9)
    # sigma^2 = intercept + g mu
    assert report["read_noise"]["value"] == pytest.approx(np.sqrt(170), rel=1e-9)
    found = itk.NoiseRegressionEstimator.New(image(mean), variance=image(variance), mask=image(ones), offset=100.0)
    found.Update()
    assert json.loads(found.GetReportAsJson()) == report
    assert found.GetReportAsText() == str(report) + "\n"


def test_vibration_covariance_recovers_a_quadratic_form():
    generator = np.random.default_rng(1)
    mean = np.cumsum(np.cumsum(generator.normal(size=(64, 96)), axis=0), axis=1)
    rows, columns = np.gradient(mean)
    # Equation (2.20) with Cov = ((4, 1), (1, 9)) 1e-4 and sigma_gamma^2 = 0.01.
    moved = 4e-4 * columns**2 + 9e-4 * rows**2 + 2 * 1e-4 * rows * columns
    variance = 1.01 * moved + 0.01 * mean**2 + 3.0 * mean + 5.0
    found = itk.vibration_covariance_estimator(mean, variance)
    assert found["is_determined"]
    assert found["variance_x"] == pytest.approx(4e-4, rel=1e-6)
    assert found["variance_y"] == pytest.approx(9e-4, rel=1e-6)
    assert found["flicker_variance"] == pytest.approx(0.01, rel=1e-6)
    assert found["covariance"] == pytest.approx(1e-4, rel=1e-5)
    classy = itk.VibrationCovarianceEstimator.New(image(mean), variance=image(variance))
    classy.Update()
    assert classy.GetVarianceX() == found["variance_x"]
    assert classy.GetIsDetermined()


def test_estimator_in_both_styles(stack, pixel):
    parameters = {"method": "published", "level": 0.02, "rolling_shutter": "off"}
    report = itk.sensor_noise_estimator(stack, **parameters)
    assert report["settings"]["level"] == 0.02
    found = itk.SensorNoiseEstimator[stack_type(pixel)].New(image(stack), **parameters)
    found.Update()
    assert json.loads(found.GetReportAsJson()) == report
    assert report == itk.estimate_sensor_noise(stack, **parameters)
    assert array(found.GetMean()).shape == array(found.GetCorrectedVariance()).shape == stack.shape[1:]
    assert (array(found.GetPixelUse()) == 0).sum() == report["pixels"]["used"]


def test_refined_estimator_in_both_styles(burst, dark):
    report = itk.sensor_noise_estimator(burst, dark=dark)
    found = itk.SensorNoiseEstimator.New(image(burst), dark=image(dark))
    assert found.GetMethodName() == "refined"
    found.Update()
    assert json.loads(found.GetReportAsJson()) == report
    assert report == itk.estimate_sensor_noise(burst, dark=dark)
    known = itk.sensor_noise_estimator(burst, offset=100.0, offset_standard_error=0.5)
    assert known == itk.estimate_sensor_noise(burst, offset=(100.0, 0.5))
    with pytest.raises(ValueError, match="^dark has pixels of type uint8; expected uint16, as the stack"):
        itk.sensor_noise_estimator(burst, dark=dark.astype(np.uint8))


def test_sources_in_both_styles(pixel):
    scene = itk.SensorNoiseSceneSource.New(scene="bars", width=48, height=32)
    source = itk.SensorNoiseStackSource[stack_type(pixel)].New(reference=scene.GetOutput(), number_of_frames=7, seed=9)
    source.Update()
    found = array(source.GetOutput())
    assert found.shape == (7, 32, 48) and found.dtype == pixel
    assert json.loads(source.GetTruthAsJson())["seed"] == 9
    drawn = itk.sensor_noise_scene_source(scene="bars", width=48, height=32)
    np.testing.assert_array_equal(array(drawn), array(scene.GetOutput()))
    simulated, truth = itk.simulate_sensor_noise(frames=7, size=(48, 32), reference="bars", seed=9, dtype=pixel)
    np.testing.assert_array_equal(simulated, found)
    assert truth["gain"] == 1.0 and truth["camera"] == "B" and truth["condition"] == 3


@pytest.mark.parametrize(
    "name, pixel, dimension, getter",
    [
        ("SensorNoiseEstimator", itk.US, 3, "GetReportAsJson"),
        ("SensorNoiseEstimator", itk.US, 3, "GetReportAsText"),
        ("NoiseRegressionEstimator", itk.D, 2, "GetReportAsJson"),
        ("NoiseCorrelationEstimator", itk.US, 3, "GetResultAsJson"),
        ("VibrationCovarianceEstimator", itk.D, 2, "GetCovariance"),
    ],
)
def test_without_an_update_there_is_no_result(name, pixel, dimension, getter):
    estimator = getattr(itk, name)[itk.Image[pixel, dimension]].New()
    with pytest.raises(RuntimeError, match=r"there is no result: Update.. of the estimator comes first"):
        getattr(estimator, getter)()

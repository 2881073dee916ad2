# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the generalized Anscombe transform and its inverses, which return the type of the input: array or image."""

import json
import warnings

import itk
import numpy as np
import pytest

MODEL = {"variance_slope": 0.5, "total_intercept": -3.0}


def report_of(slope, intercept, **more):
    """Returns a report with the two required numbers. A report of smoothed frames may have no others."""
    return {
        "schema": "itk-sensornoise-report/1",
        "variance_slope": {"value": slope, "status": "identified"},
        "total_intercept": {"value": intercept, "status": "identified"},
        **more,
    }


def formula(levels, slope=0.5, intercept=-3.0):
    return 2 / slope * np.sqrt(np.maximum(0, slope * levels.astype(np.float64) + 0.375 * slope**2 + intercept))


def test_array_of_every_type_and_dimension(pixel):
    levels = (np.arange(120) + 6).astype(pixel)
    for shape in ((120,), (10, 12), (2, 5, 12), (2, 2, 5, 6)):
        found = itk.generalized_anscombe_image_filter(levels.reshape(shape), **MODEL)
        assert found.shape == shape and found.dtype == ("float64" if pixel == "float64" else "float32")
        np.testing.assert_allclose(found.ravel(), formula(levels), rtol=2e-7)
        back = itk.inverse_generalized_anscombe_image_filter(found, **MODEL, inverse="algebraic", dtype=pixel)
        assert back.dtype == pixel
        np.testing.assert_allclose(back.ravel(), levels, rtol=1e-6 if pixel.startswith("float") else 0)


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_image_gives_image_in_both_styles(pixel):
    levels = np.arange(60).reshape(3, 4, 5).astype(pixel)
    for array in (levels, levels[0]):
        image = itk.image_from_array(array)
        image.SetSpacing([0.5] * array.ndim)
        found = itk.generalized_anscombe_image_filter(image, **MODEL)
        assert found.GetSpacing()[0] == 0.5
        classy = itk.GeneralizedAnscombeImageFilter.New(image, VarianceSlope=0.5, TotalIntercept=-3.0)
        classy.Update()
        np.testing.assert_array_equal(itk.array_from_image(classy.GetOutput()), itk.array_from_image(found))
        assert classy.GetNumberOfNegativeArguments() == (array < 5.8125).sum()
        inverse = itk.InverseGeneralizedAnscombeImageFilter.New(found, variance_slope=0.5, total_intercept=-3.0)
        inverse.Update()
        expected = itk.inverse_generalized_anscombe_image_filter(found, **MODEL)
        np.testing.assert_array_equal(itk.array_from_image(inverse.GetOutput()), itk.array_from_image(expected))


def test_arrays_that_lie_otherwise_in_memory():
    levels = (np.arange(120) + 6).reshape(10, 12)
    for array in (levels.astype(">u2"), np.asfortranarray(levels.astype("u2")), levels.astype("u2")[::-1, ::2]):
        found = itk.generalized_anscombe_image_filter(array, **MODEL)
        np.testing.assert_allclose(found, formula(array), rtol=2e-7)


def test_model_of_a_report_a_mapping_or_a_file(burst, tmp_path):
    report = itk.estimate_sensor_noise(burst)
    numbers = {name: report[name]["value"] for name in MODEL}
    expected = itk.generalized_anscombe_image_filter(burst, **numbers)
    (tmp_path / "report.json").write_text(report.to_json(), encoding="utf-8")
    for model in (report, dict(report), tmp_path / "report.json", str(tmp_path / "report.json")):
        np.testing.assert_array_equal(itk.generalized_anscombe_image_filter(burst, model), expected)
        back = itk.inverse_generalized_anscombe_image_filter(expected, model, inverse="algebraic", dtype="uint16")
        np.testing.assert_array_equal(back, burst)


def test_closed_form_brings_a_mean_back_without_bias():
    """The tolerance for 200,000 draws at 8 e- and a read noise of 2 e- is 4 standard errors of the mean, plus the error
    0.013 e- of the closed form."""
    random = np.random.default_rng(4)
    gain, offset, read_noise, signal = 2.0, 100.0, 2.0, 8.0
    levels = offset + gain * (random.poisson(signal, 200000) + read_noise * random.normal(size=200000))
    model = report_of(gain, (gain * read_noise) ** 2 - gain * offset)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mean = itk.generalized_anscombe_image_filter(levels, model).mean()
    found = {
        inverse: (itk.inverse_generalized_anscombe_image_filter(np.array([mean]), model, inverse=inverse)[0] - offset)
        / gain
        for inverse in ("exact-unbiased", "algebraic", "asymptotic")
    }
    error = 4 * np.sqrt((signal + read_noise**2) / 200000)
    assert found["exact-unbiased"] == pytest.approx(signal, abs=error + 0.013)
    assert found["asymptotic"] == pytest.approx(signal, abs=error + 0.011)
    assert found["algebraic"] == pytest.approx(signal - 0.25, abs=error + 0.01)


def test_negative_arguments_are_said():
    with pytest.warns(
        UserWarning, match=r"^6 of 10 pixels are below 5\.8125 DN, where the noise model has no variance"
    ):
        found = itk.generalized_anscombe_image_filter(np.arange(10, dtype=np.uint8), **MODEL)
    assert (found[:6] == 0).all() and (found[6:] > 0).all()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        itk.generalized_anscombe_image_filter(np.arange(6, 10, dtype=np.uint8), **MODEL)


def test_not_a_number_stays_one_but_for_integers():
    levels = np.array([[np.nan, 50.0]])
    found = itk.generalized_anscombe_image_filter(levels, **MODEL)
    assert np.isnan(found[0, 0]) and not np.isnan(found[0, 1])
    assert np.isnan(itk.inverse_generalized_anscombe_image_filter(found, **MODEL)[0, 0])
    with pytest.raises(ValueError, match=r"^1 stabilised value\(s\) are NaN, which integers cannot hold"):
        itk.inverse_generalized_anscombe_image_filter(found, **MODEL, dtype="uint16")


FRAME = np.full((4, 4), 50, np.uint16)


@pytest.mark.parametrize(
    "arguments, said",
    [
        ({}, "there is no noise model"),
        ({"variance_slope": 1.0}, "there is no noise model"),
        ({"variance_slope": -1.0, "total_intercept": 0}, r"variance_slope is -1.0; expected a finite number above 0"),
        ({"variance_slope": 1.0, "total_intercept": np.nan}, "total_intercept is nan; expected a finite number"),
        ({"report": report_of(1.0, 2.0), "variance_slope": 1.0}, "a report and numbers of the noise model were given"),
        ({"report": report_of(0.0, 2.0)}, "variance_slope is 0.0; expected a finite number above 0"),
        ({"report": report_of(None, 2.0)}, "the report's variance_slope has no value"),
        ({"report": report_of(1.0, None)}, "the report's total_intercept has no value"),
        ({"report": {"schema": "x/2"}}, "the report has the schema 'x/2'; expected \"itk-sensornoise-report/1\""),
        ({"report": report_of(1.0, 2.0, channels=[])}, "the report has several channels"),
        ({"report": 3}, "the report is of type int"),
        ({"report": "nowhere.json"}, "nowhere.json cannot be read"),
        ({**MODEL, "dtype": "uint16"}, "dtype is 'uint16'; expected float32 or float64"),
        ({**MODEL, "image": FRAME.astype(np.int64)}, "image has dtype int64"),
        ({**MODEL, "image": np.float32(3)}, "image is of type float32|image has shape"),
        ({**MODEL, "image": FRAME[:0]}, "image has shape .0, 4., which holds no pixel"),
    ],
)
def test_wrong_use_is_refused(arguments, said):
    arguments = {"image": FRAME, **arguments}
    with pytest.raises(ValueError, match=said):
        itk.generalized_anscombe_image_filter(**arguments)


def test_masked_pixels_are_refused():
    masked = np.ma.masked_equal(FRAME, 50)
    for image in (masked, pytest.importorskip("dask.array").from_array(masked)):
        with pytest.raises(
            TypeError, match="^image is a masked array, expected a plain one: fill in the masked pixels"
        ):
            itk.generalized_anscombe_image_filter(image, **MODEL)
        with pytest.raises(
            TypeError, match="^image is a masked array, expected a plain one: fill in the masked pixels"
        ):
            itk.denoise_with_noise_model(image, **MODEL)


def test_wrong_use_of_the_inverse_is_refused(tmp_path):
    with pytest.raises(ValueError, match="image has dtype uint16; expected stabilised values, float32 or float64"):
        itk.inverse_generalized_anscombe_image_filter(FRAME, **MODEL)
    with pytest.raises(ValueError, match="inverse is 'exact'; expected 'exact-unbiased' or"):
        itk.inverse_generalized_anscombe_image_filter(FRAME.astype(np.float32), **MODEL, inverse="exact")
    broken = tmp_path / "report.json"
    broken.write_text("{", encoding="utf-8")
    with pytest.raises(ValueError, match="report.json is no JSON"):
        itk.inverse_generalized_anscombe_image_filter(FRAME.astype(np.float32), broken)
    broken.write_text(json.dumps([1]), encoding="utf-8")
    with pytest.raises(ValueError, match="report.json is of type list"):
        itk.inverse_generalized_anscombe_image_filter(FRAME.astype(np.float32), broken)

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests ITK conventions: filters stand for their outputs, results have the input type, methods are accessible."""

import itk
import numpy as np
import pytest

MODEL = {"variance_slope": 1.0, "total_intercept": 64.0}


@pytest.fixture
def labelled(burst):
    xarray = pytest.importorskip("xarray")
    coords = {"y": np.arange(96) * 0.5, "time": np.arange(60) * 0.04, "setting": 3}
    return xarray.DataArray(burst, dims=("time", "y", "x"), coords=coords)


KEPT = []  # a deleted filter leaves its output without pixels


def reader_of(image):
    """Returns a filter that has not run yet, whose output is the image."""
    KEPT.append(itk.CastImageFilter[type(image), type(image)].New(image))
    return KEPT[-1]


@pytest.mark.parametrize("make", [lambda reader: reader, lambda reader: reader.GetOutput()])
def test_a_filter_stands_for_its_output(burst, make):
    def stack():
        return make(reader_of(itk.image_view_from_array(burst)))

    assert itk.estimate_sensor_noise(stack()) == itk.estimate_sensor_noise(burst)
    assert itk.sensor_noise_estimator(stack()) == itk.sensor_noise_estimator(burst)
    assert itk.noise_correlation_estimator(stack()) == itk.noise_correlation_estimator(burst)
    mean, variance, valid = itk.temporal_statistics_image_filter(stack())
    expected = itk.temporal_statistics_image_filter(burst)
    for image, array in zip((mean, variance, valid), expected, strict=True):
        assert isinstance(image, itk.Image) and (itk.array_from_image(image) == array).all()
    report = itk.noise_regression_estimator(make(reader_of(mean)), reader_of(variance), reader_of(valid))
    assert report == itk.noise_regression_estimator(*expected)
    found = itk.vibration_covariance_estimator(make(reader_of(mean)), reader_of(variance))
    assert found == itk.vibration_covariance_estimator(*expected[:2])


@pytest.mark.parametrize("make", [lambda reader: reader, lambda reader: reader.GetOutput()])
def test_a_filter_stands_for_its_picture(burst, make):
    def picture():
        return make(reader_of(itk.image_view_from_array(burst)))

    stabilised = itk.generalized_anscombe_image_filter(picture(), **MODEL)
    assert isinstance(stabilised, itk.Image)
    np.testing.assert_array_equal(stabilised, itk.generalized_anscombe_image_filter(burst, **MODEL))
    clean = itk.denoise_with_noise_model(picture(), denoiser=lambda frame: frame, **MODEL)
    assert isinstance(clean, itk.Image) and itk.array_from_image(clean).shape == burst.shape


def test_xarray_gives_xarray(labelled, burst):
    expected = itk.temporal_statistics_image_filter(burst)
    for turned in (labelled, labelled.transpose("x", "time", "y")):
        found = itk.temporal_statistics_image_filter(turned)
        assert [each.name for each in found] == ["mean", "variance", "valid"]
        for each, array in zip(found, expected, strict=True):
            np.testing.assert_array_equal(each.transpose("y", "x"), array)
            np.testing.assert_array_equal(each.y, labelled.y)
            assert "time" not in each.coords
    stabilised = itk.generalized_anscombe_image_filter(labelled, **MODEL)
    assert stabilised.dims == labelled.dims and (stabilised.time == labelled.time).all()
    np.testing.assert_array_equal(stabilised, itk.generalized_anscombe_image_filter(burst, **MODEL))
    assert itk.inverse_generalized_anscombe_image_filter(stabilised, **MODEL).dims == labelled.dims
    assert itk.denoise_with_noise_model(labelled, denoiser=lambda frame: frame, **MODEL).dims == labelled.dims


def test_steps_of_the_published_method_take_arrays(burst, labelled):
    mean, variance, valid = itk.temporal_statistics_image_filter(burst)
    mask = itk.vibration_mask_image_filter(mean, variance=variance, valid_mask=valid, number_of_frames=60)
    classy = itk.VibrationMaskImageFilter.New(
        itk.image_view_from_array(mean),
        Variance=itk.image_view_from_array(variance),
        ValidMask=itk.image_view_from_array(valid),
        NumberOfFrames=60,
    )
    classy.Update()
    np.testing.assert_array_equal(mask, itk.array_from_image(classy.GetOutput()))
    parameters = {"mean": mean, "variance": variance, "mask": mask, "rolling_shutter": "off"}
    corrected = itk.flicker_correction_image_filter(burst, **parameters)
    assert isinstance(corrected, np.ndarray) and corrected.shape == burst.shape
    images = {
        name: itk.image_view_from_array(value) if isinstance(value, np.ndarray) else value
        for name, value in parameters.items()
    }
    again = itk.flicker_correction_image_filter(reader_of(itk.image_view_from_array(burst)), **images)
    assert isinstance(again, itk.Image)
    np.testing.assert_array_equal(corrected, itk.array_from_image(again))
    assert itk.flicker_correction_image_filter(labelled, **parameters).dims == labelled.dims
    by_name = itk.temporal_statistics_image_filter(labelled)
    assert itk.vibration_mask_image_filter(by_name[0], variance=by_name[1], number_of_frames=60).dims == ("y", "x")


def test_wrong_use_of_the_steps_is_refused(burst):
    mean, variance, valid = itk.temporal_statistics_image_filter(burst)
    with pytest.raises(
        ValueError, match=r"^the shapes are mean \(96, 128\), variance \(95, 128\); expected one for all"
    ):
        itk.vibration_mask_image_filter(mean, variance=variance[1:])
    with pytest.raises(ValueError, match=r"^the shapes are .*frame \(90, 128\); expected one for all"):
        itk.flicker_correction_image_filter(burst[:, :90], mean=mean, variance=variance, mask=valid)
    with pytest.raises(TypeError, match="^sharpness is not a parameter of vibration_mask_image_filter"):
        itk.vibration_mask_image_filter(mean, variance=variance, sharpness=1)
    with pytest.raises(ValueError, match="expected the number of frames, at least 2"):
        itk.vibration_mask_image_filter(mean, variance=variance, number_of_frames=0)


def test_methods_can_be_opened_or_are_not_there(fresh):
    """SWIG returns a SwigPyObject for a struct, and warns of an enumeration when that object is deleted."""
    code = (
        "import itk, numpy as np\n"
        "image = itk.image_view_from_array(np.random.default_rng(1).integers(9, 90, (8, 48, 64), dtype=np.uint16))\n"
        "estimator = itk.SensorNoiseEstimator.New(image)\n"
        "estimator.Update()\n"
        "inverse = itk.InverseGeneralizedAnscombeImageFilter.New(itk.image_view_from_array(np.ones((4, 4))))\n"
        "flicker = itk.FlickerCorrectionImageFilter.New(image)\n"
        "shutters = estimator.GetRollingShutter(), flicker.GetRollingShutter()\n"
        "print(estimator.GetMethod(), *shutters, inverse.GetInverse())\n"
        "classes = [estimator, flicker, inverse, itk.TemporalStatisticsImageFilter.New(image)]\n"
        "classes += [itk.NoiseCorrelationEstimator.New(image), itk.SensorNoiseStackSource[type(image)].New()]\n"
        "print([name for each in classes for name in ('GetReport', 'GetSummary', 'GetTruth', 'GetFlicker', 'GetResult')"
        " if hasattr(each, name)])"
    )
    assert fresh(code) == "refined auto auto exact-unbiased\n[]\n"

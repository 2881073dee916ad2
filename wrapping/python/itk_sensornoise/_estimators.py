# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Estimators, whose result is a record, in ITK's functional style: arrays or images in, a mapping out."""

import re
from typing import Any

import numpy as np

from . import _options
from ._arrays import FILL_MASKED, as_frame, as_mask, view
from ._channels import ChannelReports, report_of
from ._errors import InvalidTypeError, InvalidValueError, cause_of, itk_errors, python_error_of
from ._frames import Stack, frame_image, open_frames
from ._like import frame_like
from ._nan_frames import warn_of_nan_frames
from ._progress import at_work
from ._report import Report
from ._types import Frame, Frames, ItkObject
from ._update import update


def set_parameters(instance: ItkObject, parameters: dict[str, Any], function: str) -> None:
    """Sets a filter's parameters by ITK's snake-case names. Raises TypeError, with the name of the `function` that they
    were given to, for an unknown one and for a value of a wrong type, ValueError for a wrong value."""
    for name, value in parameters.items():
        setter = getattr(instance, "Set" + "".join(word.capitalize() for word in name.split("_")), None)
        if setter is None:
            raise InvalidTypeError(f"{name} is not a parameter of {function}(){_similar(name, instance)}")
        if isinstance(value, np.generic):
            value = value.item()  # noqa: PLW2901 - SWIG takes Python's numbers alone
        try:
            setter(value)
        except (TypeError, OverflowError) as error:  # SWIG raises these: the value fits no type of C++
            kind = InvalidTypeError if isinstance(error, TypeError) else InvalidValueError
            raise kind(f"{name} is {value!r}; {cause_of(error)}") from None
        except RuntimeError as error:
            raise python_error_of(error) from None


def _similar(name: str, instance: ItkObject) -> str:
    """Returns advice for a name that is no parameter."""
    import difflib

    setters = (known.removeprefix("Set") for known in dir(instance) if known.startswith("Set"))
    names = [re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", setter).lower() for setter in setters]
    found = difflib.get_close_matches(name, names, 1)
    return f"; expected another name, perhaps {found[0]}" if found else "; help() of the function names them"


def require_one_shape(**arrays: np.ndarray | None) -> None:
    """Raises ValueError if arrays that belong together have several shapes."""
    shapes = {name: array.shape for name, array in arrays.items() if array is not None}
    if len(set(shapes.values())) > 1:
        found = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise ValueError(f"the shapes are {found}; expected one for all")


def mask_of_frames(mask: Frame, stack: Stack) -> np.ndarray:
    """Returns a mask, which must have the size of the frames."""
    array = as_mask(mask, "mask")
    if array.shape != stack.size[1::-1]:
        raise ValueError(f"mask has shape {array.shape}; expected {stack.size[1::-1]}, the shape of a frame")
    return array


def sensor_noise_estimator(
    stack: Frames, *, mask: Frame | None = None, dark: Frames | None = None, **parameters: Any
) -> Report | ChannelReports:
    """Measures noise with itk.SensorNoiseEstimator in functional style; estimate_sensor_noise() checks more.

    Parameters
    ----------
    stack : frames
        As `frames` of estimate_sensor_noise(), or a filter of ITK whose output is a stack.
    mask : array_like (y, x) or itk.Image, optional
        Pixels of value 0 are left out. Default: all pixels count.
    dark : frames, optional
        Frames without illumination, as `stack`.
    **parameters
        The parameters of itk.SensorNoiseEstimator in snake case, for example `method="published", bit_depth=12,
        rolling_shutter="off"`.

    Returns
    -------
    Report or ChannelReports

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    estimate_sensor_noise : The same with regions, maps, hashes and files without a header.

    Examples
    --------
    >>> itk.sensor_noise_estimator(frames, bit_depth=12).gain
    """
    import itk

    opened = open_frames(stack)
    stacks = [opened]
    estimator = opened.estimator(itk.SensorNoiseEstimator)
    set_parameters(estimator, parameters, "sensor_noise_estimator")
    if mask is not None:
        mask_array = mask_of_frames(mask, opened)
        estimator.SetMask(frame_image(mask_array, opened.image))
    if dark is not None:
        dark_stack = open_frames(dark, name="dark")
        stacks.append(dark_stack)
        if dark_stack.pixel != opened.pixel:
            raise InvalidTypeError(f"dark has pixels of type {dark_stack.pixel}; expected {opened.pixel}, as the stack")
        estimator.SetDark(dark_stack.image)
    with at_work(estimator, False, *stacks), itk_errors():
        update(estimator)
    return report_of(estimator)


def temporal_statistics_image_filter(stack: Frames, **parameters: Any) -> tuple[Any, Any, Any]:
    """Computes the temporal mean and unbiased variance of every pixel of a stack, and the mask of valid pixels.

    Parameters
    ----------
    stack : frames
        As `frames` of estimate_sensor_noise(), or a filter of ITK whose output is a stack.
    **parameters
        The parameters of itk.TemporalStatisticsImageFilter in snake case, for example `bit_depth=12`.

    Returns
    -------
    mean, variance, valid : tuple
        Mean [DN], variance [DN^2], and 1 where a pixel is finite and never clipped, else 0: arrays (y, x); images where
        the stack is an itk.Image or a filter; xarray.DataArray where it is one.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    noise_regression_estimator : Gain and read noise from mean and variance.

    Examples
    --------
    >>> mean, variance, valid = itk.temporal_statistics_image_filter(frames)
    """
    import itk

    opened = open_frames(stack, name="stack", if_masked=FILL_MASKED)
    statistics = opened.estimator(itk.TemporalStatisticsImageFilter)
    set_parameters(statistics, parameters, "temporal_statistics_image_filter")
    with at_work(statistics, False, opened), itk_errors():
        update(statistics)
    if statistics.GetNumberOfNotFinitePixels() == opened.size[0] * opened.size[1]:
        warn_of_nan_frames(opened, "stack")
    return (
        frame_like(stack, statistics.GetMean(), "mean"),
        frame_like(stack, statistics.GetVariance(), "variance"),
        frame_like(stack, statistics.GetValidMask(), "valid"),
    )


def noise_regression_estimator(
    mean: Frame, variance: Frame, mask: Frame, *, offset: float | None = None, number_of_frames: int = 0
) -> Report:
    """Fits a line to the temporal variance against the mean: gain, intercept and read noise.

    Parameters
    ----------
    mean : array_like (y, x), itk.Image or filter
        Mean of the stack [DN].
    variance : array_like (y, x), itk.Image or filter
        Variance of the flicker-corrected stack [DN^2]. Pixels that are NaN are left out.
    mask : array_like (y, x), itk.Image or filter
        Pixels of value 0 are left out.
    offset : float, optional
        Dark offset mu [DN]. Without it, or where it is NaN, offset and read noise are not identifiable.
    number_of_frames : int, optional
        Frames that the variance was taken of: the fit is then tested, too. Default: 0, not known.

    Returns
    -------
    Report
        The record of estimate_sensor_noise() with these quantities filled.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    temporal_statistics_image_filter : Mean and variance of a stack.

    Examples
    --------
    >>> itk.noise_regression_estimator(mean, variance, valid, offset=100.0).gain
    """
    import itk

    mean_array, variance_array = as_frame(mean, "mean", np.float64), as_frame(variance, "variance", np.float64)
    mask_array = as_mask(mask, "mask")
    require_one_shape(mean=mean_array, variance=variance_array, mask=mask_array)
    estimator = itk.NoiseRegressionEstimator[itk.Image[itk.D, 2]].New()
    estimator.SetMean(view(mean_array))
    estimator.SetVariance(view(variance_array))
    estimator.SetMask(view(mask_array))
    estimator.SetNumberOfFrames(_options.integer("number_of_frames", number_of_frames, 0, 2**31))
    if offset is not None and not np.isnan(offset):
        estimator.SetOffset(_options.number("offset", offset))
    with itk_errors():
        update(estimator)
    return Report.of(estimator)


def vibration_covariance_estimator(
    mean: Frame, variance: Frame, *, valid_mask: Frame | None = None, flicker_sd: float | None = None
) -> dict[str, float | bool]:
    """Estimates the covariance of the vibration (alpha_t, beta_t) by multiple regression of the variance.

    Parameters
    ----------
    mean : array_like (y, x), itk.Image or filter
        Mean of the stack [DN].
    variance : array_like (y, x), itk.Image or filter
        Variance of the stack as it is [DN^2].
    valid_mask : array_like (y, x), itk.Image or filter, optional
        Pixels of value 0 are left out. Default: all finite pixels count.
    flicker_sd : float, optional
        Standard deviation sigma_gamma of the illumination [1]. Default: estimated.

    Returns
    -------
    dict
        `variance_x`, `variance_y`, `covariance` [pixel^2], `flicker_variance` [1] and `is_determined`, whether the
        scene determines them.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    temporal_statistics_image_filter : Mean and variance of a stack.

    Examples
    --------
    >>> itk.vibration_covariance_estimator(mean, variance)["variance_x"]
    """
    import itk

    mean_array, variance_array = as_frame(mean, "mean", np.float64), as_frame(variance, "variance", np.float64)
    mask_array = None if valid_mask is None else as_mask(valid_mask, "valid_mask")
    require_one_shape(mean=mean_array, variance=variance_array, valid_mask=mask_array)
    estimator = itk.VibrationCovarianceEstimator[itk.Image[itk.D, 2]].New()
    estimator.SetMean(view(mean_array))
    estimator.SetVariance(view(variance_array))
    if mask_array is not None:
        estimator.SetValidMask(view(mask_array))
    if flicker_sd is not None:
        estimator.SetFlickerSd(_options.number("flicker_sd", flicker_sd))
    with itk_errors():
        update(estimator)
    return {
        "variance_x": estimator.GetVarianceX(),
        "variance_y": estimator.GetVarianceY(),
        "covariance": estimator.GetCovariance(),
        "flicker_variance": estimator.GetFlickerVariance(),
        "is_determined": estimator.GetIsDetermined(),
    }

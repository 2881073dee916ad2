# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Filters of the published method in ITK's functional style, with arrays, images or filters as inputs."""

from typing import Any

import numpy as np

from ._arrays import FILL_MASKED, as_frame, as_mask, view
from ._errors import itk_errors
from ._estimators import require_one_shape, set_parameters
from ._frames import frame_image, open_frames
from ._like import picture_like, stack_like
from ._progress import at_work
from ._types import Frame, Frames
from ._update import update


def vibration_mask_image_filter(
    mean: Frame, *, variance: Frame, valid_mask: Frame | None = None, **parameters: Any
) -> Any:
    """Finds the pixels whose gradient is explained by noise alone, so that vibrations do not change their variance.

    itk.VibrationMaskImageFilter in functional style.

    Parameters
    ----------
    mean : array_like (y, x), itk.Image or filter
        Mean of the stack [DN].
    variance : array_like (y, x), itk.Image or filter
        Variance of the stack [DN^2].
    valid_mask : array_like (y, x), itk.Image or filter, optional
        Pixels of value 0 are left out. Default: all finite pixels count.
    **parameters
        The parameters of itk.VibrationMaskImageFilter in snake case: `number_of_frames`, `level`.

    Returns
    -------
    array of uint8 (y, x), itk.Image or xarray.DataArray, as `mean`
        1 for an even, valid pixel, else 0.

    Raises
    ------
    TypeError
        A wrong type, or an unknown parameter.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    temporal_statistics_image_filter : Mean and variance of a stack.
    flicker_correction_image_filter : The next step of the published method.

    Examples
    --------
    >>> mask = itk.vibration_mask_image_filter(mean, variance=variance, valid_mask=valid, number_of_frames=100)
    """
    import itk

    mean_array, variance_array = as_frame(mean, "mean", np.float64), as_frame(variance, "variance", np.float64)
    mask_array = None if valid_mask is None else as_mask(valid_mask, "valid_mask")
    require_one_shape(mean=mean_array, variance=variance_array, valid_mask=mask_array)
    found = itk.VibrationMaskImageFilter[itk.Image[itk.D, 2]].New()
    found.SetInput(view(mean_array))
    found.SetVariance(view(variance_array))
    if mask_array is not None:
        found.SetValidMask(view(mask_array))
    set_parameters(found, parameters, "vibration_mask_image_filter")
    with itk_errors():
        update(found)
    return picture_like(mean, found.GetOutput(), "mask")


def flicker_correction_image_filter(
    stack: Frames, *, mean: Frame, variance: Frame, mask: Frame, **parameters: Any
) -> Any:
    """Takes the flicker out of a stack: itk.FlickerCorrectionImageFilter in functional style.

    Parameters
    ----------
    stack : frames
        As `frames` of estimate_sensor_noise(), or a filter of ITK whose output is a stack.
    mean : array_like (y, x), itk.Image or filter
        Mean of the stack [DN].
    variance : array_like (y, x), itk.Image or filter
        Variance of the stack [DN^2].
    mask : array_like (y, x), itk.Image or filter
        Pixels of value 0 are left out: the result of vibration_mask_image_filter().
    **parameters
        The parameters of itk.FlickerCorrectionImageFilter in snake case, for example `rolling_shutter="off"`.

    Returns
    -------
    array of float64 (t, y, x), itk.Image or xarray.DataArray, as `stack`
        The levels without flicker, minus the mean of the stack [DN].

    Raises
    ------
    TypeError
        A wrong type, or an unknown parameter.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    vibration_mask_image_filter : The mask.
    noise_regression_estimator : The next step of the published method.

    Examples
    --------
    >>> corrected = itk.flicker_correction_image_filter(stack, mean=mean, variance=variance, mask=mask)
    """
    import itk

    opened = open_frames(stack, name="stack", if_masked=FILL_MASKED)
    arrays = {"mean": as_frame(mean, "mean", np.float64), "variance": as_frame(variance, "variance", np.float64)}
    arrays["mask"] = as_mask(mask, "mask")
    require_one_shape(**arrays, frame=np.broadcast_to(np.uint8(0), opened.size[1::-1]))
    corrected = opened.estimator(itk.FlickerCorrectionImageFilter)
    corrected.SetMean(frame_image(arrays["mean"], opened.image))
    corrected.SetVariance(frame_image(arrays["variance"], opened.image))
    corrected.SetMask(frame_image(arrays["mask"], opened.image))
    set_parameters(corrected, parameters, "flicker_correction_image_filter")
    with at_work(corrected, False, opened), itk_errors():
        update(corrected)
    return stack_like(stack, corrected.GetOutput(), "corrected")

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Images without their noise, by the noise model of their camera."""

import warnings
from collections.abc import Callable, Mapping
from typing import Any, Literal

import numpy as np

from . import _options
from ._arrays import as_array, require_pixel_type
from ._errors import itk_errors
from ._like import is_image, is_labelled, output_of, updated
from ._stabilise import (
    generalized_anscombe_image_filter,
    inverse_generalized_anscombe_image_filter,
    noise_model,
    open_report,
)
from ._update import update

# Filter strength of OpenCV's non-local means with NORM_L1, and standard deviations of ITK's bilateral filter over
# places [pixels] and values, for noise of variance 1, as in denoise-with-noise-model: see OpenCVDenoisers.cxx and
# BilateralDenoiser.cxx in examples/tools.
_NON_LOCAL_MEANS_H = 1.3
_BILATERAL_SIGMAS = 1.5, 2.0
_GREY_VALUES_PER_SIGMA = 256.0

# Limits of what can be a frame of the report's camera, as in examples/tools/ImageScale.cxx, which says why.
_IMPOSSIBLE_SIGNAL = 8.0
_DOUBTFUL_SIGNAL = 2.0
_LEAST_GREY_VALUES = 16

Denoiser = Callable[[np.ndarray], Any]


def denoise_with_noise_model(
    image: Any,
    report: Any = None,
    denoiser: Literal["nlm", "itk"] | Denoiser = "nlm",
    *,
    variance_slope: float | None = None,
    total_intercept: float | None = None,
    strength: float = 1.0,
    dtype: Any = None,
) -> Any:
    """Removes the noise of images: generalized Anscombe transform, denoiser, exact unbiased inverse.

    Parameters
    ----------
    image : array_like, itk.Image or filter
        Levels [DN]: an array (y, x), or (t, y, x) frame by frame, or an itk.Image of 2 or 3 dimensions; uint8, uint16,
        int16, float32 or float64. Finite.
    report : Report, mapping, str or os.PathLike, optional
        The noise model: a report of estimate_sensor_noise(), a mapping like it, or the name of its JSON file. Only its
        variance_slope and total_intercept are needed: a report without offset serves.
    denoiser : {"nlm", "itk"} or callable, default "nlm"
        Denoiser for white Gaussian noise of variance 1: a function that takes an array (y, x) of float32 and returns
        one of the same shape; "nlm", OpenCV's non-local means, which needs cv2 (pip install
        itk-sensornoise[denoise]); or "itk", ITK's bilateral filter, which needs itk-filtering (pip install
        itk-sensornoise[itk]).
    variance_slope, total_intercept : float, optional
        The model by its numbers [DN/e-], above 0, and [DN^2], in place of a report. The scale of the levels
        cannot be tested then.
    strength : float, default 1
        Strength of "nlm" and "itk" relative to the best strength for the noise [1]; above 0, at most 10.
    dtype : dtype, optional
        The type of the result; integers are rounded and kept in range. Default: the type of `image`.

    Returns
    -------
    An array of the same shape, or an image, as `image`.

    Raises
    ------
    TypeError
        A wrong type.
    ValueError
        A wrong value; a report without the two numbers, or with a slope that is not above 0; a pixel that is not
        finite; levels on another scale than the report's (grey values times 16, for one).
    ImportError
        "nlm" without OpenCV.

    Warns
    -----
    UserWarning
        The image is far brighter than what was measured, or many of its pixels are below the zero level of the model.

    See Also
    --------
    check_noise_model : Whether the model serves for frames.
    generalized_anscombe_image_filter : The transform alone.

    Examples
    --------
    >>> clean = itk.denoise_with_noise_model(image, report)
    >>> clean = itk.denoise_with_noise_model(image, "report.json", denoiser=my_function)
    """
    slope, intercept = noise_model(report, variance_slope, total_intercept)
    remove = _denoiser(denoiser, strength)
    levels = _levels(image)
    _require_scale(levels, slope, intercept, {} if report is None else open_report(report))

    model: dict[str, Any] = {"variance_slope": slope, "total_intercept": intercept}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        stabilised = generalized_anscombe_image_filter(levels, **model, dtype="float32")
    for warning in caught:
        warnings.warn(warning.message, warning.category, stacklevel=2)
    frames = stabilised if levels.ndim == 3 else stabilised[np.newaxis]
    for index, frame in enumerate(frames):
        frames[index] = _checked(remove(frame), frame.shape)
    result = inverse_generalized_anscombe_image_filter(
        stabilised, **model, dtype=dtype or levels.dtype.newbyteorder("=")
    )
    return _like(result, image)


def _levels(image: Any) -> np.ndarray:
    """Returns the levels as an array of 2 or 3 dimensions, without a copy."""
    import itk

    image = updated(image)
    if is_image(image):
        image = itk.array_view_from_image(image)
    levels = as_array(image, "image")
    require_pixel_type(levels, "image")
    if levels.ndim not in (2, 3) or levels.size == 0:
        raise ValueError(f"image has shape {levels.shape}; expected pixels along the axes (y, x) or (t, y, x)")
    if not np.isfinite(levels).all():
        bad = levels.size - np.count_nonzero(np.isfinite(levels))
        raise ValueError(f"image has {bad} pixels that are NaN or infinite; expected finite levels")
    return levels


def _like(result: np.ndarray, image: Any) -> Any:
    """Returns a result in the form of the input: an image at the same place, or an array."""
    import itk

    image = output_of(image)
    if not is_image(image):
        return image.copy(data=result) if is_labelled(image) else result
    made = itk.image_from_array(result)
    made.CopyInformation(image)
    return made


def _require_scale(levels: np.ndarray, slope: float, intercept: float, record: Mapping[str, Any]) -> None:
    """Raises ValueError for levels that the camera of the report cannot have at the same setting."""
    zero = -intercept / slope
    lowest = zero - 0.375 * slope
    median = float(np.median(levels))
    step = record.get("quantisation_step") or 0
    high = record.get("clip_high")
    means = [mean for mean in (record.get("scatter") or {}).get("mean") or [] if mean is not None]
    signal = (median - zero) / (max(means) - zero) if means and max(means) > zero else 0.0
    spacing = _grey_value_spacing(levels) if levels.dtype.kind in "iu" and step >= 1 else 0
    found = None
    # Every second grey value of a frame of few levels may lack by chance; a spacing below the report's is never chance.
    if spacing >= 4 * step > 0 or 0 < 2 * spacing <= step:
        found = f"its digital numbers are multiples of {spacing}, the report's of {step:g}"
    elif median < lowest:
        found = f"half of its pixels are at or below {median:g} DN, the level of zero signal is {zero:.5g} DN"
    elif high is not None and median > high:
        found = f"half of its pixels are at or above {median:g} DN, the sensor attains {high:g} DN"
    elif signal > _IMPOSSIBLE_SIGNAL:
        found = f"half of its pixels are at or above {median:g} DN, the brightest measured had {max(means):.5g} DN"
    if found:
        raise ValueError(
            f"image is on another scale than the report: {found}; expected levels of the same camera at the same "
            "setting, as they were"
        )
    if signal > _DOUBTFUL_SIGNAL:
        warnings.warn(
            f"image is far brighter than what was measured: half of its pixels are at or above {median:g} DN, the "
            f"brightest in the report had {max(means):.5g} DN",
            stacklevel=3,
        )


def _grey_value_spacing(levels: np.ndarray) -> int:
    """Returns the greatest common divisor of the distances between grey values [DN]; 0 if there are too few values."""
    grey_values = np.unique(levels).astype(np.int64)
    return int(np.gcd.reduce(np.diff(grey_values))) if grey_values.size >= _LEAST_GREY_VALUES else 0


def _denoiser(denoiser: Any, strength: Any) -> Denoiser:
    strength = _options.number("strength", strength, "a number above 0, at most 10", above=0.0)
    if strength > 10.0:
        raise _options.refuse("strength", strength, "a number above 0, at most 10")
    return denoiser if callable(denoiser) else named_denoiser(denoiser, strength)


def named_denoiser(denoiser: Any, strength: float) -> Denoiser:
    """Returns the denoiser "nlm" or "itk" for noise of variance 1. `strength` is as in denoise_with_noise_model()."""
    _options.one_of("denoiser", denoiser, ["nlm", "itk"])
    return _non_local_means(strength) if denoiser == "nlm" else _bilateral(strength)


def _checked(found: Any, shape: tuple[int, ...]) -> np.ndarray:
    """Returns the frame that a denoiser returned, or raises an error for another shape or type."""
    frame = as_array(found, "the result of the denoiser")
    if frame.shape != shape or frame.dtype.kind not in "fiu":
        raise ValueError(
            f"the denoiser returned an array of shape {frame.shape} and dtype {frame.dtype}; expected numbers of shape "
            f"{shape}"
        )
    if not np.isfinite(frame).all():
        raise ValueError("the denoiser returned NaN or infinity; expected finite values")
    return frame


def _non_local_means(strength: float) -> Denoiser:
    """Returns OpenCV's non-local means on 16 bits. OpenCV takes 8 or 16 bits only."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError(
            'denoiser "nlm" is OpenCV\'s, and cv2 is not installed; expected `pip install itk-sensornoise[denoise]`, '
            'or denoiser="itk"'
        ) from error

    def remove(frame: np.ndarray) -> np.ndarray:
        low, high = float(frame.min()), float(frame.max())
        scale = min(_GREY_VALUES_PER_SIGMA, 65535.0 / (high - low)) if high > low else _GREY_VALUES_PER_SIGMA
        grey_values = ((frame.astype(np.float64) - low) * scale + 0.5).astype(np.uint16)
        h = strength * _NON_LOCAL_MEANS_H * scale
        clean = cv2.fastNlMeansDenoising(
            grey_values, h=[h], templateWindowSize=3, searchWindowSize=21, normType=cv2.NORM_L1
        )
        return (low + clean / scale).astype(np.float32)

    return remove


def _bilateral(strength: float) -> Denoiser:
    import itk

    if not hasattr(itk, "BilateralImageFilter"):
        raise ImportError(
            'denoiser "itk" is a filter of itk-filtering, which is not installed; expected '
            '`pip install itk-sensornoise[itk]`, or denoiser="nlm"'
        )

    def remove(frame: np.ndarray) -> np.ndarray:
        domain, value = _BILATERAL_SIGMAS
        kept = np.ascontiguousarray(frame)
        bilateral = itk.BilateralImageFilter.New(
            itk.image_view_from_array(kept), DomainSigma=domain, RangeSigma=value * strength
        )
        with itk_errors():
            update(bilateral)
        clean: np.ndarray = itk.array_from_image(bilateral.GetOutput())
        return clean

    return remove

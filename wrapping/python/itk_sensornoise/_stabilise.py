# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""In front of a denoiser, and behind it: the generalized Anscombe transform and its inverses."""

import json
import os
import warnings
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np

from . import _options
from ._arrays import PIXEL_NAMES, PIXEL_TYPES, as_array, as_itk_order, image_words, require_pixel_type, view
from ._errors import InvalidTypeError, itk_errors
from ._like import is_image, is_labelled, output_of
from ._names import is_name
from ._update import update

_SCHEMA = "itk-sensornoise-report/1"
_REPORT = "a report of estimate_sensor_noise(), a mapping like it, or the name of its JSON file"


def generalized_anscombe_image_filter(
    image: Any,
    report: Any = None,
    *,
    variance_slope: float | None = None,
    total_intercept: float | None = None,
    dtype: Any = None,
) -> Any:
    """Transforms noise whose variance grows with the signal to noise of variance 1, for denoisers of Gaussian noise.

        f(x) = (2/a) sqrt(max(0, a x + 3/8 a^2 + b)),   a the variance slope, b the total intercept

    Parameters
    ----------
    image : array_like, itk.Image or filter
        Levels [DN]: an array of any dimension, or an itk.Image of 2 or 3 dimensions. uint8, uint16, int16, float32 or
        float64. NaN stays NaN.
    report : Report, mapping, str or os.PathLike, optional
        The noise model: a report of estimate_sensor_noise(), a mapping like it, or the name of its JSON file. Only its
        variance_slope and total_intercept are asked for: it may lack offset, gain and read noise.
    variance_slope, total_intercept : float, optional
        The model by its numbers [DN/e-], above 0, and [DN^2], in place of a report.
    dtype : dtype, optional
        "float32" or "float64". Default: float64 of float64, else float32.

    Returns
    -------
    An array of the same shape, or an image, as `image`. The variance of its noise is 1 within 0.02 above 10 e-; in the
    dark it lies between 0 (no read noise) and 1.2 (2 e-).

    Raises
    ------
    TypeError
        A wrong type.
    ValueError
        A wrong value, and a report without the two numbers, or with a slope that is not above 0.

    Warns
    -----
    UserWarning
        Some pixels lie so far below the model's zero level that the root's argument is negative: they become 0.

    See Also
    --------
    inverse_generalized_anscombe_image_filter : Leads back to levels.
    denoise_with_noise_model : Both with a denoiser between them.

    Examples
    --------
    >>> stabilised = itk.generalized_anscombe_image_filter(image, report)
    """
    import itk

    slope, intercept = noise_model(report, variance_slope, total_intercept)
    picture = _Picture(image, "image")
    pixel = _dtype(dtype, "float64" if picture.pixel == "float64" else "float32", ("float32", "float64"))
    stabiliser = picture.filter(itk.GeneralizedAnscombeImageFilter, pixel)
    stabiliser.SetVarianceSlope(slope)
    stabiliser.SetTotalIntercept(intercept)
    with itk_errors():
        update(stabiliser)
    negative = stabiliser.GetNumberOfNegativeArguments()
    if negative > 0:
        level = -intercept / slope - 0.375 * slope
        warnings.warn(
            f"{negative} of {picture.count} pixels are below {level:.5g} DN, where the noise model has no variance, "
            "and became 0; a few are the noise of dark pixels, many say that the report is of another camera or "
            "setting",
            stacklevel=2,
        )
    return picture.like(stabiliser.GetOutput())


def inverse_generalized_anscombe_image_filter(
    image: Any,
    report: Any = None,
    *,
    variance_slope: float | None = None,
    total_intercept: float | None = None,
    inverse: Literal["exact-unbiased", "algebraic", "asymptotic"] = "exact-unbiased",
    dtype: Any = None,
) -> Any:
    """Leads from stabilised values, denoised or averaged, back to levels [DN].

    Parameters
    ----------
    image : array_like, itk.Image or filter
        Stabilised values: an array of any dimension, or an itk.Image of 2 or 3 dimensions; float32 or float64. Negative
        ones count as 0. NaN stays NaN, and is an error where integers are wanted.
    report, variance_slope, total_intercept : optional
        As in generalized_anscombe_image_filter().
    inverse : {"exact-unbiased", "algebraic", "asymptotic"}, default "exact-unbiased"
        "exact-unbiased": for what was denoised or averaged, the closed form of Mäkitalo & Foi 2013; off by at most 0.05
        e- in the dark, 0.02 e- from 3 e- on. "algebraic": f^-1, for single values; a mean comes out 1/4 e- too low.
        "asymptotic": off by up to 1/4 e- in the dark of a sensor without read noise, below 0.01 e- from 10 e- on.
    dtype : dtype, optional
        The type of the levels: uint8, uint16, int16 (rounded to the nearest, half up, and kept in range), float32 or
        float64. Default: the type of `image`.

    Returns
    -------
    An array of the same shape, or an image, as `image`.

    Raises
    ------
    TypeError
        A wrong type.
    ValueError
        A wrong value, and a report without the two numbers, or with a slope that is not above 0.

    See Also
    --------
    generalized_anscombe_image_filter : The transform.

    Examples
    --------
    >>> clean = itk.inverse_generalized_anscombe_image_filter(denoised, report, dtype="uint16")
    """
    import itk

    slope, intercept = noise_model(report, variance_slope, total_intercept)
    picture = _Picture(image, "image")
    if not picture.pixel.startswith("float"):
        raise InvalidTypeError(f"image has dtype {picture.pixel}; expected stabilised values, float32 or float64")
    _options.one_of("inverse", inverse, ["exact-unbiased", "algebraic", "asymptotic"])
    inverter = picture.filter(
        itk.InverseGeneralizedAnscombeImageFilter, _dtype(dtype, picture.pixel, tuple(PIXEL_TYPES))
    )
    inverter.SetVarianceSlope(slope)
    inverter.SetTotalIntercept(intercept)
    inverter.SetInverse(inverse)
    with itk_errors():
        update(inverter)
    return picture.like(inverter.GetOutput())


def noise_model(report: Any, variance_slope: Any = None, total_intercept: Any = None) -> tuple[float, float]:
    """Returns variance slope [DN/e-] and total intercept [DN^2], from the arguments or from a report."""
    if report is None:
        if variance_slope is None or total_intercept is None:
            raise ValueError(f"there is no noise model; expected {_REPORT}, or variance_slope= and total_intercept=")
    elif variance_slope is not None or total_intercept is not None:
        raise ValueError("a report and numbers of the noise model were given; expected one of them")
    else:
        record = open_report(report)
        variance_slope, total_intercept = (_value(record, name) for name in ("variance_slope", "total_intercept"))
    slope = _options.number("variance_slope", variance_slope, "a finite number above 0 [DN/e-]", above=0.0)
    return slope, _options.number("total_intercept", total_intercept, "a finite number [DN^2]")


def open_report(report: Any) -> Mapping[str, Any]:
    """Returns the record of a report, a mapping, or the JSON file of this name."""
    name = "the report"
    if is_name(report):
        name = os.fspath(report)
        try:
            with open(report, encoding="utf-8") as file:
                report = json.load(file)
        except OSError as error:
            raise ValueError(f"{name} cannot be read ({error.strerror}); expected {_REPORT}") from error
        except ValueError as error:
            raise ValueError(f"{name} is no JSON ({error}); expected {_REPORT}") from error
    if not isinstance(report, Mapping):
        raise InvalidTypeError(f"{name} is of type {type(report).__name__}; expected {_REPORT}")
    if report.get("schema") != _SCHEMA:
        raise ValueError(f'{name} has the schema {report.get("schema")!r}; expected "{_SCHEMA}"')
    if "channels" in report:
        raise ValueError(
            f"{name} has several channels; expected the report of one, as ChannelReports.channel() gives it"
        )
    return report


def _value(record: Mapping[str, Any], name: str) -> float:
    quantity = record.get(name)
    if not isinstance(quantity, Mapping) or quantity.get("value") is None:
        status = quantity.get("status", "missing") if isinstance(quantity, Mapping) else "missing"
        raise ValueError(
            f"the report's {name} has no value (it is {str(status).replace('-', ' ')}); expected a report that has "
            "variance_slope and total_intercept"
        )
    return float(quantity["value"])


def _dtype(dtype: Any, default: str, choices: tuple[str, ...]) -> str:
    if dtype is None:
        return default
    try:
        name: str = np.dtype(dtype).name
    except TypeError:
        name = ""
    if name not in choices:
        expected = PIXEL_NAMES if len(choices) > 2 else " or ".join(choices)
        raise _options.refuse("dtype", dtype, expected)
    return name


class _Picture:
    """Values to be transformed pixel by pixel: an itk.Image, or an array, which ITK gets with two dimensions."""

    def __init__(self, values: Any, name: str) -> None:
        import itk

        self._shape: tuple[int, ...] | None = None
        self._given, values = values, output_of(values)
        if is_image(values):
            self.image = values
            for self.pixel, (component, _) in PIXEL_TYPES.items():
                for self._dimension in (2, 3):
                    if isinstance(values, itk.Image[getattr(itk, component), self._dimension]):
                        with itk_errors():
                            values.UpdateOutputInformation()
                        self.count = int(values.GetLargestPossibleRegion().GetNumberOfPixels())
                        return
            raise InvalidTypeError(f"{name} is {image_words(values)}; expected 2 or 3 dimensions of {PIXEL_NAMES}")
        array = as_array(values, name)
        self.pixel = require_pixel_type(array, name)
        if array.ndim == 0 or array.size == 0:
            raise ValueError(
                f"{name} has shape {array.shape}, which holds no pixel; expected at least 1 along each axis"
            )
        self._shape = array.shape
        self._dimension = 2
        self._kept = as_itk_order(array).reshape(-1, array.shape[-1])
        self.count = array.size
        self.image = view(self._kept)

    def filter(self, template: Any, pixel: str) -> Any:
        """Returns a new filter from this picture to pixels of a type."""
        import itk

        output = itk.Image[getattr(itk, PIXEL_TYPES[pixel][0]), self._dimension]
        instance = template[type(self.image), output].New()
        instance.SetInput(self.image)
        return instance

    def like(self, output: Any) -> Any:
        """Returns the output of a filter in the form of its input: an image, or an array of the same shape."""
        import itk

        if self._shape is None:
            return output
        array = itk.array_from_image(output).reshape(self._shape)
        return self._given.copy(data=array) if is_labelled(self._given) else array

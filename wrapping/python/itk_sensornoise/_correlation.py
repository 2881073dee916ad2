# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Spatial and temporal correlation of the noise, which shows whether frames are raw."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _options
from ._arrays import as_frame
from ._errors import InvalidTypeError, itk_errors
from ._estimators import mask_of_frames
from ._frames import Stack, frame_image, open_frames
from ._html import figure, table
from ._nan_frames import warn_of_nan_frames
from ._progress import at_work
from ._record import Record
from ._rounding import measured, with_signs
from ._types import Frame, Frames
from ._update import update


class NoiseCorrelation(Record):
    """The result of noise_correlation_estimator(): the record "itk-sensornoise-correlation/1", with the names of its
    JSON members.

        found["noise_correlation"]    kind, space, time, covariance_lines, interference, row_noise, column_noise,
                                      excess_kurtosis: as in the report of estimate_sensor_noise()
        found["sum_over_lags"]        value, standard_error, interval95, status [1]
        found["lights"]               quarters of the pixels, dark to bright: light [DN], variance [DN^2] and its
                                      variance_standard_error, sum_over_lags
        found["frames_used"], found["pixels_used"]

    `kind`, `sum_over_lags` and `standard_error` are the most wanted of it. print() shows it as a table. It is a dict
    that cannot be changed, as the report of estimate_sensor_noise(): json.dumps() writes it, it equals any dict with
    the same content, and it can be pickled.
    """

    @property
    def kind(self) -> str:
        """One of "white", "crosstalk", "filtered", "temporal", "enlarged", "brighter-fatter", "not-linear" or
        "not-measured"."""
        kind: str = self["noise_correlation"]["kind"]
        return kind

    @property
    def sum_over_lags(self) -> float | None:
        """Factor from the variance of a pixel to the total covariance over lags [1]; None: not known."""
        value: float | None = self["sum_over_lags"]["value"]
        return value

    @property
    def standard_error(self) -> float | None:
        """Standard error of `sum_over_lags` [1]."""
        error: float | None = self["sum_over_lags"]["standard_error"]
        return error

    def coefficient(self, x: int = 0, y: int = 0, *, frames: int = 0) -> tuple[float, float]:
        """Correlation coefficient and its standard error [1] of pixels `x` columns and `y` rows apart, or of one pixel
        `frames` frames later. Raises KeyError if that lag was not measured."""
        if frames:
            found = [lag for lag in self["noise_correlation"]["time"] if lag["lag"] == abs(frames) and x == y == 0]
        else:
            found = [lag for lag in self["noise_correlation"]["space"] if lag["lag"] in ([x, y], [-x, -y])]
        if not found:
            raise KeyError(f"the lag of {x} columns, {y} rows and {frames} frames was not measured")
        return found[0]["value"], found[0]["standard_error"]

    def __repr__(self) -> str:
        return f"<NoiseCorrelation: {self.kind}, sum over lags {_number(self['sum_over_lags'])}>"

    def __str__(self) -> str:
        return "\n".join(f"{name:22} {value}" for name, value in self._rows())

    def _repr_html_(self) -> str:
        """Returns the table, and the correlation of pixels and of frames by lag."""
        from ._svg import Plot, Points

        lags = self["noise_correlation"]["space"] + self["noise_correlation"]["time"]
        numbers = list(range(1, len(lags) + 1))
        values, errors = ([lag[name] for lag in lags] for name in ("value", "standard_error"))
        plot = Plot(
            "lag, in the order of the table", "correlation", [Points(numbers, values, errors=errors)], level=0.0
        )
        drawn = plot.element("correlation of the noise by lag") if lags else ""
        return table(("quantity", "value"), self._rows()) + figure(drawn)

    def _rows(self) -> list[tuple[str, str]]:
        correlation = self["noise_correlation"]
        rows = [("kind", self.kind), ("sum over lags", _number(self["sum_over_lags"]))]
        rows += [(f"{signal_bin['light']:.4g} DN of signal", _bin_text(signal_bin)) for signal_bin in self["lights"]]
        rows += [(f"{lag['lag'][0]} columns, {lag['lag'][1]} rows", _lag(lag)) for lag in correlation["space"]]
        rows += [(f"{lag['lag']} frames", _lag(lag)) for lag in correlation["time"]]
        rows += [(f"{line} noise", _number(correlation[f"{line}_noise"])) for line in ("row", "column")]
        return rows


def _number(quantity: Mapping[str, Any]) -> str:
    if quantity["value"] is None:
        limit = quantity["interval95"]
        return quantity["status"] if limit is None else f"below {limit[1]:.3g} {quantity['unit']}"
    unit = "" if quantity["unit"] == "1" else f" {with_signs(quantity['unit'])}"
    return f"{measured(quantity['value'], quantity['standard_error'])}{unit}"


def _lag(lag: Mapping[str, Any]) -> str:
    rounded = str(measured(lag["value"], lag["standard_error"]))
    return rounded if rounded.startswith("-") else f"+{rounded}"


def _bin_text(signal_bin: Mapping[str, Any]) -> str:
    variance = f"{measured(signal_bin['variance'], signal_bin['variance_standard_error'])} DN²"
    return f"variance {variance}, sum over lags {_number(signal_bin['sum_over_lags'])}"


def noise_correlation_estimator(
    stack: Frames,
    *,
    mean: Frame | None = None,
    mask: Frame | None = None,
    series: ArrayLike | None = None,
    remove_frame_means: bool = True,
    offset: float | None = None,
    quantisation_step: float | None = None,
) -> NoiseCorrelation:
    """Measures the spatial and temporal correlation of the noise, and its total covariance over lags.

    Raw frames have white noise. A camera that smooths, resamples or mixes its frames lowers their variance: the gain of
    a photon transfer (variance against mean) is then too small. `sum_over_lags` of the result is the factor that
    corrects this gain, for any linear processing whose weights sum to 1.

    Parameters
    ----------
    stack : frames
        Frames of a static scene, flat fields for instance, as `frames` of estimate_sensor_noise().
    mean : array_like (y, x) or itk.Image, optional
        The stack's mean [DN], an array (y, x) or an image; NaN: the pixel is left out. Default: found.
    mask : array_like (y, x) or itk.Image, optional
        Pixels of value 0 are left out, an array (y, x) or an image. Default: all that are finite and never clipped.
        With `mean` and `mask` the stack is read once, else twice.
    series : array_like (frames,) or (frames, k), optional
        Temporal components (flicker, motion), in any unit: an array (frames,) or (frames, k). The part of every pixel
        in proportion to them is subtracted, with a factor for each pixel. Default: none.
    remove_frame_means : bool, default True
        Takes out the means of the frames, too, plain and weighted with the signal: flicker and a drifting offset.
        Without it, a fluctuating illumination counts as noise correlation.
    offset : float, optional
        Dark offset [DN]. Default: the darkest level if that is below 0.3 of the brightest, else 0.
    quantisation_step : float, optional
        Quantization step [DN]. Default: found in the frames; with `mean` and `mask`, 1 for integers.

    Returns
    -------
    NoiseCorrelation
        A mapping with `kind`, `sum_over_lags`, `standard_error` and coefficient(). Kind "not-measured": fewer than 1024
        pixels in 4 tiles, or few frames.

    Raises
    ------
    TypeError
        A wrong type.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    estimate_sensor_noise : Measures it, too, and allows for it.

    Examples
    --------
    >>> found = itk.noise_correlation_estimator(flats)
    >>> found.kind, found.coefficient(1, 0), found.sum_over_lags
    """
    import itk

    opened = open_frames(stack)
    estimator = opened.estimator(itk.NoiseCorrelationEstimator)
    if mean is not None:
        mean_array = _of_frame(as_frame(mean, "mean", np.float64), "mean", opened)
        estimator.SetMean(frame_image(mean_array, opened.image))
    if mask is not None:
        mask_array = mask_of_frames(mask, opened)
        estimator.SetMask(frame_image(mask_array, opened.image))
    for column in _columns(series, opened.size[2]):
        estimator.AddSeries(column)
    estimator.SetRemoveFrameMeans(_options.true_or_false("remove_frame_means", remove_frame_means))
    if offset is not None:
        estimator.SetOffset(_options.number("offset", offset))
    if quantisation_step is not None:
        expected = "a number above 0 [DN]"
        estimator.SetQuantisationStep(_options.number("quantisation_step", quantisation_step, expected, above=0.0))
    with at_work(estimator, False, opened), itk_errors():
        update(estimator)
    found = NoiseCorrelation(estimator.GetResultAsJson())
    if found.kind == "not-measured":
        warn_of_nan_frames(opened, "stack")
    return found


def _of_frame(array: np.ndarray, name: str, stack: Stack) -> np.ndarray:
    if array.shape != stack.size[1::-1]:
        raise ValueError(f"{name} has shape {array.shape}; expected {stack.size[1::-1]}, the shape of a frame")
    return array


def _columns(series: ArrayLike | None, frames: int) -> Sequence[list[float]]:
    if series is None:
        return []
    expected = f"finite numbers, an array ({frames},) or ({frames}, k) for {frames} frames"
    try:
        array = np.asarray(series, dtype=np.float64)
    except (TypeError, ValueError):
        raise InvalidTypeError(f"series is of type {type(series).__name__}; expected {expected}") from None
    if array.ndim not in (1, 2) or len(array) != frames:
        raise ValueError(f"series has shape {array.shape}; expected {expected}")
    if not np.isfinite(array).all():
        raise ValueError(f"series holds a number that is not finite; expected {expected}")
    columns: list[list[float]] = array.reshape(frames, -1).T.tolist()
    return columns

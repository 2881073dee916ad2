# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Evaluates flat fields and dark frames at several exposures by EMVA Standard 1288."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np

from . import _options
from ._arrays import FILL_MASKED
from ._bayer import PATTERNS, cut_pattern, noted_pattern
from ._channels import CHANNELS
from ._emva1288_report import Emva1288Report
from ._errors import InvalidTypeError, itk_errors
from ._frames import Stack, crop, open_dumps, open_frames
from ._settings import region_of
from ._types import Frames, ItkObject, Roi

# The frames of each exposure; pairs where an exposure has two series.
Series: TypeAlias = Mapping[float, Frames] | Sequence[tuple[float, Frames]]

_EXPECTED = "a mapping of exposures to frames, or a sequence of pairs (exposure, frames)"


def evaluate_emva1288(
    flats: Series,
    darks: Series,
    *,
    photons: Mapping[float, float] | None = None,
    exposure_unit: Literal["", "s"] = "",
    bit_depth: int | None = None,
    step: float = 1.0,
    bayer: Literal["auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"] = "auto",
    roi: Roi | None = None,
    raw: str | None = None,
    threads: int | None = None,
) -> Emva1288Report | dict[str, Emva1288Report]:
    """Evaluates flat fields and dark frames at several exposures by EMVA Standard 1288, Release 4.0 Linear.

    It gives system gain, dark noise, saturation, signal-to-noise ratio, linearity, dark current and non-uniformity.
    documentation/method/emva1288.md has the equations, the accuracy, and the differences to the package emva1288.

    Parameters
    ----------
    flats : mapping of float to frames, or sequence of (float, frames)
        Flat fields of each exposure, at least 3 different exposures with two frames or more: {0.01: [a, b], ...}, where
        a and b are arrays (y, x) [DN], or names of files; or any frames that estimate_sensor_noise() takes, for example
        an array (t, y, x), or a pattern of names. The exposure is an exposure time, or any other number that is
        proportional to the exposure, 0 or more. An exposure may have a pair and a longer series, as two pairs
        (exposure, frames) of a sequence: the pair gives the photon transfer curve, and the longer series the PRNU. All
        frames have one size of at least 3 x 3 pixels, and one type: uint8, uint16, int16, float32 or float64.
    darks : mapping of float to frames, or sequence of (float, frames)
        Dark frames, in the same form: at least one exposure with two frames or more.
    photons : mapping of float to float, optional
        Mean number of photons that reach a pixel [photon], for each exposure of `flats`. Default: not known; then
        responsivity, quantum efficiency and the quantities in photons are not identifiable.
    exposure_unit : {"", "s"}, default ""
        Unit of the exposures. "": any, or not known.
    bit_depth : int, optional
        Bits of the digital numbers, 1 to 16, which decide whether the brightest flat fields are saturated: the range
        ends at 2^bits - 1 steps. Numbers beyond it are an error. Default: not known.
    step : float, default 1
        Quantization step [DN], above 0. The quantization noise, 1/12 of its square, is subtracted from the dark
        variance.
    bayer : {"auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"}, default "auto"
        Colour filters in front of the pixels. A pattern, the colours of the upper left pixels: each of the four planes
        is evaluated by itself. "none": a monochrome sensor. "auto": as the files say, else monochrome.
    roi : (int, int, int, int) or (slice, slice), optional
        (x, y, width, height) [pixel], or two slices as an array (y, x) takes them: only these pixels. Default: all.
    raw : str, optional
        How frames lie in files without a header, as in estimate_sensor_noise().
    threads : int, optional
        Number of threads. Default: all. The result is the same bits for any number.

    Returns
    -------
    Emva1288Report, or dict of str to Emva1288Report
        One report; for a mosaic a dict with the reports of the planes "R", "G1", "G2" and "B". Quantities that the
        frames do not determine are `not-identifiable`, and notes say what is missing.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; frames that cannot be read, or that differ in size or type; an exposure with fewer than two
        frames; too few exposures; flat fields that are darker than the dark frames, or without temporal noise.

    See Also
    --------
    estimate_sensor_noise : Measures gain and read noise from a burst of any static scene.

    Examples
    --------
    >>> report = itk_sensornoise.evaluate_emva1288(
    ...     flats={time: [a, b] for time, (a, b) in pairs.items()}, darks={0.0: dark}, bit_depth=12
    ... )
    >>> print(report)
    >>> report.gain.value, report.quantity("spatial.prnu").standard_error
    """
    _options.one_of("bayer", bayer, PATTERNS)
    if exposure_unit not in ("", "s"):
        raise _options.refuse("exposure_unit", exposure_unit, "'s', or '' for any other unit")
    count = 0 if threads is None else _options.integer("threads", threads, 1, 1024)
    recording = _Recording(_pairs("flats", flats), _pairs("darks", darks), photons, roi, raw)
    pattern = recording.pattern(bayer)

    def evaluated(plane: str | None) -> Emva1288Report:
        evaluator = recording.evaluator()
        evaluator.SetQuantisationStep(_options.number("step", step, "a number above 0 [DN]", above=0.0))
        evaluator.SetBitDepth(0 if bit_depth is None else _options.integer("bit_depth", bit_depth, 1, 16))
        evaluator.SetExposureUnit(exposure_unit)
        evaluator.SetNumberOfWorkUnits(count)
        recording.add_to(evaluator, pattern, plane)
        with itk_errors():
            evaluator.Evaluate()
        return Emva1288Report.of(evaluator)

    return evaluated(None) if pattern == "none" else {plane: evaluated(plane) for plane in CHANNELS}


@dataclass
class _OneSeries:
    """Frames of one exposure."""

    name: str  # name of the parameter, for errors
    exposure: float
    photons: float | None  # None: not known
    stack: Stack

    def add_to(self, evaluator: ItkObject, image: ItkObject) -> None:
        """Adds the frames of `image`, a stack or one of its planes."""
        try:
            with itk_errors(f"{self.name}: "):
                if self.name.startswith("darks"):
                    evaluator.AddDarkFrames(image, self.exposure)
                elif self.photons is None:
                    evaluator.AddFlatFrames(image, self.exposure)
                else:
                    evaluator.AddFlatFrames(image, self.exposure, self.photons)
        except ValueError:
            if not self.stack.failed:
                raise
        for error in self.stack.failed:  # while lazy frames were read
            raise error


@dataclass
class _Recording:
    """Series of a recording, opened."""

    flats: list[tuple[float, Frames]]
    darks: list[tuple[float, Frames]]
    photons: Mapping[float, float] | None
    roi: Roi | None
    raw: str | None
    corner: tuple[int, ...] = (0, 0, 0)
    series: list[_OneSeries] = field(default_factory=list)

    def __post_init__(self) -> None:
        for kind, pairs in (("flats", self.flats), ("darks", self.darks)):
            for exposure, frames in pairs:
                self._open(f"{kind} of the exposure {exposure:g}", exposure, frames)

    def _open(self, name: str, exposure: float, frames: Frames) -> None:
        if self.raw is None:
            stack = open_frames(frames, name=name, if_masked=FILL_MASKED)
        else:
            stack = open_dumps(frames, self.raw, name=name)
        self.corner, size = region_of(stack, self.roi, None)
        pattern = noted_pattern(stack.image)
        if size != stack.size:
            stack = crop(stack, self.corner, size)
        if self.series:
            first = self.series[0].stack
            if (stack.size[:2], stack.pixel) != (first.size[:2], first.pixel):
                found, expected = (f"{s.size[0]} x {s.size[1]} pixels of type {s.pixel}" for s in (stack, first))
                raise ValueError(f"{name} have {found}; expected {expected}, as {self.series[0].name}")
        else:
            self._pattern = pattern
        photons = None if self.photons is None or name.startswith("darks") else _photons(self.photons, exposure)
        self.series.append(_OneSeries(name, exposure, photons, stack))

    def pattern(self, bayer: str) -> str:
        """Returns the Bayer pattern of the evaluated part of the frames; "none" for a monochrome sensor."""
        whole = (self._pattern or "none") if bayer == "auto" else bayer
        return whole if whole == "none" else cut_pattern(whole, *self.corner[:2])

    def evaluator(self) -> ItkObject:
        """Returns a new evaluator of the type of the frames."""
        import itk

        return itk.Emva1288Evaluator[type(self.series[0].stack.image)].New()

    def add_to(self, evaluator: ItkObject, pattern: str, plane: str | None) -> None:
        """Adds all frames, or one `plane` of them."""
        import itk

        for each in self.series:
            image = each.stack.image
            if plane is not None:
                planes = itk.BayerPlaneImageFilter[type(image)].New()
                planes.SetInput(image)
                planes.SetPattern(pattern)
                planes.SetPlane(plane)
                image = planes.GetOutput()
            each.add_to(evaluator, image)


def _pairs(name: str, series: object) -> list[tuple[float, Frames]]:
    """Exposures and frames, in their order."""
    if isinstance(series, Mapping):
        items: list[Any] = list(series.items())
    elif isinstance(series, Sequence) and not isinstance(series, (str, bytes)):
        items = list(series)
    else:
        raise InvalidTypeError(f"{name} is of type {type(series).__name__}; expected {_EXPECTED}")
    if not items:
        raise ValueError(f"{name} is empty; expected {_EXPECTED}")
    for item in items:
        if isinstance(item, np.ndarray) or not isinstance(item, Sequence) or len(item) != 2:
            raise InvalidTypeError(f"{name} holds a {type(item).__name__}; expected {_EXPECTED}")
    return [(_not_below_0(f"an exposure of {name}", exposure), frames) for exposure, frames in items]


def _photons(photons: Mapping[float, float], exposure: float) -> float:
    if not isinstance(photons, Mapping):
        raise _options.refuse_type("photons", photons, "a mapping of the exposures of flats to numbers of photons")
    if exposure not in photons:
        raise ValueError(f"photons has no number for the exposure {exposure:g}; expected one for each of flats")
    return _not_below_0(f"photons[{exposure:g}]", photons[exposure])


def _not_below_0(name: str, value: Any) -> float:
    expected = "a finite number of 0 or more"
    number = _options.number(name, value, expected)
    if number < 0.0:
        raise _options.refuse(name, value, expected)
    return number

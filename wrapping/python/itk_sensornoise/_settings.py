# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The settings of estimate_sensor_noise(), put into an ITK estimator: of a stack that it reads, or of sums."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from . import _options
from ._arrays import as_mask
from ._bayer import set_pattern
from ._errors import InvalidTypeError, itk_errors
from ._frames import Stack, crop, frame_image, open_dumps, open_frames
from ._names import is_name
from ._source import read_image
from ._types import FileName, Frame, Frames, ItkObject, Roi


@dataclass(kw_only=True)
class Settings:
    """Settings, as the arguments of estimate_sensor_noise() describe them."""

    method: str = "refined"
    offset: float | tuple[float, float] | None = None
    bayer: str = "auto"
    bit_depth: int | None = None
    clip: tuple[float, float] | None = None
    step: float | None = None
    level_range: tuple[float, float] | None = None
    exposures: Sequence[float] | None = None
    excess_noise_factor: float = 1.0
    rolling_shutter: str | float = "auto"
    shutter_axis: str = "y"
    level: float = 0.01
    quantiles: tuple[float, float] = (0.01, 0.99)
    roi: Roi | None = None
    mask: Frame | FileName | None = None
    frame_range: tuple[int, int] | slice | None = None
    threads: int | None = None

    def check(self, dark: object, methods: Sequence[str] = ("refined", "published")) -> None:
        """Raises TypeError or ValueError for invalid settings, and for settings that the method cannot use. `methods`:
        the possible methods. The library checks the ranges before it reads a pixel."""
        _options.one_of("method", self.method, list(methods))
        if self.level_range is not None:
            _level_range(self.level_range)
        if self.exposures is not None:
            _exposures(self.exposures)
        _excess_noise_factor(self.excess_noise_factor)
        known = {"offset": self.offset, "dark": dark}
        if all(value is not None for value in known.values()):
            raise ValueError("offset and dark were given; expected one of them")
        given = {**known, "level_range": self.level_range, "exposures": self.exposures}
        require_used(self.method, [name for name, value in given.items() if value is not None])
        _ = self.span

    @property
    def span(self) -> tuple[int, int] | None:
        """The frames that are measured: the first and one past the last; None: all."""
        return None if self.frame_range is None else _frame_range(self.frame_range)


def require_settings(settings: dict[str, Any]) -> None:
    """Raises TypeError for a name that is no setting."""
    known = [each.name for each in fields(Settings)]
    for name in settings:
        if name not in known:
            raise InvalidTypeError(f"{name} is no setting; expected some of {', '.join(known)}")


@dataclass
class Prepared:
    """An estimator, its stack and dark frames after cutting, and the region that was cut: corner and size (x, y, t)."""

    estimator: ItkObject
    stack: Stack
    dark: Stack | None
    corner: tuple[int, ...]
    size: tuple[int, ...]
    kept: list[Any]


def open_dark(dark: Frames | None, raw: str | None) -> Stack | None:
    """Opens the dark frames; None without dark frames."""
    if dark is None:
        return None
    return open_frames(dark, name="dark") if raw is None else open_dumps(dark, raw, name="dark")


def prepare(stack: Stack, dark: Stack | None, settings: Settings) -> Prepared:
    """Returns an estimator with all settings. Raises ValueError for a setting that does not fit the stack."""
    import itk

    whole, span = stack.image, settings.span
    total = None if stack.is_cut else stack.size[2]
    corner, size = region_of(stack, settings.roi, None if stack.is_cut else span)
    mask = None if settings.mask is None else _mask_of(settings.mask, stack.size[:2])
    if dark is not None:
        dark = _cut_dark(dark, stack, corner, size)
    if size != stack.size:
        stack = crop(stack, corner, size)
    is_single = settings.method == "single-image"
    estimator = stack.estimator(itk.SingleImageNoiseEstimator if is_single else itk.SensorNoiseEstimator)
    if settings.roi is not None:
        estimator.SetSourceRegion(*corner[:2], *size[:2])
    if span is not None:
        estimator.SetSourceFrames(*span)
    set_pattern(estimator, settings.bayer, whole, corner)
    estimator.SetExcessNoiseFactor(_excess_noise_factor(settings.excess_noise_factor))
    _set_dn_settings(estimator, settings)
    if not is_single:
        _set_burst(estimator, settings, dark, (size[2], total))
    if mask is not None:
        rows, columns = slice(corner[1], corner[1] + size[1]), slice(corner[0], corner[0] + size[0])
        mask = np.ascontiguousarray(mask[rows, columns])
        estimator.SetMask(frame_image(mask, stack.image))
    if settings.threads is not None:
        count = _options.integer("threads", settings.threads, 1, 1024)
        estimator.GetMultiThreader().SetMaximumNumberOfThreads(count)
        estimator.SetNumberOfWorkUnits(count)
    return Prepared(estimator, stack, dark, corner, size, [mask])


def _set_burst(estimator: ItkObject, settings: Settings, dark: Stack | None, frames: tuple[int, int | None]) -> None:
    """Sets the parameters of the methods that measure a burst. `frames`: how many are measured, and how many there are;
    None: not known."""
    estimator.SetMethod(settings.method)
    if settings.offset is not None:
        _set_offset(estimator, settings.offset)
    if dark is not None:
        estimator.SetDark(dark.image)
    if settings.level_range is not None:
        low, high = _level_range(settings.level_range)
        estimator.SetLevelRangeLow(low)
        estimator.SetLevelRangeHigh(high)
    if settings.exposures is not None:
        with itk_errors():
            estimator.SetExposures(_exposures_of(settings, *frames))
    _set_flicker(estimator, settings)


def require_used(method: str, given: Sequence[str]) -> None:
    """Raises ValueError for the first name of a setting that the method cannot use."""
    if method == "refined" or not given:
        return
    import itk

    for name in given:
        reason = itk.SensorNoiseEstimator[itk.Image[itk.US, 3]].ReasonUnused(method, name)
        if reason:
            were = "were" if name.endswith("s") else "was"
            raise ValueError(
                f"{name} {were} given and the method is {method!r}, which {reason}; expected no {name}, or 'refined'"
            )


def _set_offset(estimator: ItkObject, offset: float | tuple[float, float]) -> None:
    expected = "a finite number or (number, standard error) [DN]"
    if np.ndim(offset) == 0:
        estimator.SetOffset(_options.number("offset", offset, expected))
        return
    value, error = _options.numbers("offset", offset, 2, expected)
    estimator.SetOffset(value)
    estimator.SetOffsetStandardError(error)


def _level_range(level_range: tuple[float, float]) -> tuple[float, float]:
    low, high = _options.numbers("level_range", level_range, 2, "(low, high), two levels with low < high [DN]")
    return low, high


def _excess_noise_factor(factor: float) -> float:
    return _options.number("excess_noise_factor", factor, "a number of 1 or more: 2 for an EMCCD")


def _exposures(exposures: Sequence[float]) -> list[float]:
    """Returns the exposures of all frames."""
    expected = "one finite number for each frame, 0 (a dark frame) or more, with at least 3 different values"
    try:
        count = len(exposures)
    except TypeError:
        raise _options.refuse_type("exposures", exposures, expected) from None
    return _options.numbers("exposures", exposures, count, expected)


def _exposures_of(settings: Settings, frames: int, total: int | None) -> list[float]:
    """Returns the exposures of the `frames` that are measured, cut by `frame_range`; `total`: all frames; None: not
    known."""
    numbers = _exposures(() if settings.exposures is None else settings.exposures)
    least = total or (settings.span[1] if settings.span is not None else frames)
    if len(numbers) < least or len(numbers) > (total or len(numbers)):
        also = "" if settings.span is None else ", also for the frames that frame_range leaves out"
        found = f"there are {len(numbers)} exposures, but {total or f'{least} or more'} frames"
        raise ValueError(f"{found}; expected one exposure for each frame{also}")
    return numbers if settings.span is None else numbers[slice(*settings.span)]


def _cut_dark(opened: Stack, stack: Stack, corner: tuple[int, ...], size: tuple[int, ...]) -> Stack:
    """Returns the dark frames, cut as the stack is."""
    if (opened.size[:2], opened.pixel) != (stack.size[:2], stack.pixel):
        found, expected = (f"{s.size[0]} x {s.size[1]} pixels of type {s.pixel}" for s in (opened, stack))
        raise ValueError(f"dark has {found}; expected {expected}, as the frames")
    corner, size = (*corner[:2], 0), (*size[:2], opened.size[2])
    return opened if size == opened.size else crop(opened, corner, size)


def _frame_range(frame_range: tuple[int, int] | slice) -> tuple[int, int]:
    expected = "(first, end) with 0 <= first < end"
    if isinstance(frame_range, slice):
        if frame_range.step not in (None, 1) or frame_range.stop is None:
            raise _options.refuse("frame_range", frame_range, f"{expected}, or slice(first, end)")
        frame_range = (frame_range.start or 0, frame_range.stop)
    first, end = _options.integers("frame_range", frame_range, 2, expected)
    if not 0 <= first < end:
        raise _options.refuse("frame_range", frame_range, expected)
    return first, end


def region_of(stack: Stack, roi: Roi | None, span: tuple[int, int] | None) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Returns corner and size (x, y, t) of the region that roi and frame_range select."""
    width, height, frames = stack.size
    expected = f"(x, y, width, height) inside {width} x {height} pixels"
    corner, size = [0, 0, 0], [width, height, frames]
    if roi is not None:
        x, y, roi_width, roi_height = _options.rectangle("roi", roi, width, height, expected)
        if min(x, y) < 0 or min(roi_width, roi_height) < 1 or x + roi_width > width or y + roi_height > height:
            raise _options.refuse("roi", roi, expected)
        corner[:2], size[:2] = (x, y), (roi_width, roi_height)
    if span is not None:
        if span[1] > frames:
            raise ValueError(f"frame_range ends at {span[1]}, but there are {frames} frames")
        corner[2], size[2] = span[0], span[1] - span[0]
    return tuple(corner), tuple(size)


def _mask_of(mask: Frame | FileName, size: tuple[int, int]) -> np.ndarray:
    """Returns the mask (y, x) of a stack whose frames have `size` (width, height)."""
    if is_name(mask):
        mask = read_image(mask, "the mask")
    array = as_mask(mask, "mask")
    if array.shape != size[::-1]:
        raise ValueError(f"mask has shape {array.shape}; expected {size[::-1]}, the shape of a frame")
    return array


def _set_dn_settings(estimator: ItkObject, settings: Settings) -> None:
    if settings.bit_depth is not None:
        estimator.SetBitDepth(_options.integer("bit_depth", settings.bit_depth, 1, 16))
    if settings.clip is not None:
        low, high = _options.numbers("clip", settings.clip, 2, "(low, high), two levels [DN]")
        estimator.SetClipLow(low)
        estimator.SetClipHigh(high)
    if settings.step is not None:
        estimator.SetQuantisationStep(_options.number("step", settings.step, "a number above 0 [DN]", above=0.0))


def _set_flicker(estimator: ItkObject, settings: Settings) -> None:
    shutter = settings.rolling_shutter
    if isinstance(shutter, str) and shutter in ("auto", "off"):
        estimator.SetRollingShutter(shutter)
    else:
        expected = "'auto', 'off' or a number of rows above 0"
        estimator.SetSigmaRows(_options.number("rolling_shutter", shutter, expected, above=0.0))
        estimator.SetRollingShutter("fixed")
    estimator.SetShutterAxis(1 if _options.one_of("shutter_axis", settings.shutter_axis, ["y", "x"]) == "y" else 0)
    estimator.SetLevel(_options.number("level", settings.level))
    dark, bright = _options.numbers("quantiles", settings.quantiles, 2, "(dark, bright), two numbers from 0 to 1")
    estimator.SetDarkQuantile(dark)
    estimator.SetBrightQuantile(bright)

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The one-call way from frames to a report."""

from typing import Literal

import numpy as np

from . import _options
from ._arrays import as_mask
from ._bayer import set_pattern
from ._channels import ChannelReports, report_of
from ._errors import itk_errors
from ._frames import Stack, crop, frame_image, open_dumps, open_frames
from ._hash import FramesHash
from ._maps import arrays_of, maps_folder, require_apart, write_maps
from ._names import expand, is_name
from ._progress import at_work
from ._report import Report
from ._source import read_image
from ._types import FileName, Frame, Frames, ItkObject


def estimate_sensor_noise(
    frames: Frames,
    *,
    method: Literal["refined", "published"] = "refined",
    offset: float | tuple[float, float] | None = None,
    dark: Frames | None = None,
    bayer: Literal["auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"] = "auto",
    bit_depth: int | None = None,
    clip: tuple[float, float] | None = None,
    step: float | None = None,
    level_range: tuple[float, float] | None = None,
    rolling_shutter: Literal["auto", "off"] | float = "auto",
    shutter_axis: Literal["y", "x"] = "y",
    level: float = 0.01,
    quantiles: tuple[float, float] = (0.01, 0.99),
    roi: tuple[int, int, int, int] | None = None,
    mask: Frame | FileName | None = None,
    frame_range: tuple[int, int] | None = None,
    maps: bool | FileName | None = None,
    hash: bool = False,
    raw: str | None = None,
    memory_limit: int | None = None,
    threads: int | None = None,
    progress: bool = False,
) -> Report | ChannelReports:
    """Measures gain, offset and read noise of a camera, flicker and vibration, from frames of a static scene.

    Parameters
    ----------
    frames
        Raw frames in time order, at least 5 of at least 3 x 3 pixels: a NumPy array (t, y, x); an itk.Image of 3
        dimensions (x, y, t); a list of file names or of 2-D arrays (y, x), or of what has `__array__`; the name of one
        stack file; a pattern of names ("frames/*.png"), a folder of files of one kind, a set or a generator of names,
        which are sorted with numbers as numbers (frame_2 before frame_10; a list keeps its order); or anything with
        `shape` (t, y, x), `dtype` and slices along time, frames[first:end]: h5py, zarr, dask, memory maps, astropy's
        sections, your own class; axes of xarray may be in any order, as their names are honoured. uint8, uint16, int16,
        float32 or float64 [DN]. Files and such objects are read a few frames at a time and never held together (a stack
        in NRRD or a compressed MetaImage, which ITK cannot read in parts, is). Stored chunks that are
        missing are an error, as far as h5py and zarr say so. Raw files of cameras (.dng, .cr2, .nef, ...) are read by
        rawpy, if installed: unprocessed codes. Arrays are shared; one that is not C-contiguous or not in the machine's
        byte order is copied once.
    method
        "refined": all pixels of a still scene, textured or not; what is `identified` has a standard error and a 95 %
        interval. "published": Figure 2 of Sur & Grédiac 2015, even areas only, without errors.
    offset
        The offset [DN] if it is known, or (offset, standard error): offset and read noise then need no flicker, and
        steady light is told from the offset. Default: found. "refined" only.
    dark
        Frames without light, as `frames`, of the same size and type and at the same exposure, gain and temperature:
        they give the offset and, from two frames on, the read noise. Not together with `offset`. "refined" only.
    bayer
        Colour filters in front of the pixels. "none": a monochrome sensor. "RGGB", "GRBG", "GBRG" or "BGGR", the
        colours of the upper left pixels: each of the four planes is measured by itself. "auto": as the file says, if
        it does, else as the levels of the first frame tell, which cannot tell red from blue.
    bit_depth
        Bits of the sensor's codes, 1 to 16. Default: found.
    clip
        Lowest and highest level that the sensor attains [DN]. Default: found.
    step
        Spacing of the codes [DN]. Default: found.
    level_range
        (low, high): levels between which the variance is fitted [DN], for sensors whose response is straight in a part
        of its range. The level of a pixel is the mean of its neighbours. Default: all. "refined" only.
    rolling_shutter
        Whether the flicker may differ from line to line: "auto" (found out), "off", or the width sigma_y of a line's
        neighbourhood [lines]. "refined" looks for any light that changes in some places in another way than in others,
        unless "off", and needs no width.
    shutter_axis
        Axis along which the shutter travels: "y" (lines are rows) or "x". "refined" does without.
    level
        Level of the test that finds pixels moved by vibrations, a probability. "refined" does without.
    quantiles
        Quantiles of the mean at which the dark and the bright set lie, 0 to 1. "refined" does without.
    roi
        (x, y, width, height) [pixel]: only these pixels, of the dark frames too.
    mask
        Only pixels where this is not 0: an array (y, x) of a frame's size, or the name of an image file.
    frame_range
        (first, end): only the frames first, first + 1, ... end - 1, counted from 0.
    maps
        What is known of every pixel: mean, variance, corrected_variance [DN, DN^2] and pixel_use (0: used; the other
        values are README.md's); with two dark frames or more also the camera calibration: pixel_offset and
        pixel_read_noise [DN], and the ends of their 95 % intervals, _low and _high. True: arrays by these names, the
        report's `maps`. A folder: an image (.mha) each, written there. Default: none.
    hash
        Whether record, table and page have the SHA-256 of the frames, and of the dark ones, as `input`, by which they
        are filed. Of names: as the tool's --hash, of the bytes of all files in their order, behind a header those of
        its pixels; a file that changes meanwhile is an error. Of all else: of the bytes of all pixels, least
        significant first, a frame after the other, row by row: of an array,
        hashlib.sha256(array.astype(array.dtype.newbyteorder("<")).tobytes()). `roi` and `mask` change nothing of it,
        and `frame_range` only that of a list, which has the frames in the range. All is read once more: lazy frames,
        too. "of" says which it is, "files" or "pixels".
    raw
        How frames lie in files without a header, those of `frames` and of `dark`: "WxH:TYPE[:SKIP[:ROW]]", for example
        "640x480:uint16le", or "1920x1080:Mono12p:64" behind 64 other bytes; the types are README.md's. Default: the
        files say so.
    memory_limit
        Most memory that the estimate takes beside the frames [bytes], for example 4 * 10**9: frames that are read a few at a
        time are read more often where it would need more, with the same result. "refined" needs 56 bytes a pixel of a
        frame and 8 more for each series of light and motion that it finds, "published" 40. Less than 64 bytes a pixel
        (40), 20 kB a frame and 32 MiB is refused. Default: no limit.
    threads
        Number of threads. Default: all. The result is the same bits for any number.
    progress
        Shows the progress: with tqdm if installed, else on standard error.

    Returns
    -------
    Report, or ChannelReports of a mosaic
        A dict, the same record as the JSON of `estimate-sensor-noise`; `settings` holds all of the options above that
        were given and change a number. Data that cannot be measured give quantities that are `failed` or
        `not-identifiable`, and a warning that says why.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C, within the time that a chunk of 32 MiB takes; the next call starts afresh.
    ValueError
        Wrong use; says what was found and what was expected.
    ImportError
        A raw file of a camera without rawpy. What a reader of lazy frames raises is raised as it is.
    RuntimeError
        What ITK threw, in one sentence.
    """
    import itk

    _options.one_of("method", method, ["refined", "published"])
    if not isinstance(hash, bool):
        raise _options.refuse("hash", hash, "True or False")
    _check_what_is_known(method, offset, dark)
    levels = None if level_range is None else _level_range(level_range, method)
    span = None if frame_range is None else _frame_range(frame_range)
    folder = None if maps is None or isinstance(maps, bool) else maps_folder(maps)
    frames, dark = expand(frames), expand(dark, "dark")
    if folder is not None:
        require_apart(folder, frames=frames, dark=dark, mask=mask)
    stack = open_frames(frames, span) if raw is None else open_dumps(frames, raw, span)
    dark_stack = None
    if dark is not None:
        dark_stack = open_frames(dark, name="dark") if raw is None else open_dumps(dark, raw, name="dark")
    opened, opened_dark, whole = stack, dark_stack, stack.image
    corner, size = _region(stack, roi, None if stack.is_cut else span)
    mask_array = None if mask is None else _mask_of(mask, stack.size[:2])
    if dark_stack is not None:
        dark_stack = _cut_dark(dark_stack, stack, corner, size)
    if size != stack.size:
        stack = crop(stack, corner, size)
    estimator = stack.estimator(itk.SensorNoiseEstimator)
    if roi is not None:
        estimator.SetSourceRegion(*corner[:2], *size[:2])
    if span is not None:
        estimator.SetSourceFrames(*span)
    estimator.SetMethod(method)
    set_pattern(estimator, bayer, whole, corner)
    if offset is not None:
        _set_offset(estimator, offset)
    if dark_stack is not None:
        estimator.SetDark(dark_stack.image)
    if levels is not None:
        estimator.SetLevelRangeLow(levels[0])
        estimator.SetLevelRangeHigh(levels[1])
    _set_parameters(estimator, bit_depth, clip, step, rolling_shutter, shutter_axis, level, quantiles)
    if mask_array is not None:
        rows, columns = slice(corner[1], corner[1] + size[1]), slice(corner[0], corner[0] + size[0])
        mask_array = np.ascontiguousarray(mask_array[rows, columns])
        estimator.SetMask(frame_image(mask_array, stack.image))
    if memory_limit is not None:
        estimator.SetMemoryLimit(_options.integer("memory_limit", memory_limit, 1, 2**62))
    if threads is not None:
        count = _options.integer("threads", threads, 1, 1024)
        estimator.GetMultiThreader().SetMaximumNumberOfThreads(count)
        estimator.SetNumberOfWorkUnits(count)
    hashes = []
    if hash:
        hashes = _set_hashes(estimator, opened, opened_dark)
    with at_work(estimator, progress, *filter(None, (stack, dark_stack))), itk_errors():
        estimator.Update()
    for each in hashes:
        each.require_unchanged()
    if folder is not None:
        write_maps(estimator, folder)
    return report_of(estimator, arrays_of(estimator) if maps is True else None)


def _set_hashes(estimator: ItkObject, frames: Stack, dark: Stack | None) -> list[FramesHash]:
    """Hashes what is going to be measured."""
    hashes = [FramesHash(frames)]
    hashes[0].set(estimator.SetFramesHash)
    if dark is not None:
        hashes.append(FramesHash(dark))
        hashes[1].set(estimator.SetDarkHash)
    return hashes


def _check_what_is_known(method: str, offset: object, dark: object) -> None:
    given = [name for name, value in (("offset", offset), ("dark", dark)) if value is not None]
    if given and method == "published":
        raise ValueError(
            f"{given[0]} was given and the method is 'published', which finds the offset from the flicker alone; "
            f"expected no {given[0]}, or 'refined'"
        )
    if len(given) > 1:
        raise ValueError("offset and dark were given; expected one of them")


def _set_offset(estimator: ItkObject, offset: float | tuple[float, float]) -> None:
    expected = "a finite number or (number, standard error) [DN]"
    if np.ndim(offset) == 0:
        estimator.SetOffset(_options.number("offset", offset, expected))
        return
    value, error = _options.numbers("offset", offset, 2, expected)
    estimator.SetOffset(value)
    estimator.SetOffsetStandardError(error)


def _level_range(level_range: tuple[float, float], method: str) -> tuple[float, float]:
    expected = "(low, high), two levels with low < high [DN]"
    low, high = _options.numbers("level_range", level_range, 2, expected)
    if not low < high:
        raise _options.refuse("level_range", level_range, expected)
    if method == "published":
        raise ValueError(
            "level_range was given and the method is 'published', which fits all levels; "
            "expected no level_range, or 'refined'"
        )
    return low, high


def _cut_dark(opened: Stack, stack: Stack, corner: tuple[int, ...], size: tuple[int, ...]) -> Stack:
    """The dark frames, cut as the stack is."""
    if (opened.size[:2], opened.pixel) != (stack.size[:2], stack.pixel):
        found, expected = (f"{s.size[0]} x {s.size[1]} pixels of type {s.pixel}" for s in (opened, stack))
        raise ValueError(f"dark has {found}; expected {expected}, as the frames")
    corner, size = (*corner[:2], 0), (*size[:2], opened.size[2])
    return opened if size == opened.size else crop(opened, corner, size)


def _frame_range(frame_range: tuple[int, int]) -> tuple[int, int]:
    expected = "(first, end) with 0 <= first < end"
    first, end = _options.integers("frame_range", frame_range, 2, expected)
    if not 0 <= first < end:
        raise _options.refuse("frame_range", frame_range, expected)
    return first, end


def _region(
    stack: Stack, roi: tuple[int, int, int, int] | None, span: tuple[int, int] | None
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Corner and size (x, y, t) of what roi and frame_range ask for."""
    width, height, frames = stack.size
    expected = f"(x, y, width, height) inside {width} x {height} pixels"
    corner, size = [0, 0, 0], [width, height, frames]
    if roi is not None:
        x, y, roi_width, roi_height = _options.integers("roi", roi, 4, expected)
        if min(x, y) < 0 or min(roi_width, roi_height) < 1 or x + roi_width > width or y + roi_height > height:
            raise _options.refuse("roi", roi, expected)
        corner[:2], size[:2] = (x, y), (roi_width, roi_height)
    if span is not None:
        if span[1] > frames:
            raise ValueError(f"frame_range ends at {span[1]}, but there are {frames} frames")
        corner[2], size[2] = span[0], span[1] - span[0]
    return tuple(corner), tuple(size)


def _mask_of(mask: Frame | FileName, size: tuple[int, int]) -> np.ndarray:
    """The mask (y, x) of a stack whose frames have `size` (width, height)."""
    if is_name(mask):
        mask = read_image(mask, "the mask")
    array = as_mask(mask, "mask")
    if array.shape != size[::-1]:
        raise ValueError(f"mask has shape {array.shape}; expected {size[::-1]}, that of a frame")
    return array


def _set_parameters(
    estimator: ItkObject,
    bit_depth: int | None,
    clip: tuple[float, float] | None,
    step: float | None,
    rolling_shutter: str | float,
    shutter_axis: str,
    level: float,
    quantiles: tuple[float, float],
) -> None:
    if bit_depth is not None:
        estimator.SetBitDepth(_options.integer("bit_depth", bit_depth, 1, 16))
    if clip is not None:
        low, high = _options.numbers("clip", clip, 2, "(low, high), two levels [DN]")
        estimator.SetClipLow(low)
        estimator.SetClipHigh(high)
    if step is not None:
        estimator.SetQuantisationStep(_options.number("step", step, "a number above 0 [DN]", above=0.0))
    if isinstance(rolling_shutter, str) and rolling_shutter in ("auto", "off"):
        estimator.SetRollingShutter(rolling_shutter)
    else:
        expected = "'auto', 'off' or a number of rows above 0"
        estimator.SetSigmaRows(_options.number("rolling_shutter", rolling_shutter, expected, above=0.0))
        estimator.SetRollingShutter("fixed")
    estimator.SetShutterAxis(1 if _options.one_of("shutter_axis", shutter_axis, ["y", "x"]) == "y" else 0)
    estimator.SetLevel(_options.number("level", level))
    dark, bright = _options.numbers("quantiles", quantiles, 2, "(dark, bright), two numbers from 0 to 1")
    estimator.SetDarkQuantile(dark)
    estimator.SetBrightQuantile(bright)

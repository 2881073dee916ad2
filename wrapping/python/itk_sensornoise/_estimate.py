# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The one-call way from frames to a report."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict, Unpack, overload

import numpy as np

from . import _options
from ._channels import ChannelReports, report_of
from ._errors import itk_errors
from ._frames import Stack, open_dumps, open_frames
from ._hash import FramesHash
from ._maps import arrays_of, maps_folder, require_apart, write_maps
from ._names import expand
from ._nan_frames import warn_of_nan_frames
from ._progress import at_work
from ._report import Report
from ._settings import Settings, open_dark, prepare, require_used
from ._single_image import as_frames
from ._types import FileName, Frame, Frames, ItkObject, Progress, Roi
from ._update import update


class Options(TypedDict, total=False):
    """The keywords of estimate_sensor_noise() but `bayer`, which decides what it returns."""

    method: Literal["refined", "published", "single-image"]
    offset: float | tuple[float, float] | None
    dark: Frames | None
    bit_depth: int | None
    clip: tuple[float, float] | None
    step: float | None
    level_range: tuple[float, float] | None
    exposures: Sequence[float] | None
    excess_noise_factor: float
    rolling_shutter: Literal["auto", "off"] | float
    shutter_axis: Literal["y", "x"]
    level: float
    quantiles: tuple[float, float]
    roi: Roi | None
    mask: Frame | FileName | None
    frame_range: tuple[int, int] | slice | None
    maps: bool | FileName | None
    hash: bool
    raw: str | None
    memory_limit: int | None
    threads: int | None
    progress: Progress


@overload
def estimate_sensor_noise(frames: Frames, *, bayer: Literal["none"], **options: Unpack[Options]) -> Report: ...


@overload
def estimate_sensor_noise(
    frames: Frames, *, bayer: Literal["RGGB", "GRBG", "GBRG", "BGGR"], **options: Unpack[Options]
) -> ChannelReports: ...


@overload
def estimate_sensor_noise(
    frames: Frames, *, bayer: Literal["auto"] = "auto", **options: Unpack[Options]
) -> Report | ChannelReports: ...


def estimate_sensor_noise(
    frames: Frames,
    *,
    method: Literal["refined", "published", "single-image"] = "refined",
    offset: float | tuple[float, float] | None = None,
    dark: Frames | None = None,
    bayer: Literal["auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"] = "auto",
    bit_depth: int | None = None,
    clip: tuple[float, float] | None = None,
    step: float | None = None,
    level_range: tuple[float, float] | None = None,
    exposures: Sequence[float] | None = None,
    excess_noise_factor: float = 1.0,
    rolling_shutter: Literal["auto", "off"] | float = "auto",
    shutter_axis: Literal["y", "x"] = "y",
    level: float = 0.01,
    quantiles: tuple[float, float] = (0.01, 0.99),
    roi: Roi | None = None,
    mask: Frame | FileName | None = None,
    frame_range: tuple[int, int] | slice | None = None,
    maps: bool | FileName | None = None,
    hash: bool = False,
    raw: str | None = None,
    memory_limit: int | None = None,
    threads: int | None = None,
    progress: Progress = False,
) -> Report | ChannelReports:
    """Measures gain, offset and read noise of a camera, flicker and vibration, from frames of a static scene.

    Parameters
    ----------
    frames : frames
        Raw frames in time order, at least 5 of at least 3 x 3 pixels, in one of these forms. A NumPy array (t, y, x),
        or an itk.Image of 3 dimensions (x, y, t). A list of file names, of 2-D arrays (y, x), or of objects with
        `__array__`, or the name of one stack file. A pattern of names ("frames/*.png"), a folder of files of one kind,
        a set or a generator of names: they are sorted with numbers as numbers (frame_2 before frame_10), whereas a list
        keeps its order. Any object with `shape` (t, y, x), `dtype` and slices along time, frames[first:end]: h5py,
        zarr, dask, memory maps, astropy's sections, your own class. Axes of xarray may be in any order, as their names
        are honoured. Pixels are uint8, uint16, int16, float32 or float64 [DN]. Files and such objects are read a few
        frames at a time and never held together. Stored chunks that are missing are an error, as far as h5py and zarr
        say so. Raw files of cameras (.dng, .cr2, .nef, ...) are read by rawpy, if installed: unprocessed digital
        numbers. Arrays are shared; an array that is not C-contiguous or not in the machine's byte order is copied once.
    method : {"refined", "published", "single-image"}, default "refined"
        "refined": all pixels of a static scene, textured or not; every `identified` quantity has a standard error and a
        95 % interval. "published": Figure 2 of Sur & Grédiac 2015, even areas only, without errors. "single-image":
        gain and intercept from the even areas of one frame, which may be an array (y, x), after Foi et al. 2008; each
        of several frames is measured by itself. It has no `maps`, and needs neither flicker nor `memory_limit`.
    offset : float or (float, float), optional
        The offset [DN] if it is known, or (offset, standard error): offset and read noise then need no flicker, and
        steady illumination is distinguished from the offset. Default: estimated. "refined" only.
    dark : frames, optional
        Frames without illumination, given as `frames`, of the same size and type and at the same exposure, gain and
        temperature: they determine the offset and, from two frames on, the read noise. Not together with `offset`.
        "refined" only.
    bayer : {"auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"}, default "auto"
        Colour filters in front of the pixels. "none": a monochrome sensor. "RGGB", "GRBG", "GBRG" or "BGGR", the
        colours of the upper left pixels: each of the four planes is measured by itself. "auto": as the file
        records it, else from the levels of the first frame, which do not distinguish red and blue.
    bit_depth : int, optional
        Bits of the sensor's digital numbers, 1 to 16. Default: found in the frames.
    clip : (float, float), optional
        Lowest and highest level that the sensor attains [DN]. Default: found in the frames.
    step : float, optional
        Quantization step [DN]. Default: found in the frames.
    level_range : (float, float), optional
        (low, high): levels between which the variance is fitted [DN], for sensors whose response is linear in a part
        of its range. The level of a pixel is the mean of its neighbours. Default: all. "refined" only.
    exposures : sequence of float, optional
        Exposure of each frame, in the order of the frames and in any unit: exposure times, or irradiations; 0: a dark
        frame. Finite, 0 or more, with at least 3 different values. The record's `linearity` then has the linearity
        error of EMVA 1288, and offset and responsivity of a line through the levels. One for each of `frames`, also for
        the frames that `frame_range` leaves out. Default: not given. "refined" only.
    excess_noise_factor : float, default 1
        F [1], 1 or more, of a sensor that multiplies electrons at random, 2 for an EMCCD: the frames do not determine
        F. `gain` is the slope of the variance divided by F; `variance_slope` and everything in DN do not change.
    rolling_shutter : {"auto", "off"} or float, default "auto"
        Whether the flicker may differ from line to line: "auto" (found in the frames), "off", or the width sigma_y of a
        line's neighbourhood [lines]. "refined" finds any illumination that changes differently over the frame, unless
        "off", and needs no width.
    shutter_axis : {"y", "x"}, default "y"
        Axis along which the shutter travels: "y" (lines are rows) or "x". "refined" does not use it.
    level : float, default 0.01
        Level of the test that finds pixels moved by vibrations, a probability [1]. "refined" does not use it.
    quantiles : (float, float), default (0.01, 0.99)
        Quantiles of the mean at which the dark and the bright set lie, 0 to 1 [1]. "refined" does not use them.
    roi : (int, int, int, int) or (slice, slice), optional
        (x, y, width, height) [pixel], or two slices as an array (y, x) takes them, `np.s_[50:150, 50:200]`: only these
        pixels, of the dark frames too. Default: all.
    mask : array_like (y, x), itk.Image, str or os.PathLike, optional
        Only pixels where this is not 0: an array (y, x) of a frame's size, or the name of an image file.
    frame_range : (int, int) or slice, optional
        (first, end), or slice(first, end): only the frames first, first + 1, ... end - 1, counted from 0.
    maps : bool, str or os.PathLike, optional
        Results for every pixel: mean, variance, corrected_variance [DN, DN^2] and pixel_use (0: used;
        documentation/reference/record.md lists the other values); with two dark frames or more also the camera
        calibration: pixel_offset and pixel_read_noise [DN], and the ends of their 95 % intervals, _low and _high. True:
        arrays by these names, the report's `maps`. A folder: an image (.mha) each, written there. Default: none.
    hash : bool, default False
        Whether record, table and page have the SHA-256 of the frames and of the dark frames, as `input`, to identify
        them. For names it is the hash of the bytes of all files in their order, as by the tool's --hash; the file of
        the pixels follows its header. A file that changes meanwhile is an error. For all other frames it is the hash
        of the bytes of all pixels, least significant first, frame by frame, row by row: for an array,
        hashlib.sha256(array.astype(array.dtype.newbyteorder("<")).tobytes()). `roi` and `mask` do not change the
        hash, and `frame_range` only the hash of a list, which has the frames in the range. All frames are read once
        more, also lazy frames. "of" in the record is "files" or "pixels".
    raw : str, optional
        Layout of files without a header, for `frames` and for `dark`:
        "WxH:TYPE[:SKIP[:ROW[:GAP[:END]]]]", for example "640x480:uint16le", or "1920x1080:Mono12p:64" behind 64 other
        bytes; documentation/reference/files.md lists the types. Default: the files have headers.
    memory_limit : int, optional
        Largest memory of the estimate beside the frames [bytes], for example 4 * 10**9. Frames that are read a few at a
        time are read more often if the estimate would need more memory, with the same result. "refined" needs 48 bytes
        a pixel of a frame, or 10 and 4 for each temporal component of illumination and motion that it finds (8: large
        changes of the illumination) if these are more. Floating point needs 52, or 20 and 8. "published" needs 40. The
        limit has to be at least 64 bytes a pixel
        (40), 20 kB a frame and 32 MiB. Default: no limit.
    threads : int, optional
        Number of threads. Default: all. The result is the same bits for any number.
    progress : bool or callable, default False
        True: shows the progress, with tqdm if installed, else on standard error. A function: is called with the
        fraction of the work that is done, from 0 to 1, and at the end with 1; an error of its own stops the work and is
        raised. Default: False.

    Returns
    -------
    Report or ChannelReports
        ChannelReports of a mosaic: of bayer="RGGB" and the other patterns, and where "auto" finds one; else a Report.
        Both are a NoiseReport and a dict, the same record as the JSON of `estimate-sensor-noise`; `settings` holds all
        of the options above that were given and change a number. Data that cannot be measured give quantities that are
        `failed` or `not-identifiable`, and a warning that says why.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C, within the time that a chunk of 32 MiB takes; the next call starts afresh.
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected. Files that are damaged, or not alike, are one.
    MemoryError
        There is not enough memory.
    ImportError
        A raw file of a camera without rawpy. Exceptions of a reader of lazy frames are raised unchanged.

    Warns
    -----
    UserWarning
        Frames of floating point that are NaN in every pixel, by their indices, where nothing could be measured for
        them. Where a few are, `frames_left_out` of the report names them.

    See Also
    --------
    compare : Several reports side by side.
    check_noise_model : Whether a report's noise model serves for other frames.
    denoise_with_noise_model : Images without their noise, by a report.
    itk_sensornoise.distributed.estimate_sensor_noise : Measures on several machines.

    Examples
    --------
    >>> import itk_sensornoise as sn
    >>> frames, truth = sn.simulate_sensor_noise(camera="A", condition=3, frames=50)
    >>> report = sn.estimate_sensor_noise(frames, bayer="none")
    >>> report.gain.value, report.gain.standard_error, report.offset.status
    >>> sn.estimate_sensor_noise("frames/*.tif", dark="dark/*.tif", roi=np.s_[50:150, 50:200])
    """
    hash = _options.true_or_false("hash", hash)
    settings = Settings(
        method=method,
        offset=offset,
        bayer=bayer,
        bit_depth=bit_depth,
        clip=clip,
        step=step,
        level_range=level_range,
        exposures=exposures,
        excess_noise_factor=excess_noise_factor,
        rolling_shutter=rolling_shutter,
        shutter_axis=shutter_axis,
        level=level,
        quantiles=quantiles,
        roi=roi,
        mask=mask,
        frame_range=frame_range,
        threads=threads,
    )
    settings.check(dark, ("refined", "published", "single-image"))
    if method == "single-image":
        frames = as_frames(frames)
        require_used(method, ["maps"] if maps else [])
    folder = None if maps is None or isinstance(maps, bool) else maps_folder(maps)
    frames, dark = expand(frames), expand(dark, "dark")
    if folder is not None:
        require_apart(folder, frames=frames, dark=dark, mask=mask)
    stack = _open_burst(frames, settings.span) if raw is None else open_dumps(frames, raw, settings.span)
    dark_stack = open_dark(dark, raw)
    prepared = prepare(stack, dark_stack, settings)
    estimator = prepared.estimator
    if memory_limit is not None and method != "single-image":
        estimator.SetMemoryLimit(_options.integer("memory_limit", memory_limit, 1, 2**62))
    hashes = []
    if hash:
        hashes = _set_hashes(estimator, stack, dark_stack)
    if dark_stack is not None:
        warn_of_nan_frames(dark_stack, "dark")
    with at_work(estimator, progress, *filter(None, (prepared.stack, prepared.dark))), itk_errors():
        update(estimator)
    for each in hashes:
        each.require_unchanged()
    if folder is not None:
        write_maps(estimator, folder)
    report = report_of(estimator, arrays_of(estimator) if maps is True else None)
    # Where a few frames are NaN, the report names them as frames that are left out.
    if all(record["pixels"]["used"] == 0 for record in report.get("channels", [report])):
        warn_of_nan_frames(stack, "frames")
    return report


def is_of_frames(report: Mapping[str, Any], frames: Frames, settings: Mapping[str, Any]) -> bool:
    """Returns whether a report of estimate_sensor_noise() with hashes was made of these frames and dark frames.

    The settings, with `dark`, are the same ones. All frames are read once. The size of arrays is compared, too, unless
    a region or a range of frames was measured."""
    span = Settings(frame_range=settings.get("frame_range")).span
    raw = settings.get("raw")
    stack = open_frames(frames, span) if raw is None else open_dumps(frames, raw, span)
    dark = open_dark(settings.get("dark"), raw)
    known = report.get("input", {})
    if not FramesHash(stack).is_in(known) or (dark is None) == ("dark" in known):
        return False
    if dark is not None and not FramesHash(dark).is_in(known["dark"]):
        return False
    first = report.get("channels", [report])[0]
    planes = 2 if "channels" in report else 1  # planes of a mosaic along each axis
    is_cut = span is not None or settings.get("roi") is not None
    size = tuple(int(first[name]) for name in ("width", "height", "frames"))
    return is_cut or size == (stack.size[0] // planes, stack.size[1] // planes, stack.size[2])


def _open_burst(frames: Frames, span: tuple[int, int] | None) -> Stack:
    """Opens the frames as open_frames(). The error for an array of one frame names the method that measures it."""
    try:
        return open_frames(frames, span)
    except ValueError as error:
        if not (isinstance(frames, np.ndarray) and frames.ndim == 2):
            raise
        raise type(error)(f'{error}. For one frame, use method="single-image"') from None


def _set_hashes(estimator: ItkObject, frames: Stack, dark: Stack | None) -> list[FramesHash]:
    """Hashes the frames that are going to be measured."""
    hashes = [FramesHash(frames)]
    hashes[0].set(estimator.SetFramesHash)
    if dark is not None:
        hashes.append(FramesHash(dark))
        hashes[1].set(estimator.SetDarkHash)
    return hashes

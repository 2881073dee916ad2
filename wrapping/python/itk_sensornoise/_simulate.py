# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""A burst of raw frames of a camera whose noise is known."""

import json
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import DTypeLike

from . import _options
from ._arrays import PIXEL_NAMES, PIXEL_TYPES, as_frame, view
from ._errors import itk_errors
from ._types import Frame, ItkObject
from ._update import update

_CHUNK_BYTES = 64 * 2**20
_SHAPES = ["straight", "quadratic", "wave", "shoulder", "gamma", "s-curve"]
# Setter of each flaw that is one number.
_NUMBERS = {
    "prnu": "SetPrnuSd",
    "dsnu": "SetDsnuSd",
    "gain_pattern": "SetGainSd",
    "column_gain_pattern": "SetColumnGainSd",
    "column_efficiency_pattern": "SetColumnEfficiencySd",
    "column_offset_pattern": "SetColumnOffsetSd",
    "brighter_fatter": "SetBrighterFatterPerElectron",
    "coupling": "SetCouplingFraction",
    "read_noise_spread": "SetReadNoiseSpread",
    "row_noise": "SetRowNoiseSd",
    "column_noise": "SetColumnNoiseSd",
    "defect_correction": "SetDefectThresholdSd",
    "temporal_filter": "SetTemporalFilterWeight",
    "smoothing": "SetSmoothingSd",
}
# Setter and limits of each flaw that is a whole number.
_COUNTS = {
    "median": ("SetMedianRadius", 0, 10),
    "binning": ("SetBinningFactor", 1, 64),
    "block_quality": ("SetBlockQuality", 0, 100),
    "companding": ("SetCompandingBits", 0, 16),
    "repeat": ("SetRepeatCount", 1, 2**31 - 1),
    "repeat_period": ("SetRepeatPeriod", 1, 2**31 - 1),
}
# Setter of each flaw that is given by name, and the possible names.
_NAMES = {
    "bayer": ("SetBayerPattern", ["none", "RGGB", "GRBG", "GBRG", "BGGR"]),
    "binning_interpolation": ("SetBinningInterpolation", ["nearest", "linear"]),
    "resampling_interpolation": ("SetResamplingInterpolation", ["linear", "cubic"]),
}
# Description of each flaw of two numbers, and the setters of the numbers.
_PAIRS = {
    "hot_pixels": ("(fraction, factor), two numbers", "SetHotPixelFraction", "SetHotPixelNoiseFactor"),
    "read_noise_tail": ("(fraction, spread), two numbers", "SetReadNoiseTailFraction", "SetReadNoiseTailSpread"),
    "banding": ("(amplitude, period), two numbers [DN], [row]", "SetBandingAmplitude", "SetBandingPeriod"),
    "resampling": ("(x, y), two numbers [pixel]", "SetResamplingShiftX", "SetResamplingShiftY"),
}


def simulate_sensor_noise(
    camera: Literal["A", "B", "C"] = "B",
    condition: Literal[1, 2, 3] = 3,
    frames: int = 100,
    size: tuple[int, int] | None = None,
    reference: Literal["target", "bars", "texture", "flat"] | Frame = "target",
    seed: int = 1,
    dtype: DTypeLike = np.uint16,
    *,
    gain: float | None = None,
    offset: float | None = None,
    read_noise: float | None = None,
    electrons: float | None = None,
    illumination: str | Sequence[float] = "steady",
    flicker_sd: float | None = None,
    vibration_sd: tuple[float, float] | None = None,
    optical_blur: float = 0.5,
    rolling_shutter: float = 0.0,
    bit_depth: int | None = None,
    clip: tuple[float, float] | None = None,
    bayer: Literal["none", "RGGB", "GRBG", "GBRG", "BGGR"] = "none",
    transmission: tuple[float, float, float] | None = None,
    prnu: float = 0.0,
    dsnu: float = 0.0,
    hot_pixels: tuple[float, float] | None = None,
    gain_pattern: float = 0.0,
    column_gain_pattern: float = 0.0,
    column_efficiency_pattern: float = 0.0,
    column_offset_pattern: float = 0.0,
    brighter_fatter: float = 0.0,
    coupling: float = 0.0,
    read_noise_spread: float = 0.0,
    read_noise_tail: tuple[float, float] | None = None,
    response: tuple[Literal["straight", "quadratic", "wave", "shoulder", "gamma", "s-curve"], float] | None = None,
    row_noise: float = 0.0,
    column_noise: float = 0.0,
    banding: tuple[float, float] | None = None,
    dark: bool = False,
    defect_correction: float = 0.0,
    temporal_filter: float = 0.0,
    median: int = 0,
    smoothing: float = 0.0,
    binning: int = 1,
    binning_interpolation: Literal["nearest", "linear"] = "nearest",
    resampling: tuple[float, float] | None = None,
    resampling_interpolation: Literal["linear", "cubic"] = "linear",
    block_quality: int = 0,
    companding: int = 0,
    repeat: int = 1,
    repeat_period: int = 1,
) -> tuple[np.ndarray, dict[str, Any]]:
    """Simulates a burst of raw frames of known noise, with flickering illumination and vibration.

    Parameters
    ----------
    camera, condition : {"A", "B", "C"}, {1, 2, 3}
        Camera, illumination and vibration of Table 1 of Sur & Grédiac 2015; the other parameters replace single
        numbers.
    frames : int, default 100
        Number of frames T, at least 1.
    size : (int, int), optional
        (width, height) of the scene [pixel]. Default (512, 512); a reference that is an array has its own.
    reference : {"target", "bars", "texture", "flat"} or array_like (y, x)
        The scene: "target", "bars", "texture", "flat", or an array (y, x) of any range.
    seed : int, default 1
        Seed of the noise, 0 or more: the same seed gives the same bits. The scene stays the same.
    dtype : dtype, default uint16
        uint8, uint16, int16, float32 or float64; floating point is neither rounded nor clipped to digital numbers.
    gain, offset, read_noise, electrons : float, optional
        Gain [DN/e-], offset [DN], read noise [DN], electrons of the brightest pixel [e-]. Default: the values of the
        camera.
    illumination : str or sequence of float, default "steady"
        Illumination factor of the frames [1]: one number a frame, or the name of a shape with its lowest factor L and
        its period P [frames]: "pulses:L:P" (1 in every P-th frame, else L), "ramp:L" (L to 1), "decay:L"
        (exponential, 1 to L), "sine:L:P", "uniform:L" (random, L to 1), "exponential:L" (random, mean 1).
    flicker_sd, vibration_sd : float, (float, float), optional
        Standard deviations of the flicker [1] and of the shifts (x, y) [pixel]. Default: the values of the condition.
    optical_blur : float, default 0.5
        Standard deviation of the Gaussian optical blur [pixel].
    rolling_shutter : float, default 0
        Period of pulsed illumination in rows of a rolling shutter; 0: the whole frame flickers.
    bit_depth : int, optional
        Bits of the converter, at most 16; 0: no clipping below the pixel type's range. Default 12, or 8 for uint8.
    clip : (float, float), optional
        Lowest and highest level that the sensor attains [DN]. Default: none.
    bayer, transmission : str, (float, float, float), optional
        Mosaic of colour filters by its pattern, and the transmission of its filters (R, G, B) for the scene's
        electrons [1]. Default: no filters; (0.6, 1, 0.5).
    prnu, dsnu : float, default 0
        Standard deviations of the pixels' efficiency, relative [1], and of their offset [DN].
    hot_pixels : (float, float), optional
        (fraction, factor) [1]: fraction of the pixels, and their read noise over the read noise of the others. Default:
        none.
    gain_pattern, column_gain_pattern : float, default 0
        Relative standard deviations of the gain, from pixel to pixel and from column to column [1], below 0.2.
    column_efficiency_pattern, column_offset_pattern : float, default 0
        Standard deviations of the columns' efficiency, relative [1], and of their offset [DN].
    brighter_fatter : float, default 0
        Shift of the border between two pixels for each electron of difference [1/e-], for example 1e-6.
    coupling : float, default 0
        Fraction of its charge that a pixel gives to each of its four neighbours [1], 0 to 0.2.
    read_noise_spread : float, default 0
        Standard deviation of the logarithm of the pixels' read noise [1]; `read_noise` is their median.
    read_noise_tail : (float, float), optional
        (fraction, spread): fraction of pixels whose logarithm is greater by |normal| times spread. Default: none.
    response : (str, float), optional
        (shape, size): ("quadratic", "wave" or "shoulder", deviation of the local gain), ("gamma", exponent) or
        ("s-curve", weight). Default: straight.
    row_noise, column_noise : float, default 0
        Standard deviations of the noise common to the pixels of a row or of a column in a frame [DN].
    banding : (float, float), optional
        (amplitude, period) of a sine along y with a phase of its own in each frame [DN], [row]. Default: none.
    dark : bool, default False
        The shutter is closed: frames of the same sensor, with the same fixed patterns and other noise.
    defect_correction : float, default 0
        In the camera: deviation from the neighbours, in their standard deviations, from which a pixel becomes their
        median; 0: none.
    temporal_filter : float, default 0
        In the camera: weight of the last frame in each frame [1], 0 to 0.99.
    median : int, default 0
        In the camera: radius of a median filter [pixel], 1: 3 x 3, at most 10; 0: none.
    smoothing : float, default 0
        In the camera: standard deviation of a Gaussian filter [pixel].
    binning, binning_interpolation : int, {"nearest", "linear"}
        In the camera: side of the square tiles whose pixels become their mean, 1 to 64, and the interpolation to the
        old size; 1: none.
    resampling, resampling_interpolation : (float, float), {"linear", "cubic"}
        In the camera: shift (x, y) by "linear" or "cubic" interpolation [pixel]. Default: none.
    block_quality : int, default 0
        In the camera: JPEG-like quantization of 8 x 8 pixels, libjpeg's quality from 1 to 100; 0: none.
    companding : int, default 0
        In the camera: bits of the square-root quantization that is expanded again, 2 to 16; 0: none.
    repeat, repeat_period : int, default 1
        How often each exposure, or the last one of each `repeat_period` exposures, is written, 1 or more.

    Returns
    -------
    stack, truth
        The array (t, y, x), and a mapping with what an estimator should find. As in the file that
        `simulate-sensor-noise` writes, `camera` and `condition` are None where one of their numbers was replaced.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    estimate_sensor_noise : Measures what was simulated.

    Examples
    --------
    >>> stack, truth = itk.simulate_sensor_noise(camera="A", condition=3, frames=50, size=(256, 256))
    >>> truth["gain"]
    """
    parameters = dict(locals())
    import itk

    pixel = _pixel_type(dtype)
    scene, kept = _scene(reference, size)
    source = itk.SensorNoiseStackSource[itk.Image[getattr(itk, PIXEL_TYPES[pixel][0]), 3]].New()
    source.SetReference(scene)
    source.SetCamera(_options.one_of("camera", camera, ["A", "B", "C"]))
    source.SetConditions(_options.integer("condition", condition, 1, 3))
    source.SetNumberOfFrames(_options.integer("frames", frames, 1, 2**31 - 1))
    source.SetSeed(_options.integer("seed", seed, 0, 2**64 - 1))
    if bit_depth is not None:
        source.SetBitDepth(_options.integer("bit_depth", bit_depth, 0, 16))
    for name, value, setter in (
        ("gain", gain, source.SetGain),
        ("offset", offset, source.SetOffset),
        ("read_noise", read_noise, source.SetReadNoise),
        ("electrons", electrons, source.SetElectrons),
        ("flicker_sd", flicker_sd, source.SetFlickerSd),
        ("optical_blur", optical_blur, source.SetOpticalBlur),
        ("rolling_shutter", rolling_shutter, source.SetRollingShutterPeriod),
    ):
        if value is not None:
            setter(_options.number(name, value))
    if isinstance(illumination, str):
        with itk_errors(kind=ValueError):
            source.SetIllumination(illumination)
    else:
        expected = f"a shape's name, or one factor for each of the {frames} frames"
        source.SetIlluminationFactors(_options.numbers("illumination", illumination, frames, expected))
    if vibration_sd is not None:
        sd_x, sd_y = _options.numbers("vibration_sd", vibration_sd, 2, "(x, y), two numbers [pixel]")
        source.SetVibrationSdX(sd_x)
        source.SetVibrationSdY(sd_y)
    if clip is not None:
        low, high = _options.numbers("clip", clip, 2, "(low, high), two levels [DN]")
        source.SetClipLow(low)
        source.SetClipHigh(high)
    _set_flaws(source, {name: value for name, value in parameters.items() if name in _NUMBERS or name in _PAIRS})
    if transmission is not None:
        expected = "(R, G, B), three numbers from 0 to 1"
        for colour, part in zip("RGB", _options.numbers("transmission", transmission, 3, expected), strict=True):
            getattr(source, f"SetTransmission{colour}")(part)
    if response is not None:
        _set_response(source, response)
    for name, (setter, *limits) in _COUNTS.items():
        getattr(source, setter)(_options.integer(name, parameters[name], *limits))
    for name, (setter, names) in _NAMES.items():
        getattr(source, setter)(_options.one_of(name, parameters[name], names))
    source.SetDark(bool(dark))
    # The only possible error here is a parameter out of range.
    with itk_errors(kind=ValueError):
        stack = _draw(source, np.dtype(pixel))
    truth = json.loads(source.GetTruthAsJson())
    is_paper_camera = all(value is None for value in (gain, offset, read_noise, electrons))
    is_paper_condition = flicker_sd is None and vibration_sd is None
    is_paper_condition = is_paper_condition and isinstance(illumination, str) and illumination == "steady"
    truth["reference"] = reference if isinstance(reference, str) else "array"
    truth["camera"] = camera if is_paper_camera else None
    truth["condition"] = condition if is_paper_condition else None
    del kept
    return stack, truth


def _set_flaws(source: ItkObject, flaws: dict[str, Any]) -> None:
    """Sets flaws of one or two numbers. None keeps a pair."""
    for name, value in flaws.items():
        if name in _NUMBERS:
            getattr(source, _NUMBERS[name])(_options.number(name, value))
        elif value is not None:
            expected, *setters = _PAIRS[name]
            for setter, number in zip(setters, _options.numbers(name, value, 2, expected), strict=True):
                getattr(source, setter)(number)


def _set_response(source: ItkObject, response: tuple[str, float]) -> None:
    expected = "(shape, size), a name and a number"
    shape, size = _options.items("response", response, 2, expected)
    source.SetResponseShape(_options.one_of("response[0]", shape, _SHAPES))
    source.SetResponseSize(_options.number("response", size, expected))


def _draw(source: ItkObject, dtype: np.dtype[Any]) -> np.ndarray:
    """Returns the source's output as an array that owns its memory, drawn a few frames at a time into it."""
    import itk

    source.UpdateOutputInformation()
    output = source.GetOutput()
    region = output.GetLargestPossibleRegion()
    width, height, frames = (int(extent) for extent in region.GetSize())
    stack = np.empty((frames, height, width), dtype)
    step = max(_CHUNK_BYTES // stack[0].nbytes, 1)
    for first in range(0, frames, step):
        region.SetIndex([0, 0, first])
        region.SetSize([width, height, min(step, frames - first)])
        output.SetRequestedRegion(region)
        update(source)
        stack[first : first + step] = itk.array_view_from_image(output, update=False)
    return stack


def _pixel_type(dtype: DTypeLike) -> str:
    """Returns the name of the pixel type, as in PIXEL_TYPES."""
    try:
        pixel = np.dtype(dtype).newbyteorder("=").name
    except TypeError:
        pixel = repr(dtype)
    if pixel not in PIXEL_TYPES:
        raise ValueError(f"dtype is {pixel}; expected {PIXEL_NAMES}")
    return pixel


def _scene(reference: Frame, size: tuple[int, int] | None) -> tuple[ItkObject, object]:
    """Returns the reference image, and the owner of its memory."""
    import itk

    if not isinstance(reference, str):
        if size is not None:
            raise ValueError(f"size is {size!r}, but a reference that is an array has its own; expected no size")
        array = as_frame(reference, "reference", np.float64)
        return view(array), array
    _options.one_of("reference", reference, ["target", "bars", "texture", "flat"])
    expected = "(width, height), two whole numbers above 0 [pixel]"
    width, height = (512, 512) if size is None else _options.integers("size", size, 2, expected)
    if min(width, height) < 1:
        raise _options.refuse("size", size, expected)
    source = itk.SensorNoiseSceneSource[itk.Image[itk.D, 2]].New()
    source.SetScene(reference)
    source.SetWidth(width)
    source.SetHeight(height)
    with itk_errors(kind=ValueError):
        update(source)
    return source.GetOutput(), source

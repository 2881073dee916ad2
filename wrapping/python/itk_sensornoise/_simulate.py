# ==========================================================================
#
#   Copyright the ITKSensorNoise contributors
#
#   Licensed under the Apache License, Version 2.0 (the "License");
#   you may not use this file except in compliance with the License.
#   You may obtain a copy of the License at
#
#          https://www.apache.org/licenses/LICENSE-2.0.txt
#
#   Unless required by applicable law or agreed to in writing, software
#   distributed under the License is distributed on an "AS IS" BASIS,
#   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
#   See the License for the specific language governing permissions and
#   limitations under the License.
#
# ==========================================================================*/
"""A burst of raw frames of a camera whose noise is known."""

import json
from typing import Any, Literal

import numpy as np

from . import _options
from ._arrays import PIXEL_NAMES, PIXEL_TYPES, as_frame, view
from ._errors import itk_errors

_CHUNK_BYTES = 64 * 2**20


def simulate_sensor_noise(
    camera: Literal["A", "B", "C"] = "B",
    condition: Literal[1, 2, 3] = 3,
    frames: int = 100,
    size: tuple[int, int] | None = None,
    reference: Any = "target",
    seed: int = 1,
    dtype: Any = np.uint16,
    *,
    gain: float | None = None,
    offset: float | None = None,
    read_noise: float | None = None,
    electrons: float | None = None,
    flicker_sd: float | None = None,
    vibration_sd: tuple[float, float] | None = None,
    rolling_shutter: float = 0.0,
    bit_depth: int | None = None,
    clip: tuple[float, float] | None = None,
) -> tuple[np.ndarray, dict[str, Any]]:
    """Simulates a burst of raw frames under flickering light and on a trembling floor, with known noise.

    Parameters
    ----------
    camera, condition
        Camera, light and floor of Table 1 of Sur & Grédiac 2015; each of their numbers can be replaced below.
    frames
        Number of frames T, at least 1.
    size
        (width, height) of the scene [pixel]. Default (512, 512); a reference that is an array has its own.
    reference
        The scene: "target", "bars", "texture", or an array (y, x) of any range.
    seed
        Seed of the noise, 0 or more: the same seed gives the same bits. The scene stays the same.
    dtype
        uint8, uint16, int16, float32 or float64; floating point is neither rounded nor clipped to codes.
    gain, offset, read_noise, electrons
        Gain [DN/e-], offset [DN], read noise [DN], electrons of the brightest pixel [e-]. Default: the camera's.
    flicker_sd, vibration_sd
        Standard deviations of the flicker [1] and of the shifts (x, y) [pixel]. Default: the condition's.
    rolling_shutter
        Period of a pulsing lamp in rows of a rolling shutter; 0: the whole frame flickers.
    bit_depth
        Bits of the converter, at most 16; 0: no clipping below the pixel type's range. Default 12, or 8 for uint8.
    clip
        Levels (low, high) between which the sensor itself is limited [DN]. Default: none.

    Returns
    -------
    stack, truth
        The array (t, y, x), and a mapping with what an estimator should find. As in the file that
        `simulate-sensor-noise` writes, `camera` and `condition` are None where one of their numbers was replaced.

    Raises
    ------
    ValueError
        Wrong use; says what was found and what was expected.
    """
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
        ("rolling_shutter", rolling_shutter, source.SetRollingShutterPeriod),
    ):
        if value is not None:
            setter(_options.number(name, value))
    if vibration_sd is not None:
        sd_x, sd_y = _options.numbers("vibration_sd", vibration_sd, 2, "(x, y), two numbers [pixel]")
        source.SetVibrationSdX(sd_x)
        source.SetVibrationSdY(sd_y)
    if clip is not None:
        low, high = _options.numbers("clip", clip, 2, "(low, high), two levels [DN]")
        source.SetClipLow(low)
        source.SetClipHigh(high)
    # All that can go wrong here is a parameter out of range.
    with itk_errors(kind=ValueError):
        stack = _draw(source, np.dtype(pixel))
    truth = json.loads(source.GetTruthAsJson())
    is_paper_camera = all(value is None for value in (gain, offset, read_noise, electrons))
    is_paper_condition = flicker_sd is None and vibration_sd is None
    truth["reference"] = reference if isinstance(reference, str) else "array"
    truth["camera"] = camera if is_paper_camera else None
    truth["condition"] = condition if is_paper_condition else None
    del kept
    return stack, truth


def _draw(source: Any, dtype: np.dtype) -> np.ndarray:
    """The source's output as an array that owns its memory, drawn a few frames at a time into it."""
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
        output.Update()
        stack[first : first + step] = itk.array_view_from_image(output, update=False)
    return stack


def _pixel_type(dtype: Any) -> str:
    """The name of the pixel type, as in PIXEL_TYPES."""
    try:
        pixel = np.dtype(dtype).newbyteorder("=").name
    except TypeError:
        pixel = repr(dtype)
    if pixel not in PIXEL_TYPES:
        raise ValueError(f"dtype is {pixel}; expected {PIXEL_NAMES}")
    return pixel


def _scene(reference: Any, size: Any) -> tuple[Any, Any]:
    """The reference image, and what its memory belongs to."""
    import itk

    if not isinstance(reference, str):
        if size is not None:
            raise ValueError(f"size is {size!r}, but a reference that is an array has its own; expected no size")
        array = as_frame(reference, "reference", np.float64)
        return view(array), array
    _options.one_of("reference", reference, ["target", "bars", "texture"])
    expected = "(width, height), two whole numbers above 0 [pixel]"
    width, height = (512, 512) if size is None else _options.integers("size", size, 2, expected)
    if min(width, height) < 1:
        raise _options.refuse("size", size, expected)
    source = itk.SensorNoiseSceneSource[itk.Image[itk.D, 2]].New()
    source.SetScene(reference)
    source.SetWidth(width)
    source.SetHeight(height)
    with itk_errors(kind=ValueError):
        source.Update()
    return source.GetOutput(), source

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads raw files of cameras with the package rawpy (LibRaw): unprocessed digital numbers, and camera settings."""

import math
import os
import struct
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from ._errors import itk_errors
from ._types import FileName

ENDINGS = (
    *(".3fr", ".arw", ".cr2", ".cr3", ".crw", ".dng", ".erf", ".iiq", ".mef", ".mos", ".mrw", ".nef", ".nrw", ".orf"),
    *(".pef", ".raf", ".rw2", ".rwl", ".srw"),
)

# No raw file packs more; as LibRawFrame.cxx has it.
_MOST_PIXELS_PER_BYTE = 32

# Digits that distinguish any two numbers of single precision.
_DIGITS_OF_SINGLE = 9

# Tags of a TIFF, which most raw files are.
_MAKE, _MODEL, _TEXT = 271, 272, 2


def is_raw(name: FileName) -> bool:
    """Returns whether the name ends as a raw file's of a camera."""
    return os.fsdecode(name).lower().endswith(ENDINGS)


def read_grey_values(name: FileName, is_new: bool = True) -> np.ndarray:
    """Returns the unprocessed digital numbers (y, x) of the active area of a raw file. A new file is checked."""
    with _open(name, is_new) as raw:
        return _grey_values_of(raw, name).copy()


def raw_metadata(name: FileName) -> dict[str, Any]:
    """Reads the description of the digital numbers in a raw file of a camera.

    Parameters
    ----------
    name : str or os.PathLike
        Name of the file.

    Returns
    -------
    dict
        None stands where the file, or rawpy, does not say.

            bayer             "RGGB", "GRBG", "GBRG" or "BGGR", at the first pixel of the active area; None: other
                              filters
            black_level       dark offset [DN], the mean over the four channels, whose own are in black_levels
            white_level       highest level of the converter, as the file says [DN]
            iso_speed, exposure_seconds, camera

    Raises
    ------
    ValueError
        The file is no raw file.
    ImportError
        rawpy is not installed.

    See Also
    --------
    estimate_sensor_noise : Reads such files as frames.

    Examples
    --------
    >>> itk_sensornoise.raw_metadata("frame.dng")["bayer"]
    """
    with _open(name) as raw:
        black = [float(level) for level in raw.black_level_per_channel]
        _grey_values_of(raw, name)  # is a mosaic
        return {
            "bayer": _bayer(raw),
            "black_level": sum(black) / len(black) if black else None,
            "black_levels": black,
            "white_level": float(raw.white_level) or None,
            **_settings_of(raw),
            "camera": _camera(name),
        }


def raw_settings(name: FileName) -> dict[str, float | None]:
    """Returns `iso_speed` and `exposure_seconds` of a raw file, whose pixels are not read. Raises errors as
    raw_metadata()."""
    with _open(name) as raw:
        return _settings_of(raw)


class RawFiles:
    """Lazy frames (t, y, x) from raw files of one frame each: shape, dtype and slices along time."""

    def __init__(self, names: Sequence[FileName]) -> None:
        self.names = list(names)
        first = read_grey_values(self.names[0])
        self._checked = {os.fsdecode(self.names[0])}
        self.shape = (len(self.names), *first.shape)
        self.dtype = first.dtype

    def __getitem__(self, times: slice) -> np.ndarray:
        frames = np.empty((len(self.names[times]), *self.shape[1:]), self.dtype)
        for frame, name in zip(frames, self.names[times], strict=True):
            grey_values = read_grey_values(name, is_new=os.fsdecode(name) not in self._checked)
            self._checked.add(os.fsdecode(name))
            if grey_values.shape != frame.shape or grey_values.dtype != frame.dtype:
                raise ValueError(
                    f"{os.fsdecode(name)}: {grey_values.shape[1]} x {grey_values.shape[0]} pixels of type "
                    f"{grey_values.dtype}, but {os.fsdecode(self.names[0])} has {self.shape[2]} x {self.shape[1]} "
                    f"of type {self.dtype}; all frames must be alike"
                )
            frame[...] = grey_values
        return frames


@contextmanager
def _open(name: FileName, is_new: bool = True) -> Iterator[Any]:
    """Opens a file with rawpy. A new file is checked. Raises ValueError for errors that LibRaw finds at opening, or
    when it decodes the digital numbers."""
    text = os.fsdecode(name)
    if not os.path.exists(text):
        raise ValueError(f"{text}: does not exist")
    if not os.path.isfile(text):  # LibRaw would wait for what comes out of a pipe
        raise ValueError(f"{text}: is no regular file")
    try:
        import rawpy
    except ImportError as error:
        raise ImportError(
            f"{text}: raw files of cameras are read by rawpy: pip install itk-sensornoise[raw]"
        ) from error
    try:
        with rawpy.imread(text) as raw:
            if is_new:
                _require_whole(text, raw)
            yield raw
    except rawpy.LibRawError as error:
        reason = error.args[0].decode() if error.args and isinstance(error.args[0], bytes) else error
        raise ValueError(f"{text}: rawpy cannot read it ({reason}); expected a raw file of a camera") from error


def _require_whole(name: str, raw: Any) -> None:
    """Raises ValueError for a truncated DNG. LibRaw accepts it, and rawpy does not report the warnings of LibRaw."""
    import itk

    if raw.sizes.raw_width * raw.sizes.raw_height > _MOST_PIXELS_PER_BYTE * os.path.getsize(name):
        raise ValueError(
            f"{name}: truncated or damaged: declares {raw.sizes.raw_width} x {raw.sizes.raw_height} pixels, more than "
            "its bytes can hold"
        )
    with itk_errors(kind=ValueError):
        itk.SensorNoiseImageIO.RequireWholeRawTiff(name, raw.sizes.raw_width, raw.sizes.raw_height)


def _grey_values_of(raw: Any, name: FileName) -> np.ndarray:
    grey_values: np.ndarray | None = raw.raw_image_visible
    if grey_values is None or grey_values.ndim != 2:
        raise ValueError(
            f"{os.fsdecode(name)}: is no mosaic, but has several colours a pixel; expected what a raw sensor gives, one"
        )
    return grey_values


def _bayer(raw: Any) -> str | None:
    if raw.raw_pattern is None or raw.raw_pattern.shape != (2, 2):
        return None
    letters = raw.color_desc.decode()
    found = "".join(letters[colour] for colour in raw.raw_colors_visible[:2, :2].ravel())
    return found if found in ("RGGB", "GRBG", "GBRG", "BGGR") else None


def _settings_of(raw: Any) -> dict[str, float | None]:
    other = getattr(raw, "other", None)
    return {
        "iso_speed": _positive(other, "iso_speed"),
        "exposure_seconds": _shortest_decimal(_positive(other, "shutter_speed")),
    }


def _positive(other: Any, name: str) -> float | None:
    value = getattr(other, name, None)
    return float(value) if value and math.isfinite(value) else None


def _shortest_decimal(value: float | None) -> float | None:
    """Returns the decimal number of fewest digits that is the value in single precision, which LibRaw's exposures have:
    0.01, not 0.009999999776."""
    if value is None:
        return None
    decimals = (float(f"{value:.{digits}g}") for digits in range(1, _DIGITS_OF_SINGLE + 1))
    return next((decimal for decimal in decimals if np.float32(decimal) == np.float32(value)), value)


def _camera(name: FileName) -> str | None:
    """Returns make and model from the first directory of a TIFF, as rawpy has neither; None: no TIFF, or no entries."""
    with open(name, "rb") as file:
        head = file.read(8)
        order = {b"II": "<", b"MM": ">"}.get(head[:2])
        if order is None or len(head) < 8:
            return None
        file.seek(struct.unpack(order + "I", head[4:])[0])
        count = struct.unpack(order + "H", file.read(2).ljust(2, b"\0"))[0]
        entries = file.read(12 * count)
        words = {}
        for at in range(0, len(entries) - 11, 12):
            tag, kind, size, place = struct.unpack_from(order + "HHII", entries, at)
            if tag in (_MAKE, _MODEL) and kind == _TEXT and size <= 256:
                if size > 4:
                    file.seek(place)
                text = file.read(size) if size > 4 else entries[at + 8 : at + 8 + size]
                words[tag] = text.split(b"\0")[0].decode("latin-1").strip()
    make, model = words.get(_MAKE, ""), words.get(_MODEL, "")
    return (model if model.lower().startswith(make.lower()) else f"{make} {model}") or None

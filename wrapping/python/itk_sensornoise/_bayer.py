# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Colour filters in front of the pixels: given, or as the frames' file says."""

from collections.abc import Sequence

from . import _options
from ._types import ItkObject

PATTERNS = ["auto", "none", "RGGB", "GRBG", "GBRG", "BGGR"]
_KEY = "SensorNoise.BayerPattern"


def cut_pattern(pattern: str, columns: int, rows: int) -> str:
    """Returns the pattern of a mosaic after so many columns and rows were cut off its left and upper side."""
    return "".join(pattern[2 * ((y + rows) % 2) + (x + columns) % 2] for y in range(2) for x in range(2))


def note_pattern(image: ItkObject, pattern: str | None) -> None:
    """Says in an image's metadata which pattern its file has."""
    if pattern is not None:
        image[_KEY] = pattern


def noted_pattern(image: ItkObject) -> str | None:
    """Returns the Bayer pattern in the metadata of an image; None without a pattern."""
    known = dict(image).get(_KEY)
    return str(known) if known else None


def set_pattern(estimator: ItkObject, bayer: str, whole: ItkObject, corner: Sequence[int]) -> None:
    """Sets the pattern, given for the `whole` frames or in their metadata, of what was cut out of them at `corner`."""
    _options.one_of("bayer", bayer, PATTERNS)
    known = noted_pattern(whole) if whole is not None else None
    if bayer == "auto" and known:
        note_pattern(estimator.GetInput(), cut_pattern(known, corner[0], corner[1]))
    given = bayer in ("auto", "none")
    estimator.SetBayerPattern(bayer if given else cut_pattern(bayer, corner[0], corner[1]))

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames that hold no number: they are named, as one of them leaves no pixel of a stack with a mean."""

import warnings
from collections.abc import Iterator

import numpy as np

from ._frames import Stack

_CHUNK_BYTES = 32 << 20
_NAMED = 10


def warn_of_nan_frames(stack: Stack, name: str, stacklevel: int = 3) -> None:
    """Warns of the frames of a stack of floating point whose pixels are all NaN, by their indices. Reads each frame
    that begins with NaN; integers are not read."""
    if not stack.pixel.startswith("float"):
        return
    found = [number for number, frame in enumerate(_frames_of(stack)) if _is_nan(frame)]
    if found:
        named = ", ".join(map(str, found[:_NAMED])) + (f", ... ({len(found)} in all)" if len(found) > _NAMED else "")
        which = f"frame {named} is" if len(found) == 1 else f"frames {named} are"
        advice = "leave them out, or read them again"
        warnings.warn(f"{name}: {which} NaN in every pixel; {advice}", stacklevel=stacklevel)


def _is_nan(frame: np.ndarray) -> bool:
    return bool(np.isnan(frame.flat[0]) and np.isnan(frame).all())


def _frames_of(stack: Stack) -> Iterator[np.ndarray]:
    """Every frame (y, x), read a few at a time where it is not in memory."""
    import itk

    image, (width, height, frames) = stack.image, stack.size
    region = image.GetLargestPossibleRegion()
    start, size = list(region.GetIndex()), list(region.GetSize())
    step = max(_CHUNK_BYTES // (width * height * np.dtype(stack.pixel).itemsize), 1)
    for first in range(0, frames, step):
        count = min(step, frames - first)
        region.SetIndex([*start[:2], start[2] + first])
        region.SetSize([*size[:2], count])
        image.SetRequestedRegion(region)
        image.Update()
        if stack.failed:
            break  # said by whoever reads them next
        at = start[2] + first - image.GetBufferedRegion().GetIndex()[2]
        yield from itk.array_view_from_image(image)[at : at + count]
    image.SetRequestedRegionToLargestPossibleRegion()

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames that hold no number: they are named, as one of them leaves no pixel of a stack with a mean."""

import warnings
from itertools import chain

import numpy as np

from ._frames import Stack

_NAMED = 10


def warn_of_nan_frames(stack: Stack, name: str, stacklevel: int = 3) -> None:
    """Warns of the frames of a stack of floating point whose pixels are all NaN, by their indices. Reads each frame
    that begins with NaN; integers are not read."""
    if not stack.pixel.startswith("float"):
        return
    # Frames that cannot be read are left to whoever reads them next.
    found = [number for number, frame in enumerate(chain.from_iterable(stack.pieces())) if _is_nan(frame)]
    if found:
        named = ", ".join(map(str, found[:_NAMED])) + (f", ... ({len(found)} in all)" if len(found) > _NAMED else "")
        which = f"frame {named} is" if len(found) == 1 else f"frames {named} are"
        advice = "leave them out, or read them again"
        warnings.warn(f"{name}: {which} NaN in every pixel; {advice}", stacklevel=stacklevel)


def _is_nan(frame: np.ndarray) -> bool:
    return bool(np.isnan(frame.flat[0]) and np.isnan(frame).all())

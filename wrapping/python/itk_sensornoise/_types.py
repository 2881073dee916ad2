# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The types of what people give, by name: what a checker and a reader of the signatures want to know."""

import os
from collections.abc import Sequence
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

FileName: TypeAlias = str | os.PathLike[str]


class HasArray(Protocol):
    """What NumPy can look at: arrays, itk.Image, tensors and frames of other libraries."""

    def __array__(self) -> np.ndarray: ...


# A stack: an array or image (t, y, x), one file name, or a list of file names or of arrays (y, x) in time order.
Frames: TypeAlias = FileName | HasArray | Sequence[FileName] | Sequence[HasArray]

# A map of a frame's size: an array (y, x), an itk.Image or nested lists of numbers.
Frame: TypeAlias = ArrayLike

# Filters, images and types of ITK, for which it has no types that a checker could use.
ItkObject: TypeAlias = Any

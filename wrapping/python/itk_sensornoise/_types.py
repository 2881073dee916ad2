# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Names for the types of arguments, for type checkers and readers of the signatures."""

import os
from collections.abc import Callable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

FileName: TypeAlias = str | os.PathLike[str]


class HasArray(Protocol):
    """Objects that NumPy can view: arrays, itk.Image, tensors and frames of other libraries."""

    def __array__(self) -> np.ndarray: ...


class LazyFrames(Protocol):
    """Frames (t, y, x) that are read as they are sliced along time, frames[first:end]: of h5py, zarr, dask, xarray,
    astropy's sections, or a class of one's own."""

    @property
    def shape(self) -> tuple[int, ...]: ...

    @property
    def dtype(self) -> Any: ...

    def __getitem__(self, times: slice, /) -> Any: ...


# A stack is an array, an image or lazy frames (t, y, x), a file name, a pattern of names or a folder. It may also be a
# list of file names or of arrays (y, x) in time order, or a set or a generator of file names.
Frames: TypeAlias = (
    FileName
    | HasArray
    | LazyFrames
    | Sequence[FileName]
    | Sequence[HasArray]
    | AbstractSet[FileName]
    | Iterator[FileName]
)

# A map of a frame's size: an array (y, x), an itk.Image or nested lists of numbers.
Frame: TypeAlias = ArrayLike

# A rectangle of a frame: (x, y, width, height), or slices (y, x) as numpy.s_ makes them.
Roi: TypeAlias = tuple[int, int, int, int] | tuple[slice, slice]

# Whether progress is shown, or what is called with the fraction of the work that is done.
Progress: TypeAlias = bool | Callable[[float], object]

# Filters, images and types of ITK, for which it has no types that a checker could use.
ItkObject: TypeAlias = Any

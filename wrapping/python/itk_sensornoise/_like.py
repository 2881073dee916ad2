# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Inputs and outputs in ITK's habits: filters stand for their outputs, and results have the type of what was given."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ._axes import in_time_order
from ._errors import itk_errors


def is_process(values: Any) -> bool:
    """Returns whether it is a filter of ITK, whose first output is meant."""
    return hasattr(values, "GetOutput") and hasattr(values, "UpdateOutputInformation") and not is_image(values)


def is_image(values: Any) -> bool:
    """Returns whether it is an itk.Image."""
    return hasattr(values, "GetLargestPossibleRegion")


def output_of(values: Any) -> Any:
    """Returns the output of a filter, which is read later, or any other value unchanged."""
    return values.GetOutput() if is_process(values) else values


def updated(values: Any) -> Any:
    """Returns an image, or the output of a filter, with its pixels; any other value is returned unchanged."""
    values = output_of(values)
    if is_image(values):
        with itk_errors():
            values.Update()
    return values


def is_labelled(values: Any) -> bool:
    """Returns whether it is an array of xarray, whose axes have names and coordinates."""
    return type(values).__module__.startswith("xarray.") and hasattr(values, "dims") and hasattr(values, "coords")


def frame_like(stack: Any, image: Any, name: str) -> Any:
    """Gives a filter's output of a frame's size the type of the stack: an image of an image or a filter, of xarray an
    array of xarray, else an array (y, x)."""
    import itk

    if is_image(stack) or is_process(stack):
        return image
    array: np.ndarray = itk.array_from_image(image)
    if not is_labelled(stack):
        return array
    return _labelled(in_time_order(stack, "stack"), array, name, slice(1, None))


def stack_like(stack: Any, image: Any, name: str) -> Any:
    """Does the same for a filter's output of the size of the stack."""
    import itk

    if is_image(stack) or is_process(stack):
        return image
    array: np.ndarray = itk.array_from_image(image)
    return _labelled(in_time_order(stack, "stack"), array, name, slice(None)) if is_labelled(stack) else array


def picture_like(picture: Any, image: Any, name: str) -> Any:
    """Does the same for a filter of frames, whose output has the axes of the picture."""
    import itk

    if is_image(picture) or is_process(picture):
        return image
    array: np.ndarray = itk.array_from_image(image)
    return _labelled(picture, array, name, slice(None)) if is_labelled(picture) else array


def _labelled(like: Any, array: np.ndarray, name: str, axes: slice) -> Any:
    """Returns an array of xarray with the axes and coordinates of another array."""
    import xarray

    dims: Sequence[Any] = like.dims[axes]
    coords = {key: value for key, value in like.coords.items() if set(value.dims) <= set(dims) and value.dims}
    return xarray.DataArray(array, dims=dims, coords=coords, name=name)

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes NumPy arrays usable by ITK without a copy."""

from typing import Any

import numpy as np

from ._errors import InvalidTypeError
from ._like import updated
from ._types import ItkObject

# The pixel types of the filters: NumPy's name, ITK's name in Python, ITK's name of a component type of files.
PIXEL_TYPES = {
    "uint8": ("UC", "UCHAR"),
    "uint16": ("US", "USHORT"),
    "int16": ("SS", "SHORT"),
    "float32": ("F", "FLOAT"),
    "float64": ("D", "DOUBLE"),
}
PIXEL_NAMES = "uint8, uint16, int16, float32 or float64"

# Advice of the error for a masked array, in functions with the argument `mask` and in others.
GIVE_MASK = "give its data, and a mask by mask="
FILL_MASKED = "fill in the masked pixels, or give its data, by numpy.ma.getdata()"


def as_array(values: object, name: str, if_masked: str = FILL_MASKED) -> np.ndarray:
    """Returns `values` as an array, which shares the memory of an array. Raises an error for a masked array, whose
    mask would be lost, with the advice `if_masked`, and for values that are no array."""
    values = without_mask(updated(values), name, if_masked)
    if hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
        return from_dlpack(values, name)
    if isinstance(values, (list, tuple)) or hasattr(values, "__array__") or hasattr(values, "__array_interface__"):
        try:
            return np.asarray(values)
        except (ValueError, TypeError, RuntimeError) as error:
            # NumPy raises for lists of unequal length or without numbers, tensors for another device or a gradient.
            raise ValueError(f"{name} cannot be made an array ({error}); expected numbers") from error
    raise InvalidTypeError(f"{name} is of type {type(values).__name__}; expected an array")


def without_mask(values: Any, name: str, if_masked: str) -> Any:
    """Returns the data of a masked array whose values all count, and other values unchanged. Raises an error with
    the advice `if_masked` if a value is masked. NumPy would drop the mask of an array of Dask, which is therefore
    computed here."""
    if isinstance(getattr(values, "_meta", None), np.ma.MaskedArray):
        values = values.compute()
    if not isinstance(values, np.ma.MaskedArray):
        return values
    if np.ma.is_masked(values):
        raise InvalidTypeError(f"{name} is a masked array, expected a plain one: {if_masked}")
    return np.asarray(values.data)


def from_dlpack(values: Any, name: str) -> np.ndarray:
    """Returns an array that shares the memory of a tensor. Raises ValueError for a tensor on another device."""
    try:
        return np.from_dlpack(values)
    except (BufferError, RuntimeError, TypeError, ValueError) as error:
        raise ValueError(f"{name} cannot be made an array ({error}); expected a tensor in main memory") from None


def require_pixel_type(array: np.ndarray, name: str) -> str:
    """Returns the name of the array's pixel type, as in PIXEL_TYPES. Raises an error that names any other type. The
    byte order may be any."""
    pixel = array.dtype.newbyteorder("=").name
    if pixel not in PIXEL_TYPES:
        advice = "; convert it with .astype(), if its values allow" if array.dtype.kind in "iufb" else ""
        raise InvalidTypeError(f"{name} has dtype {array.dtype.name}; expected {PIXEL_NAMES}{advice}")
    return pixel


def require_shape(array: np.ndarray, name: str, axes: str) -> None:
    """Raises ValueError unless the array has the axes `axes`, for example "t, y, x", and is not empty."""
    rank = axes.count(",") + 1
    if array.ndim != rank:
        colour = "; of a colour image, give one channel" if array.ndim == rank + 1 and array.shape[-1] in (3, 4) else ""
        raise ValueError(
            f"{name} has {array.ndim} dimensions, shape {array.shape}; expected {rank}, the axes ({axes}){colour}"
        )
    if array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}, which holds no pixel; expected at least 1 along each axis")


def as_itk_order(array: np.ndarray) -> np.ndarray:
    """Returns the array if it is C-contiguous and in the machine's byte order, else a copy that is. ITK reads the
    memory in this order only, and would exchange time and x without an error."""
    return np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))


def as_frame(values: object, name: str, dtype: type[np.generic]) -> np.ndarray:
    """Returns a frame-sized array (y, x) of `dtype`. Other types of real numbers are converted."""
    array = as_array(values, name)
    require_shape(array, name, "y, x")
    if array.dtype.kind not in "iufb":
        raise InvalidTypeError(f"{name} has dtype {array.dtype.name}; expected real numbers")
    return np.ascontiguousarray(array, dtype=dtype)


def as_mask(values: object, name: str) -> np.ndarray:
    """Returns a mask (y, x) of uint8, which is 1 where `values` is not 0. Raises ValueError for NaN."""
    array = as_array(values, name)
    require_shape(array, name, "y, x")
    if array.dtype.kind not in "iufb":
        raise InvalidTypeError(f"{name} has dtype {array.dtype.name}; expected real numbers or bool")
    unknown = int(np.count_nonzero(array != array))
    if unknown:
        raise ValueError(f"{name} has {unknown} pixels that are NaN; expected 0 or another number")
    return np.ascontiguousarray(array != 0, dtype=np.uint8)


def image_words(image: ItkObject) -> str:
    """Returns the description of an image of an unsupported type, for an error."""
    import itk

    try:
        _, (pixel, rank) = itk.template(image)
    except (KeyError, ValueError):
        return "no itk.Image"
    name = getattr(pixel, "name", None) or getattr(pixel, "__name__", str(pixel)).removeprefix("itk")
    return f"an itk.Image of {rank} dimensions of {name}"


def view(array: np.ndarray) -> ItkObject:
    """Returns an itk.Image on the memory of an array in ITK's order, see as_itk_order(). The array must outlive the
    image."""
    import itk

    return itk.image_view_from_array(array)

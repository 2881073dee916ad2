# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames from files, through itk.SensorNoiseFrameListSource, which checks them: the one door of C++ and Python."""

import os
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from ._arrays import PIXEL_TYPES
from ._errors import itk_errors
from ._names import expand
from ._types import FileName, ItkObject
from ._update import update

# Errors about a file with several channels or planes name an option of the tool; Python has another way.
_CHOICE = ": choose --"
_ADVICE = (
    "Give the frames of one channel and one plane as an array (t, y, x), "
    "of a TIFF (T, C, Y, X) for instance tifffile.imread(name)[:, 0]"
)


def _names_of(file_names: FileName | Sequence[FileName]) -> list[str]:
    """Returns the names as text that C++ accepts."""
    if isinstance(file_names, (str, os.PathLike)):
        file_names = [file_names]
    names = [os.fsdecode(name) for name in file_names]
    for name in names:
        try:
            name.encode()
        except UnicodeEncodeError:
            raise ValueError(f"{name!a}: a name that is not UTF-8; expected one that is") from None
    return names


@contextmanager
def _file_errors() -> Iterator[None]:
    """Raises ITK's errors about files as ValueError. Advice that names an option of the tool is replaced."""
    try:
        with itk_errors(kind=ValueError):
            yield
    except ValueError as error:
        words, found, _ = str(error).partition(_CHOICE)
        if not found:
            raise
        raise ValueError(f"{words}. {_ADVICE}") from None


def _new(pixel: str) -> ItkObject:
    import itk

    return itk.SensorNoiseFrameListSource[itk.Image[getattr(itk, PIXEL_TYPES[pixel][0]), 3]].New()


def open_files(file_names: Sequence[FileName], raw: str = "") -> tuple[ItkObject, str]:
    """Returns the source of files in time order, and its pixel type, a key of PIXEL_TYPES. All headers are checked; no
    pixel is kept. `raw`: how frames lie in files without a header. Raises ValueError with the message of C++ for a
    damaged or unsuitable file. Warns of a file that is given twice."""
    import itk

    # A source of any type finds the right pixel type. Its findings are passed on, so that no file is checked twice.
    asked = _new("uint16")
    asked.SetFileNames(_names_of(file_names))
    asked.SetRawLayout(raw)
    with _file_errors():
        component = asked.GetComponentType()
    if asked.GetWarning():
        warnings.warn(asked.GetWarning(), stacklevel=2)
    pixel = next(
        key for key, (_, name) in PIXEL_TYPES.items() if component == getattr(itk.CommonEnums, f"IOComponent_{name}")
    )
    source = _new(pixel)
    source.SetFrameList(asked.GetFrameList())
    with _file_errors():
        source.UpdateOutputInformation()
    return source, pixel


def read_image(file_name: FileName, what: str) -> np.ndarray:
    """Reads the pixels (y, x) of one image file. Errors call it `what`."""
    import itk

    try:
        source, _ = open_files([file_name])
        frames = int(source.GetOutput().GetLargestPossibleRegion().GetSize()[2])
        if frames > 1:
            raise ValueError(f"{os.fsdecode(file_name)}: has {frames} frames; expected one image")
    except ValueError as error:
        raise ValueError(f"{what} {error}") from None
    with itk_errors(f"{what} "):
        update(source)
    image: np.ndarray = itk.array_from_image(source.GetOutput())[0]
    return image


def sensor_noise_frame_list_source(
    file_names: FileName | Sequence[FileName], *, ttype: ItkObject = None, raw: str = ""
) -> ItkObject:
    """Reads frames on files as one itk.Image (x, y, t): itk.SensorNoiseFrameListSource in functional style.

    Parameters
    ----------
    file_names : str, os.PathLike or sequence of them
        2-D images in time order, of the formats that documentation/reference/files.md lists, or the name of one stack;
        a pattern of names or a folder, as `frames` of estimate_sensor_noise().
    ttype : type, optional
        Type of the image, for instance itk.Image[itk.US, 3]. Default: the type of the files. Nothing is converted.
    raw : str, optional
        Layout of files without a header, as estimate_sensor_noise() has it.

    Returns
    -------
    itk.Image
        All frames, read. To read a few at a time, use the class, as an input of a filter.

    Raises
    ------
    TypeError
        A wrong type.
    ValueError
        Files that are not complete, not all alike, not of grey values or cannot be read.

    See Also
    --------
    estimate_sensor_noise : Reads files a few frames at a time.

    Examples
    --------
    >>> image = itk.sensor_noise_frame_list_source("frames/*.tif")
    """
    import itk

    file_names = expand(file_names, "file_names")
    if ttype is None:
        source, _ = open_files([file_names] if isinstance(file_names, (str, os.PathLike)) else file_names, raw)
    else:
        source = itk.SensorNoiseFrameListSource[ttype].New()
        source.SetFileNames(_names_of(file_names))
        source.SetRawLayout(raw)
        with _file_errors():
            source.UpdateOutputInformation()
    with itk_errors():
        update(source)
    return source.GetOutput()

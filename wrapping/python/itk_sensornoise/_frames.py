# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Whatever a user has as frames, as one ITK stack (x, y, time) without a second copy of it."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _options
from ._arrays import (
    GIVE_MASK,
    PIXEL_NAMES,
    PIXEL_TYPES,
    as_array,
    as_itk_order,
    from_dlpack,
    image_words,
    require_pixel_type,
    require_shape,
    view,
)
from ._bayer import note_pattern
from ._errors import InvalidTypeError, itk_errors
from ._lazy import LazyStack, ListOfFrames, is_lazy, source_of
from ._like import output_of
from ._names import expand, is_name, refuse_other_formats
from ._rawpy import RawFiles, is_raw, raw_metadata
from ._source import open_files
from ._types import FileName, Frames, ItkObject, LazyFrames

EXPECTED = (
    "expected an array (t, y, x), an itk.Image of 3 dimensions, an object with shape, dtype and slices along time, a "
    "list of file names or of 2-D arrays, or a file name, a pattern of names or a folder"
)

_PIECE_BYTES = 32 << 20  # pixels that are read together [bytes]


@dataclass
class Stack:
    """A stack of frames for ITK. `kept` holds the owners of its memory, and the filters that produce it."""

    image: ItkObject
    pixel: str  # a key of PIXEL_TYPES
    kept: list[Any]
    failed: list[BaseException] = field(default_factory=list)  # while lazy frames were read; see at_work()
    is_cut: bool = False  # to the frames that were asked for
    files: list[str] = field(default_factory=list)  # all that are read, in order; empty: frames in no file of ours

    @property
    def size(self) -> tuple[int, int, int]:
        """Width [pixel], height [pixel], number of frames."""
        width, height, frames = self.image.GetLargestPossibleRegion().GetSize()
        return int(width), int(height), int(frames)

    def pieces(self) -> Iterator[np.ndarray]:
        """Yields all pixels in order, as arrays (t, y, x) of a few frames, which are valid until the next one. Ends
        where lazy frames cannot be read, with the reason in `failed`."""
        import itk

        width, height, frames = self.size
        region = self.image.GetLargestPossibleRegion()
        start, size = list(region.GetIndex()), list(region.GetSize())
        step = max(_PIECE_BYTES // (width * height * np.dtype(self.pixel).itemsize), 1)
        for first in range(0, frames, step):
            count = min(step, frames - first)
            region.SetIndex([*start[:2], start[2] + first])
            region.SetSize([*size[:2], count])
            self.image.SetRequestedRegion(region)
            self.image.Update()
            if self.failed:
                break
            at = start[2] + first - self.image.GetBufferedRegion().GetIndex()[2]
            yield itk.array_view_from_image(self.image)[at : at + count]
        self.image.SetRequestedRegionToLargestPossibleRegion()

    def estimator(self, template: ItkObject) -> ItkObject:
        """Returns a new filter of this stack's type with the stack as input."""
        instance = template[type(self.image)].New()
        instance.SetInput(self.image)
        return instance


def open_frames(
    frames: Frames, frame_range: tuple[int, int] | None = None, name: str = "frames", if_masked: str = GIVE_MASK
) -> Stack:
    """Returns the frames as a stack: arrays are shared, files and lazy frames are read later, a few at a time.

    An array that is not C-contiguous or not in the machine's byte order is copied once. The files of a list outside
    `frame_range` (first, one past the last) are not opened; a stack is not cut. Raises ValueError, with the `name`
    of the parameter, for anything else. `if_masked`: advice of the error for masked arrays.
    """
    frames = output_of(expand(frames, name))
    if is_name(frames):
        return _from_files([frames], None)
    if isinstance(frames, Sequence) and not isinstance(frames, (str, bytes, range)) and not hasattr(frames, "dtype"):
        return _from_list(frames if isinstance(frames, (list, tuple)) else list(frames), frame_range, name, if_masked)
    if hasattr(frames, "__dlpack__") and not hasattr(frames, "__array__"):
        frames = from_dlpack(frames, name)
    if hasattr(frames, "GetLargestPossibleRegion"):
        return _from_image(frames, name)
    if is_lazy(frames):
        return _from_lazy(frames, name, if_masked)  # type: ignore[arg-type]  # checked by its members
    if not hasattr(frames, "__array__"):
        raise InvalidTypeError(f"{name} is of type {type(frames).__name__}; {EXPECTED}")
    array = as_array(frames, name, if_masked)
    pixel = require_pixel_type(array, name)
    require_shape(array, name, "t, y, x")
    array = as_itk_order(array)
    return Stack(view(array), pixel, [array])


def open_dumps(frames: object, raw: object, frame_range: tuple[int, int] | None = None, name: str = "frames") -> Stack:
    """Returns the stack on files without a header, which lie as `raw` says. Raises ValueError if `frames` are no names
    of files, with the `name` of the parameter, or `raw` is no layout."""
    layout = "a layout, for example '640x480:uint16le'"
    if not isinstance(raw, str):
        raise _options.refuse_type("raw", raw, layout)
    if not raw:
        raise _options.refuse("raw", raw, layout)
    names = [frames] if is_name(frames) else frames
    if not isinstance(names, (list, tuple)) or not all(map(is_name, names)):
        raise InvalidTypeError(f"raw was given and {name} is of type {type(frames).__name__}; expected names of files")
    _require_range(names, frame_range)
    return _from_files(names, frame_range, raw)


def crop(stack: Stack, corner: tuple[int, ...], size: tuple[int, ...]) -> Stack:
    """Returns the part of a stack from `corner` (x, y, t) on with `size` (x, y, t), cut out chunk by chunk."""
    import itk

    start = stack.image.GetLargestPossibleRegion().GetIndex()
    region = itk.ImageRegion[3]()
    region.SetIndex([int(start[axis]) + corner[axis] for axis in range(3)])
    region.SetSize(list(size))
    extract = itk.ExtractImageFilter[type(stack.image), type(stack.image)].New()
    extract.SetInput(stack.image)
    extract.SetExtractionRegion(region)
    extract.SetDirectionCollapseToSubmatrix()
    return Stack(_with_information(extract), stack.pixel, [extract, stack], stack.failed)


def frame_image(array: np.ndarray, stack_image: ItkObject) -> ItkObject:
    """Returns an image on an array (y, x), with the index of a stack's frames. The array must outlive the image."""
    import itk

    start = stack_image.GetLargestPossibleRegion().GetIndex()
    region = itk.ImageRegion[2]()
    region.SetIndex([int(start[0]), int(start[1])])
    region.SetSize([array.shape[1], array.shape[0]])
    image = view(array)
    image.SetRegions(region)
    return image


def _with_information(source: ItkObject) -> ItkObject:
    """Returns the output of a reader or filter with its size, before any pixel is read."""
    with itk_errors():
        source.UpdateOutputInformation()
    return source.GetOutput()


def _from_image(image: ItkObject, name: str) -> Stack:
    import itk

    for pixel, (itk_name, _) in PIXEL_TYPES.items():
        if isinstance(image, itk.Image[getattr(itk, itk_name), 3]):
            with itk_errors():
                image.UpdateOutputInformation()
            if 0 in image.GetLargestPossibleRegion().GetSize():
                raise ValueError(f"{name} is an itk.Image without pixels; expected at least 1 along each axis")
            return Stack(image, pixel, [image])
    raise InvalidTypeError(f"{name} is {image_words(image)}; expected an itk.Image of 3 dimensions of {PIXEL_NAMES}")


def _from_files(names: Sequence[FileName], frame_range: tuple[int, int] | None, raw: str = "") -> Stack:
    is_cut = frame_range is not None and len(names) > 1
    if frame_range is not None and is_cut:
        names = names[frame_range[0] : frame_range[1]]
    if not raw and all(map(is_raw, names)):
        stack = _from_lazy(RawFiles(names), "frames")
        note_pattern(stack.image, raw_metadata(names[0])["bayer"])
        stack.files = [os.fsdecode(name) for name in names]
    else:
        if not raw:
            refuse_other_formats(names)
        source, pixel = open_files(names, raw)
        stack = Stack(source.GetOutput(), pixel, [source], files=list(source.GetFilesRead()))
    stack.is_cut = is_cut
    return stack


def _require_range(frames: Sequence[Any], frame_range: tuple[int, int] | None) -> None:
    """Raises ValueError if a list is shorter than `frame_range`. The length of a stack is not known yet."""
    if frame_range is not None and len(frames) > 1 and frame_range[1] > len(frames):
        raise ValueError(f"frame_range ends at {frame_range[1]}, but there are {len(frames)} frames")


def _from_list(frames: Sequence[Any], frame_range: tuple[int, int] | None, name: str, if_masked: str) -> Stack:
    if not frames:
        least = "5 frames" if name == "frames" else "1 frame"
        raise ValueError(f"{name} is an empty {type(frames).__name__}; expected at least {least}")
    _require_range(frames, frame_range)
    named = sum(is_name(frame) for frame in frames)
    if named == len(frames):
        return _from_files(frames, frame_range)
    if named > 0:
        raise InvalidTypeError(f"{name} holds {named} file names and {len(frames) - named} others; expected one kind")
    is_cut = frame_range is not None and len(frames) > 1
    if frame_range is not None and is_cut:
        frames = frames[frame_range[0] : frame_range[1]]
    are_lazy = any(is_lazy(frame) and not isinstance(frame, np.ndarray) for frame in frames)
    frames = frames if are_lazy else _arrays_of(frames, name, if_masked)
    stack = _from_lazy(ListOfFrames(frames, name, if_masked), name, if_masked)
    stack.is_cut = is_cut
    return stack


def _from_lazy(frames: LazyFrames, name: str, if_masked: str = GIVE_MASK) -> Stack:
    stack = LazyStack(frames, name, if_masked)
    failed: list[BaseException] = []
    image, kept = source_of(stack, failed)
    return Stack(image, stack.pixel, kept, failed)


def _arrays_of(frames: Sequence[Any], name: str, if_masked: str) -> list[np.ndarray]:
    """Returns frames without a copy: the frames of a chunk are joined when ITK requests the chunk."""
    arrays = []
    for number, frame in enumerate(frames):
        this = f"{name}[{number}]"
        array = as_array(frame, this, if_masked)
        pixel = require_pixel_type(array, this)
        require_shape(array, this, "y, x")
        arrays.append(as_itk_order(array))
        if array.shape != arrays[0].shape or pixel != arrays[0].dtype.name:
            raise ValueError(
                f"{this} has shape {array.shape} and dtype {pixel}, but {name}[0] has {arrays[0].shape} and "
                f"{arrays[0].dtype.name}; expected one shape and dtype for all"
            )
    return arrays

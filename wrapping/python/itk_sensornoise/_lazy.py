# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames that are read as they are sliced along time: by ITK, a few at a time, and never held together."""

import mmap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._arrays import GIVE_MASK, PIXEL_TYPES, require_pixel_type, require_shape, without_mask
from ._axes import in_time_order
from ._chunks import arrays_of_graph, frames_of_chunk, is_closed, require_chunks
from ._types import ItkObject

# Bytes that are read at a time, besides the chunk of 32 MiB that ITK requests. Larger stored chunks are read whole, up
# to _LARGEST, so that each chunk is read once.
_PIECE_BYTES = 8 << 20
_LARGEST = 64 << 20


def mapping_of(array: object) -> mmap.mmap | None:
    """Returns the memory map of a file that holds an array, for instance of numpy.memmap; None for other arrays."""
    while isinstance(array, np.ndarray):
        array = array.base
    return array if isinstance(array, mmap.mmap) else None


def is_lazy(value: object) -> bool:
    """Returns whether `value` has a shape, a dtype of NumPy and slices, and is not in memory. An array on a
    memory-mapped file, for instance numpy.memmap, is not in memory."""
    if isinstance(value, np.ndarray):
        return mapping_of(value) is not None
    if is_closed(value):
        return True  # a later error names the array
    if isinstance(value, np.generic) or not all(hasattr(value, name) for name in ("shape", "dtype", "__getitem__")):
        return False
    try:
        np.dtype(value.dtype)  # type: ignore[attr-defined]
    except TypeError:
        return False  # the dtype of a tensor of another library
    return True


class ListOfFrames:
    """Lazy frames (t, y, x), made of a sequence of lazy frames (y, x)."""

    def __init__(self, frames: Sequence[Any], name: str, if_masked: str = GIVE_MASK) -> None:
        self.frames = frames
        self._name, self._if_masked = name, if_masked
        self.dtype = np.dtype(frames[0].dtype)
        self.shape = (len(frames), *frames[0].shape)
        for number, frame in enumerate(frames):
            this = f"{name}[{number}]"
            require_shape(_like(frame, this), this, "y, x")
            if frame.shape != frames[0].shape or np.dtype(frame.dtype) != self.dtype:
                raise ValueError(
                    f"{this} has shape {frame.shape} and dtype {frame.dtype}, but {name}[0] has {frames[0].shape} and "
                    f"{self.dtype}; expected one shape and dtype for all"
                )
            require_chunks(frame, this)

    def __getitem__(self, times: slice) -> np.ndarray:
        numbers = range(len(self.frames))[times]
        return np.stack([self._frame(number) for number in numbers])

    def _frame(self, number: int) -> np.ndarray:
        return np.asarray(without_mask(self.frames[number][...], f"{self._name}[{number}]", self._if_masked))


class LazyStack:
    """Reads lazy frames piece by piece, and checks that each is as was said."""

    def __init__(self, frames: Any, name: str, if_masked: str = GIVE_MASK) -> None:
        """Raises ValueError for a shape or a type that no stack has, and where stored chunks are missing."""
        if is_closed(frames):
            raise ValueError(f"{name} is a dataset of a closed HDF5 file; expected an open one")
        self._frames = in_time_order(frames, name)
        self._name, self._if_masked = name, if_masked
        like = _like(self._frames, name)
        self.pixel = require_pixel_type(like, name)
        require_shape(like, name, "t, y, x")
        require_chunks(frames, name)
        self.shape = like.shape
        # A graph of dask that only slices arrays of NumPy reads no chunk as a whole.
        arrays = [array for array in arrays_of_graph(self._frames) if isinstance(array, np.ndarray)]
        mapped = [array for array in [self._frames, *arrays] if mapping_of(array) is not None]
        self._piece = self._frames_of_piece(like.dtype.itemsize, 1 if arrays else frames_of_chunk(self._frames))
        # Changes in a private map exist there alone.
        maps = [mapping_of(array) for array in mapped if _is_of_file(array)]
        self._forgettable = [each for number, each in enumerate(maps) if each is not None and each not in maps[:number]]

    def read(self, first: int, end: int, take: Callable[[int, np.ndarray], None]) -> None:
        """Calls `take` with the frames first ... end - 1 in pieces, each with the number of its first frame. Raises
        ValueError if a piece has another shape or dtype than announced, and TypeError if values are masked."""
        while first < end:
            stop = min(end, (first // self._piece + 1) * self._piece)
            piece = np.asarray(without_mask(self._frames[first:stop], self._name, self._if_masked))
            expected = (stop - first, *self.shape[1:])
            if piece.shape != expected or piece.dtype.newbyteorder("=").name != self.pixel:
                raise ValueError(
                    f"{self._name}[{first}:{stop}] has shape {piece.shape} and dtype {piece.dtype.name}; expected "
                    f"{expected} and {self.pixel}, as {self._name} says of itself"
                )
            take(first, piece)
            del piece
            for mapping in self._forgettable:
                mapping.madvise(mmap.MADV_DONTNEED)
            first = stop

    def _frames_of_piece(self, item_bytes: int, stored: int) -> int:
        """Returns the number of frames that are read together. A chunk stores `stored` frames."""
        frame_bytes = item_bytes * int(self.shape[1]) * int(self.shape[2])
        wanted = max(_PIECE_BYTES // frame_bytes, 1)
        return max(1, min(-(-wanted // stored) * stored, max(_LARGEST // frame_bytes, 1)))


def source_of(stack: LazyStack, failed: list[BaseException]) -> tuple[ItkObject, list[Any]]:
    """Returns an image (x, y, t) whose frames are read when ITK requests them, and the objects that must outlive it.

    ITK would print and lose an exception of the reader. The exception is therefore appended to `failed`, and all
    later frames are zeros; see at_work()."""
    import itk

    kind = itk.Image[getattr(itk, PIXEL_TYPES[stack.pixel][0]), 3]
    region = itk.ImageRegion[3]()
    region.SetSize(list(stack.shape[::-1]))
    size_only = kind.New()  # its pixels are never read
    size_only.SetRegions(region)
    source = itk.PyImageFilter[kind, kind].New()
    source.SetInput(size_only)
    output = source.GetOutput()

    def generate(_: object) -> None:
        wanted = output.GetRequestedRegion()
        output.Initialize()  # else ITK keeps the pixels of the last chunk while it makes room for these
        output.SetBufferedRegion(wanted)
        output.Allocate()
        x, y, t = (slice(at, at + size) for at, size in zip(wanted.GetIndex(), wanted.GetSize(), strict=True))
        pixels = itk.array_view_from_image(output)
        try:
            if not failed:
                stack.read(t.start, t.stop, lambda at, piece: _put(pixels, at - t.start, piece[:, y, x]))
        except BaseException as error:  # noqa: BLE001 - of whatever package reads, and Ctrl-C; at_work() raises it again
            failed.append(error)
        if failed:
            pixels[...] = 0

    # ITK hands itself to the function, by a pointer that it does not own; nothing is needed of it.
    source._SetSelf(None)
    source.SetPyGenerateData(generate)
    source.UpdateOutputInformation()
    source._SetSelf(None)
    return output, [source, size_only, stack]


def _put(pixels: np.ndarray, at: int, piece: np.ndarray) -> None:
    pixels[at : at + len(piece)] = piece


def _like(frames: Any, name: str) -> np.ndarray:
    """Returns an array of the same shape and dtype that takes no memory."""
    shape = tuple(frames.shape)
    try:
        return np.broadcast_to(np.empty((), frames.dtype), [int(size) for size in shape])
    except ValueError:
        # dask's, where an operation has left the size open: NaN.
        raise ValueError(f"{name} has shape {shape}; expected numbers: dask's compute_chunk_sizes()") from None


def _is_of_file(array: np.ndarray) -> bool:
    """Returns whether the file holds all values of a mapped array, so that its memory may be released."""
    mode = getattr(array, "mode", None)
    if mode is not None:
        return bool(mode != "c")
    root = array
    while isinstance(root.base, np.ndarray):
        root = root.base
    return not root.flags.writeable

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Frames in parts. A task reads each part where it is stored."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._errors import InvalidTypeError
from .._frames import Stack, crop, open_dumps, open_frames
from .._lazy import is_lazy
from .._names import expand, is_name
from .._sums import camera_metadata
from .._types import Frames

_LARGEST_BLOCK = 512 << 20  # bytes of a part that is in memory whole


@dataclass
class Parts:
    """All frames, and the access of a task to some of them. `part(first, end)` is the argument of the task, a value of
    dask or an object that pickles. `frame_range(first, end)` selects frames of this argument; None: all frames."""

    shape: tuple[int, int, int]
    dtype: str
    metadata: dict[str, Any]
    frames: Any
    kind: str  # "dask", "files", "stack" or "lazy"

    def per_task(self, workers: int, wanted: int | None) -> int:
        """Returns the number of frames of a task: `wanted`, else two tasks for each worker with at least 8 frames, as
        the sums of many frames need no more memory. A task has at most half a GiB of an array of dask in memory."""
        if wanted is not None:
            return wanted
        count = max(8, -(-self.shape[0] // (2 * workers)))
        if self.kind == "dask":
            frame_bytes = self.shape[1] * self.shape[2] * np.dtype(self.dtype).itemsize
            count = min(count, max(1, _LARGEST_BLOCK // frame_bytes))
        return count

    def block_bytes(self, count: int) -> int:
        """Returns the bytes of `count` frames if they are the argument of a task; 0 if the task reads them, a few at a
        time."""
        if self.kind != "dask":
            return 0
        return count * self.shape[1] * self.shape[2] * np.dtype(self.dtype).itemsize

    def runs(self, count: int) -> list[tuple[int, int]]:
        """Returns (first, end) of each task."""
        return [(first, min(first + count, self.shape[0])) for first in range(0, self.shape[0], count)]

    def split(self, runs: Sequence[tuple[int, int]]) -> list[Any]:
        """Returns the argument of the task of each run."""
        if self.kind == "dask":
            sizes = tuple(end - first for first, end in runs)
            blocks = self.frames.rechunk({0: sizes, 1: -1, 2: -1}).to_delayed()
            return list(blocks[:, 0, 0])
        if self.kind == "files":
            return [self.frames[first:end] for first, end in runs]
        return [self.frames for _ in runs]

    def ranges(self, runs: Sequence[tuple[int, int]]) -> list[tuple[int, int] | None]:
        """Returns the frame range of each task within its part."""
        return [run if self.kind in ("stack", "lazy") else None for run in runs]

    def first_frame(self, raw: str | None) -> np.ndarray:
        """Returns the first frame (y, x), which this process reads."""
        frames = self.frames if self.kind == "stack" else self.frames[:1]
        stack = open_frames(frames) if raw is None else open_dumps(frames, raw)
        return _pixels(crop(stack, (0, 0, 0), (*stack.size[:2], 1)))


def _pixels(stack: Stack) -> np.ndarray:
    import itk

    stack.image.Update()
    for error in stack.failed:
        raise error
    array: np.ndarray = itk.array_from_image(stack.image)[0]
    return array


def parts_of(frames: Frames, raw: str | None, span: tuple[int, int] | None) -> Parts:
    """Returns the frames of estimate_sensor_noise(), cut to the `span` that is measured. Headers of files are read,
    pixels are not. Raises ValueError if `frames` are no frames."""
    frames = expand(frames)
    if span is not None:
        frames = _cut(frames, span)
    stack = open_frames(frames) if raw is None else open_dumps(frames, raw)
    shape = stack.size[::-1]
    names = [frames] if is_name(frames) else frames
    if isinstance(names, (list, tuple)) and all(map(is_name, names)):
        kind = "stack" if len(names) == 1 else "files"
        given: Any = names[0] if kind == "stack" else list(names)
    elif _is_dask(frames):
        kind, given = "dask", frames
    elif is_lazy(frames) or isinstance(frames, np.ndarray):
        kind, given = "lazy", frames
    else:
        raise InvalidTypeError(
            f"frames is of type {type(frames).__name__}; expected a dask array (t, y, x), file names, or an object "
            "with shape, dtype and slices along time that can be pickled"
        )
    return Parts(shape, np.dtype(stack.pixel).str, camera_metadata(stack.image), given, kind)


def _is_dask(frames: object) -> bool:
    return type(frames).__module__.startswith("dask.array") and hasattr(frames, "to_delayed")


def _cut(frames: Any, span: tuple[int, int]) -> Any:
    if is_name(frames) or (isinstance(frames, (list, tuple)) and len(frames) == 1):
        raise ValueError("frame_range was given, and frames is one file; expected a list of files, or lazy frames")
    count = len(frames) if isinstance(frames, (list, tuple)) else int(frames.shape[0])
    if span[1] > count:
        raise ValueError(f"frame_range ends at {span[1]}, but there are {count} frames")
    return frames[span[0] : span[1]]

# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The sums of estimate_sensor_noise() by themselves, for several processes that read a part of the frames each."""

import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from . import _options
from ._arrays import PIXEL_NAMES, PIXEL_TYPES, as_array, view
from ._channels import ChannelReports, report_of
from ._errors import InvalidValueError, itk_errors
from ._frames import Stack, crop, open_dumps, open_frames
from ._maps import arrays_of
from ._names import expand, is_name
from ._report import Report
from ._settings import Settings, open_dark, prepare, require_settings
from ._types import Frame, Frames, ItkObject

CHUNK_BYTES = 64 << 20  # files and lazy frames that are read together [bytes]
LEAST_FRAMES = 4  # read together, however large: so many are worked on at the cost of one
_CAMERA = "SensorNoise."  # begins the keys under which an image says what is known of its camera


class SensorNoiseSums:
    """Sums over a part of the frames. Processes that share the work of estimate_sensor_noise() exchange them.

        sums = SensorNoiseSums((400, 2048, 2048), "uint16", bayer="none")   # the same in every process
        while not sums.is_done:
            sums.add(frames[first:end], first)         # the part of this process
            for other in others:                       # the result of to_bytes() of the other process
                sums.merge(other)
            sums.end_pass()
        print(sums.report())

    The frames are read three times or more, see `is_done`. Every process ends a pass with the sums of all frames.
    Either all processes merge the sums of all others, or one process merges all sums and sends the result to the
    others. For integers the report has the bits of estimate_sensor_noise(), for any distribution of the frames and
    order of the merges. For floating point it is equal to within rounding; the same parts, merged in the same order,
    give the same bits. Frames that are equal bit by bit are counted once: if two processes have counted one each,
    merge() raises ValueError and names them; see `fingerprints`.

    Bytes of the sums: in pass 1, 20 a pixel (floating point: 32) and 2 kB a frame that is in; in pass 2, 16 kB a frame;
    in pass 3, 8 a pixel and temporal component of illumination and motion (4 to 20), and at most 32 MiB. Memory: the
    memory of estimate_sensor_noise(), 20 kB for each of all frames, and twice the sums. At most 2^22 frames, for which
    sums of integers are exact.

    Other threads of Python run while frames are added. Threads may use the same object: their calls follow each other.

    It can be pickled: settings, the sums of the passes that have ended, and the sums of the current pass. dark and mask
    are pickled with the settings, as they were given.
    """

    def __init__(
        self,
        shape: Sequence[int],
        dtype: Any,
        *,
        first_frame: Frame | str | None = None,
        dark: Frames | None = None,
        raw: str | None = None,
        metadata: Mapping[str, Any] | None = None,
        **settings: Any,
    ) -> None:
        """`shape` (t, y, x) and `dtype` of all frames. `settings`, `dark` and `raw`: as estimate_sensor_noise() has
        them; of a `frame_range`, `shape` says how many frames it has. `first_frame` (y, x), or the Bayer pattern that
        was found in it, is needed with the default bayer="auto", unless `metadata` have the pattern: what the image of
        a file says under keys that begin with "SensorNoise.". Dark frames are read here. Raises ValueError as
        estimate_sensor_noise()."""
        self._given = dict(
            shape=tuple(_options.integers("shape", shape, 3, "(t, y, x), three whole numbers")),
            dtype=np.dtype(dtype).str,
            first_frame=first_frame,
            dark=dark,
            raw=raw,
            metadata=dict(metadata or {}),
            **settings,
        )
        self._ended: list[np.ndarray] | None = []
        self._lock = threading.Lock()
        require_settings(settings)
        self._settings = Settings(**settings)
        self._settings.check(dark)
        self._start()

    def _start(self) -> None:
        import itk

        given = self._given
        stack = _size_only(given["shape"], np.dtype(given["dtype"]), given["metadata"])
        stack.is_cut = self._settings.span is not None
        dark = open_dark(expand(given["dark"], "dark"), given["raw"])
        self._prepared = prepare(stack, dark, self._settings)
        self._pixel = stack.pixel
        self._sums = itk.SensorNoiseSums[type(stack.image)].New()
        recognised = given["first_frame"] if self._settings.bayer == "auto" else None
        if recognised is not None and not isinstance(recognised, str):
            given["first_frame"] = recognised = self._recognise(recognised)
        with itk_errors(kind=ValueError):
            self._sums.Start(self._prepared.estimator, recognised or "")

    def _recognise(self, first_frame: Frame) -> str:
        """Returns the Bayer pattern of the measured frames, by the levels of the first frame."""
        stack = self._opened(as_array(first_frame, "first_frame")[None], "first_frame")
        x, y, _ = self._prepared.corner
        width, height, _ = self._prepared.size
        part = crop(stack, (x, y, 0), (width, height, 1))
        with itk_errors():
            part.image.Update()
            return str(self._sums.RecogniseBayerPattern(part.image))

    @property
    def shape(self) -> tuple[int, int, int]:
        """Returns the shape of all frames (t, y, x)."""
        return self._given["shape"]  # type: ignore[no-any-return]

    @property
    def passes_ended(self) -> int:
        """Number of passes that have ended."""
        with self._alone():
            return int(self._sums.GetPass())

    @property
    def is_done(self) -> bool:
        """Whether all passes have ended: then there are no sums, but a report. There are three passes. One more
        pass follows if frames unlike the others are left out, and one if the illumination changes strongly."""
        with self._alone():
            return bool(self._sums.IsDone())

    @property
    def frames(self) -> np.ndarray:
        """Numbers of the frames that were added in this pass, from 0."""
        return np.flatnonzero(self._flags())

    @property
    def missing(self) -> np.ndarray:
        """Numbers of the frames that were not added in this pass."""
        return np.flatnonzero(self._flags() == 0)

    @property
    def fingerprints(self) -> np.ndarray:
        """Pass 1: an array (frames, planes), a plane of a mosaic, else one, of 16 bytes for each of `frames`, which are
        equal where frames are equal, bit by bit. See leave()."""
        with self._alone():
            rows = _array(self._sums.GetFingerprints())
        return np.ascontiguousarray(rows).view("V16")

    def leave(self, flags: np.ndarray) -> None:
        """Pass 1, before frames are added: does not count those where `flags` (planes, t) are not 0, because another
        process counts an equal one. All processes must know of them by the same rule: the first is counted."""
        flags = np.ascontiguousarray(flags, dtype=np.uint8)
        with self._alone(kind=ValueError):
            self._sums.SetCountedElsewhere(view(flags))

    def add(self, frames: Frames, first: int = 0, *, frame_range: tuple[int, int] | None = None) -> None:
        """Adds frames to the sums of this pass: as estimate_sensor_noise() takes them, of the whole size, also where
        only a `roi` is measured. The first is frame `first` of all, and the others follow; parts may come in any order.
        `frame_range`: (first, end) of `frames` that are added. Files and lazy frames are read a few at a time. Raises
        ValueError, and adds nothing, if they do not fit; what a reader raises comes as it is, and then sums are not
        whole: forget() them."""
        raw, frames = self._given["raw"], expand(frames)
        if raw is None or not _are_names(frames):
            stack = self._opened(frames, "frames", frame_range)
        else:
            stack = self._fitting(open_dumps(frames, raw, frame_range), "frames")
        start, end = (0, stack.size[2]) if frame_range is None or stack.is_cut else frame_range
        first = _options.integer("first", first, 0, self.shape[0] - 1)
        taken = _options.integer("the number of frames", end - start, 1, self.shape[0] - first)
        there = self._flags()[first : first + taken].nonzero()[0]
        if there.size:
            raise ValueError(f"frame {first + there[0]} was added before; expected each once in a pass")
        x, y, _ = self._prepared.corner
        width, height, _ = self._prepared.size
        in_memory = stack.image.GetBufferedRegion().GetNumberOfPixels() == np.prod(stack.size)
        if in_memory and (width, height, end - start) == stack.size:
            with self._alone():
                self._sums.AddFrames(stack.image, first)
            return
        step = max(LEAST_FRAMES, CHUNK_BYTES // (width * height * np.dtype(self._pixel).itemsize))
        for at in range(start, end, step):
            part = crop(stack, (x, y, at), (width, height, min(step, end - at)))
            with itk_errors():
                part.image.Update()
            for error in stack.failed:
                raise error
            with self._alone():
                self._sums.AddFrames(part.image, first + at - start)

    def merge(self, other: "SensorNoiseSums | bytes | np.ndarray") -> bool:
        """Adds the sums of other frames in the same pass: an object, or its to_bytes(). Returns False, and changes
        nothing, if all of these frames were added before. Raises ValueError if only some of them were added, if a frame
        here and a frame there are equal, or if the sums are of another stack. It also raises ValueError for other
        settings, for another version of the package, which it names, and for bytes that are damaged or incomplete."""
        sums = _row(other._array() if isinstance(other, SensorNoiseSums) else other)
        with self._alone():
            return bool(self._sums.MergeSums(view(sums)))

    def to_bytes(self) -> bytes:
        """Returns the sums of this pass, for merge() of another process with the same version of the package on the
        same kind of machine."""
        return self._array().tobytes()

    def from_bytes(self, sums: bytes) -> None:
        """Replaces the sums of this pass by the sums that to_bytes() returned."""
        self.forget()
        self.merge(sums)

    def forget(self) -> None:
        """Takes back all that was added and merged in this pass."""
        with self._alone():
            self._sums.ForgetSums()

    def end_pass(self) -> None:
        """Ends the pass. Raises ValueError if a frame is missing, and names it."""
        missing = self.missing
        if missing.size:
            raise ValueError(
                f"{names_of(missing)} missing in pass {self.passes_ended + 1}; expected all {self.shape[0]}"
            )
        if self._ended is not None:
            self._ended.append(self._array())
        with self._alone():
            self._sums.EndPass()

    def report(self, *, maps: bool = False) -> Report | ChannelReports:
        """Returns the report after all passes. `maps`: with the maps of estimate_sensor_noise(maps=True)."""
        if not self.is_done:
            raise ValueError(f"{self.passes_ended} passes have ended; expected all: end_pass() until is_done")
        estimator = self._prepared.estimator
        return report_of(estimator, arrays_of(estimator) if maps else None)

    def drop_history(self) -> None:
        """Gives back the memory of the sums of ended passes, and keeps no more: it can then not be pickled."""
        self._ended = None

    @contextmanager
    def _alone(self, kind: type[Exception] = InvalidValueError) -> Iterator[None]:
        """Calls ITK's sums from one thread at a time, as other threads run while frames are added; errors as
        itk_errors()."""
        with self._lock, itk_errors(kind=kind):
            yield

    def _array(self) -> np.ndarray:
        with self._alone():
            sums: np.ndarray = _array(self._sums.GetSums())[0]
        return sums

    def _flags(self) -> np.ndarray:
        with self._alone():
            flags: np.ndarray = _array(self._sums.GetFrames())[0]
        return flags

    def _opened(self, frames: Any, name: str, frame_range: tuple[int, int] | None = None) -> Stack:
        return self._fitting(open_frames(frames, frame_range, name), name)

    def _fitting(self, stack: Stack, name: str) -> Stack:
        """Returns the stack. Raises ValueError if its frames do not fit the settings."""
        size = self.shape[:0:-1]
        if stack.size[:2] != size or stack.pixel != self._pixel:
            found = f"{stack.size[0]} x {stack.size[1]} pixels of type {stack.pixel}"
            raise ValueError(f"{name} has {found}; expected {size[0]} x {size[1]} of {self._pixel}")
        return stack

    def __reduce__(self) -> tuple[Any, ...]:
        if self._ended is None:
            raise ValueError("the sums of ended passes were dropped: without them it cannot be pickled")
        current = None if self.is_done else self._array()
        return _restored, (self._given, list(self._ended), current)

    def __repr__(self) -> str:
        frames, height, width = self.shape
        of = f"of {frames} frames of {width} x {height} pixels"
        if self.is_done:
            return f"<SensorNoiseSums: all passes ended, {of}>"
        return f"<SensorNoiseSums: pass {self.passes_ended + 1}, {len(self.frames)} {of}>"


def _restored(given: dict[str, Any], ended: list[np.ndarray], current: np.ndarray | None) -> SensorNoiseSums:
    sums = SensorNoiseSums(**given)
    for each in ended:
        sums.merge(each)
        sums.end_pass()
    if current is not None:
        sums.merge(current)
    return sums


def camera_metadata(image: ItkObject) -> dict[str, Any]:
    """Returns the camera settings in the metadata of an image, for SensorNoiseSums in another process."""
    return {key: value for key, value in dict(image).items() if key.startswith(_CAMERA)}


def names_of(frames: np.ndarray) -> str:
    """Returns "frame 3 is" or "frames 3, 4, 5, ... (12 in all) are"."""
    if len(frames) == 1:
        return f"frame {frames[0]} is"
    first = ", ".join(map(str, frames[:5]))
    return f"frames {first}{f', ... ({len(frames)} in all)' if len(frames) > 5 else ''} are"


def _are_names(frames: Any) -> bool:
    return is_name(frames) or (isinstance(frames, (list, tuple)) and all(map(is_name, frames)))


def _size_only(shape: tuple[int, int, int], dtype: np.dtype, metadata: Mapping[str, Any]) -> Stack:
    """Returns a stack without pixels."""
    import itk

    pixel = dtype.newbyteorder("=").name
    if pixel not in PIXEL_TYPES:
        raise ValueError(f"dtype is {dtype.name}; expected {PIXEL_NAMES}")
    if min(shape) < 1:
        raise _options.refuse("shape", shape, "at least 1 along each axis")
    image = itk.Image[getattr(itk, PIXEL_TYPES[pixel][0]), 3].New()
    region = itk.ImageRegion[3]()
    region.SetSize(list(shape[::-1]))
    image.SetRegions(region)
    for key, value in metadata.items():
        image[key] = value
    return Stack(image, pixel, [])


def _row(sums: Any) -> np.ndarray:
    """Returns bytes as an array (1, n) that ITK can read."""
    row = sums if isinstance(sums, np.ndarray) else np.frombuffer(sums, np.uint8)
    return np.ascontiguousarray(row, dtype=np.uint8).reshape(1, -1)


def _array(image: ItkObject) -> Any:
    """Returns a copy of an image as an array. NumPy loses the owner of the memory of a sliced ITK view."""
    import itk

    return np.array(itk.array_view_from_image(image), subok=False)

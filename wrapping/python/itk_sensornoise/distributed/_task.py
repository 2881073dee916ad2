# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""One source measured, here or by a worker of Dask; what goes wrong with it is a sentence, not an exception."""

import json
import pickle
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from .._axes import in_time_order
from .._errors import InvalidTypeError, InvalidValueError, OutOfMemoryError
from .._estimate import estimate_sensor_noise, is_of_frames
from .._names import expand
from .._types import Frames
from ._memory import memory_of_task
from ._sources import Burst


class Outcome(NamedTuple):
    """Result of a source: a report, or the reason for no report. One of the two is None."""

    reason: str | None  # why there is no report, one line
    report: str | None  # the record as JSON


def measure(source: Any, settings: dict[str, Any], memory_of: Callable[[Any], int | None] | None = None) -> Outcome:
    """Measures frames, or what a function without arguments returns. `memory_of`: the memory_limit for them, unless the
    settings have one."""
    try:
        stored = None
        if isinstance(source, Burst):
            stored, settings = source.stored, {**settings, "dark": expand(source.dark, "dark")}
            source = source.frames
        frames = _read_here(expand(source() if callable(source) else source))
        if stored is not None and is_of_frames(stored, frames, settings):
            return Outcome(None, json.dumps(stored))
        if memory_of is not None and settings.get("memory_limit") is None:
            settings = {**settings, "memory_limit": memory_of(frames)}
        return Outcome(None, estimate_sensor_noise(frames, **settings).to_json())
    except Exception as error:  # noqa: BLE001 - of whatever package reads; one bad burst does not end the others
        return Outcome(reason_of(error), None)


def measure_pickled(source: bytes, settings: dict[str, Any]) -> Outcome:
    """Measures a source in a worker, with the memory that Dask lets it use. One thread is used, unless the settings say
    otherwise: a worker runs as many tasks at a time as it may use cores."""
    try:
        unpickled = pickle.loads(source)
    except Exception as error:  # noqa: BLE001 - of whatever package the source is of
        return Outcome(f"the worker cannot unpickle it: {reason_of(error)}", None)
    return measure(unpickled, {**settings, "threads": settings.get("threads") or 1}, memory_of_task)


def reason_of(error: BaseException) -> str:
    """Returns an exception as one line. Its type is added unless the package itself raised it."""
    text = " ".join(str(error).split())
    is_ours = type(error) in (ValueError, RuntimeError, InvalidTypeError, InvalidValueError, OutOfMemoryError)
    return text if text and is_ours else f"{type(error).__name__}: {text}".rstrip(": ")


class _Here:
    """Frames of Dask, computed by the thread that asks for them: else they would be tasks of all workers, while another
    burst took this one's thread."""

    def __init__(self, frames: Any) -> None:
        self.shape, self.dtype, self.chunks = frames.shape, np.dtype(frames.dtype), frames.chunks
        self._frames = frames

    def __getitem__(self, times: slice) -> Any:
        return self._frames[times].compute(scheduler="synchronous")  # LazyStack sees a mask


def _read_here(frames: Any) -> Frames:
    graph = getattr(frames, "__dask_graph__", None)
    if graph is None or graph() is None:
        return frames  # type: ignore[no-any-return]
    return _Here(in_time_order(frames, "frames"))
